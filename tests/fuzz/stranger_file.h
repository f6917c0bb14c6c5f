// What fuzz targets of files share: the bytes as a file, and what a reader may say of it.
#pragma once
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <espalier/core/error.h>

namespace espalier {

/// A folder of this process, in memory where the system has such a file system.
inline const std::filesystem::path& fuzz_folder() {
  static const std::filesystem::path folder = [] {
    std::error_code none;
    const std::filesystem::path memory = "/dev/shm";
    const auto made =
        (std::filesystem::is_directory(memory, none) ? memory : std::filesystem::temp_directory_path()) /
        ("espalier_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    std::atexit([] { std::filesystem::remove_all(fuzz_folder()); });
    return made;
  }();
  return folder;
}

inline std::filesystem::path fuzz_file(const char* name, std::string_view bytes) {
  const std::filesystem::path file = fuzz_folder() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

/// Anything but a success or one InputError of text is a find: other exceptions pass, and end the process.
template <typename Use>
void use_of_stranger(Use use) {
  try {
    use();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).empty()) std::abort();
  }
}

}  // namespace espalier
