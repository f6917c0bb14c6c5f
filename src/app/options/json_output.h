// What a command says at its end as JSON, for scripts: --json, on standard output and alone there.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace espalier {

/// Adds --json.
void add_json_flag(CLI::App& command, bool& json);

void print_as_json(const nlohmann::ordered_json& json);

/// Prints a file of JSON with "directory", where it lies, before its keys.
void print_summary_json(const std::filesystem::path& directory, const char* file);

}  // namespace espalier
