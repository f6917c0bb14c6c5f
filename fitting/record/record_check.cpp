#include <algorithm>
#include <string_view>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/fitting/record/record_check.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kLineBegin = "\ncheck = \"";
constexpr std::size_t kHashSize = 16;

/// A stranger's record names files of its own directory alone.
bool is_inside(const fs::path& name) {
  return name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
}

}  // namespace

std::string with_check(const std::string& head, const std::string& rest) {
  return fmt::format("{}{} = \"{}\"  # of all other lines; who changes one on purpose takes this one out\n{}",
                     head, kCheckKey, text_hash(head + rest), rest);
}

void verify_check(const std::string& text, const std::string& source) {
  const std::size_t begin = text.find(kLineBegin);
  if (begin == std::string::npos) return;
  const std::size_t end = text.find('\n', begin + 1);
  const std::string others = text.substr(0, begin) + (end == std::string::npos ? "" : text.substr(end));
  if (text.substr(begin + kLineBegin.size(), kHashSize) == text_hash(others)) return;
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin) + 1, '\n') + 1;
  throw_input_error(
      "{}:{}: {}: got a record that was changed since the run wrote it, expected it as it was; who changed "
      "it on purpose takes this line out",
      source, line, kCheckKey);
}

void verify_files(const std::map<std::string, std::string>& files, const fs::path& directory) {
  for (const auto& [name, hash] : files) {
    const fs::path file = directory / name;
    std::error_code none;
    if (!is_inside(name) || !fs::is_regular_file(file, none))
      throw_input_error("{}: got no file, expected the one that the run keeps", file.string());
    if (const std::string now = text_hash(read_file(file)); now != hash)
      throw_input_error(
          "{}: got a file that was changed since the run began (hash {}), expected the run's ({})",
          file.string(), now, hash);
  }
}

}  // namespace espalier
