#include <filesystem>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {

std::vector<std::string> bundled_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_lsystems()) names.emplace_back(file.name);
  return names;
}

Grammar load_grammar(const std::string& name_or_path) {
  std::error_code ignored;
  if (name_or_path.ends_with(".lsys") && std::filesystem::exists(name_or_path, ignored))
    return read_grammar(name_or_path);
  for (const EmbeddedFile& file : embedded_lsystems())
    if (name_or_path == file.name || name_or_path == fmt::format("{}.lsys", file.name))
      return parse_grammar(std::string(file.text), fmt::format("{}.lsys", file.name),
                           data_path_or_first("lsystem/models"));
  throw_input_error("got L-system '{}', expected an .lsys file or a bundled one, the closest is '{}'",
                    name_or_path, closest_name(name_or_path, bundled_names()));
}

}  // namespace espalier::lsystem
