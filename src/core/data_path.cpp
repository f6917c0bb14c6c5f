#include <fmt/ranges.h>

#include <cstdlib>
#include <optional>
#include <vector>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// Of a program in bin/: share/espalier in the same place, wherever that was moved to.
fs::path beside_program() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  return none ? fs::path() : program.parent_path().parent_path() / "share/espalier";
}

/// In the source, rooms of src/ hold their own data.
std::vector<fs::path> data_folders() {
  std::vector<fs::path> folders;
  if (const char* chosen = std::getenv("ESPALIER_DATA_DIR")) folders.emplace_back(chosen);
  folders.push_back(beside_program());
  folders.emplace_back(ESPALIER_INSTALLED_DATA_DIR);
  folders.emplace_back(ESPALIER_SOURCE_DIR);
  folders.emplace_back(ESPALIER_SOURCE_DIR "/src");
  return folders;
}

/// Null where there is none.
std::optional<fs::path> find_data(const std::string& name) {
  std::error_code none;
  for (const fs::path& folder : data_folders())
    if (fs::exists(folder / name, none)) return folder / name;
  return std::nullopt;
}

}  // namespace

fs::path data_path_or_first(const std::string& name) {
  return find_data(name).value_or(data_folders().front() / name);
}

fs::path data_path(const std::string& name) {
  if (const auto found = find_data(name)) return *found;
  std::vector<std::string> looked;
  for (const fs::path& folder : data_folders()) looked.push_back((folder / name).string());
  throw_input_error("got no data '{}', expected it at one of {} (ESPALIER_DATA_DIR names another folder)",
                    name, fmt::join(looked, ", "));
}

}  // namespace espalier
