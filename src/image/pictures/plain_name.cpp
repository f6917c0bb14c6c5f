#include <stdlib.h>

#include <string>

#include <espalier/core/error.h>
#include <espalier/image/pictures/plain_name.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

bool is_plain(const fs::path& path) { return path.string().find_first_of("?%#") == std::string::npos; }

/// Extensions tell formats that do not say what they are; an odd one tells nothing.
std::string plain_extension(const fs::path& path) {
  return is_plain(path.extension()) ? path.extension().string() : "";
}

}  // namespace

PlainName::PlainName(const fs::path& path) : path_(path) {
  if (is_plain(path)) return;
  std::string folder = (fs::temp_directory_path() / "espalier-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    throw_input_error("{}: no link to it can be made in {}", path.string(), folder);
  folder_ = folder;
  path_ = folder_ / ("picture" + plain_extension(path));
  fs::create_symlink(fs::absolute(path), path_);
}

PlainName::~PlainName() {
  std::error_code none;
  if (!folder_.empty()) fs::remove_all(folder_, none);
}

}  // namespace espalier
