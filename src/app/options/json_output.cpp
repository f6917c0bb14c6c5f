#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <espalier/app/options/json_output.h>
#include <espalier/core/files.h>

namespace espalier {

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print the summary as JSON instead of text, also with --quiet");
}

void print_as_json(const nlohmann::ordered_json& json) {
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_summary_json(const std::filesystem::path& directory, const char* file) {
  nlohmann::ordered_json json = {{"directory", directory.string()}};
  json.update(nlohmann::ordered_json::parse(read_file(directory / file)));
  print_as_json(json);
}

}  // namespace espalier
