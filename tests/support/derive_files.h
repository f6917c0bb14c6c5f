// The whole use of several files of a stranger: an L-system with what it includes, its volumes, its surfaces
// and its plants, as one text. A line "=== NAME" begins the file of that name; what comes before the first
// one is the L-system itself.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/derive_bounded.h"

namespace espalier::lsystem {

/// A folder that is empty whenever files are written to it, and goes with the program.
class ScratchFolder {
 public:
  ScratchFolder() { clear(); }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  void clear() const {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / fmt::format("espalier_files_{}", ::getpid());
};

/// Names that stay in the folder.
inline bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() < 100 && name[0] != '.' &&
         name.find_first_of("/\\") == std::string::npos && name.find('\0') == std::string::npos;
}

inline void write_files(const std::string& text, const ScratchFolder& folder) {
  constexpr std::string_view kBegin = "\n=== ";
  folder.clear();
  std::string name = "main.lsys";
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(kBegin, begin), text.size());
    if (is_plain_name(name))
      std::ofstream(folder.file(name), std::ios::binary) << text.substr(begin, end - begin) << '\n';
    if (end == text.size()) return;
    const std::size_t name_begin = end + kBegin.size(),
                      name_end = std::min(text.find('\n', name_begin), text.size());
    name = text.substr(name_begin, name_end - name_begin);
    begin = name_end + 1;
  }
}

/// As derive_bounded does with one text.
inline std::string derive_files(const std::string& text, const ScratchFolder& folder) {
  write_files(text, folder);
  return derive_bounded([&] { return read_grammar(folder.file("main.lsys").string()); });
}

}  // namespace espalier::lsystem
