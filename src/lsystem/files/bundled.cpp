#include <algorithm>
#include <filesystem>

#include <espalier/core/data_path.h>
#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {

std::vector<std::string> bundled_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_lsystems()) names.emplace_back(file.name);
  return names;
}

std::string bundled_description(std::string_view name) {
  const auto files = embedded_lsystems();
  const auto file =
      std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& f) { return f.name == name; });
  if (file == files.end()) throw_input_error("got L-system '{}', expected a bundled one", name);
  std::string text;
  for (std::string_view rest = file->text; rest.starts_with('#');) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    text += rest.substr(1, end - 1);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  // A sentence ends with its bracket that names the source, or with a full stop before another sentence.
  std::size_t end = text.find(". ", first);
  while (end != std::string::npos && end >= 3 && text.substr(end - 3, 3) == "Fig")
    end = text.find(". ", end + 1);
  return text.substr(first, end == std::string::npos ? end : end + 1 - first);
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
