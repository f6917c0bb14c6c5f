#include <espalier/core/error.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier::lsystem {

const CommandInfo* find_command(std::string_view symbol) {
  for (const CommandInfo& info : kCommands)
    if (info.symbol == symbol || (!info.other_symbol.empty() && info.other_symbol == symbol)) return &info;
  return nullptr;
}

void check_arity(std::string_view name, std::size_t arity) {
  const CommandInfo* info = find_command(name);
  if (!info) return;
  const bool is_color = info->command == Command::next_color || info->command == Command::previous_color;
  const int count = static_cast<int>(arity);
  if (is_color && count == 2)
    throw_input_error("module {}: got 2 parameters, the turtle expects 0, 1 or 3", name);
  if (count >= info->least && (count <= info->most || info->ignores_more)) return;
  throw_input_error("module {}: got {} parameters, the turtle expects {}", name, count,
                    info->ignores_more         ? fmt::format("at least {}", info->least)
                    : info->least < info->most ? fmt::format("{} to {}", info->least, info->most)
                    : info->least == 0         ? "none"
                                               : fmt::format("{}", info->least));
}

std::vector<Command> commands_of(const SymbolTable& alphabet) {
  std::vector<Command> commands(alphabet.size(), Command::none);
  for (std::size_t id = 0; id < commands.size(); ++id) {
    const Symbol& symbol = alphabet[static_cast<SymbolId>(id)];
    check_arity(symbol.name, symbol.arity);
    if (const CommandInfo* info = find_command(symbol.name)) commands[id] = info->command;
  }
  return commands;
}

}  // namespace espalier::lsystem
