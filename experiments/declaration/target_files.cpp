#include <fmt/format.h>

#include <cctype>

#include <espalier/experiments/declaration/target_files.h>

namespace espalier {

std::string directory_name(const std::string& text) {
  std::string name = text;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.=-").find(c) == std::string::npos)
      c = '-';
  return name;
}

std::filesystem::path target_file(const std::string& target, std::size_t view, const std::string& ending) {
  const std::string number = view == 0 ? "" : fmt::format("+{}", view + 1);
  return std::filesystem::path("targets") / (directory_name(target) + number + ending);
}

}  // namespace espalier
