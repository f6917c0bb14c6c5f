// Where an experiment's directory keeps its targets: the drawn ones, and copies of pictures.
#pragma once
#include <filesystem>
#include <string>

namespace espalier {

/// Letters, digits, '_', '.', '=' and '-'; all else becomes '-'.
std::string directory_name(const std::string& text);

/// "targets/NAME.png" for a target's first view, "targets/NAME+2.png" for its second; `ending` with its dot.
/// No other target's name has a '+'.
std::filesystem::path target_file(const std::string& target, std::size_t view, const std::string& ending);

}  // namespace espalier
