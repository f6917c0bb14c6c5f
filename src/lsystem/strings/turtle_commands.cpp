// The symbols that the turtle knows, and how many parameters they take.
#include <array>

#include <espalier/core/error.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier::lsystem {

namespace {

struct CommandInfo {
  std::string_view name;
  Command command;
  int least, most;
};

constexpr std::array<CommandInfo, 31> kCommands{{
    {"F", Command::draw, 0, 5},
    {"G", Command::draw_unrecorded, 0, 5},
    {"f", Command::move, 0, 1},
    {"+", Command::turn_left, 0, 1},
    {"-", Command::turn_right, 0, 1},
    {"&", Command::pitch_down, 0, 1},
    {"^", Command::pitch_up, 0, 1},
    {"/", Command::roll_right, 0, 1},
    {"\\", Command::roll_left, 0, 1},
    {"|", Command::turn_around, 0, 0},
    {"[", Command::open, 0, 0},
    {"]", Command::close, 0, 0},
    {"$", Command::level, 0, 0},
    {"!", Command::narrower, 0, 1},
    {"_", Command::wider, 0, 1},
    {";", Command::next_color, 0, 3},
    {",", Command::previous_color, 0, 3},
    {"'", Command::next_color, 0, 3},
    {"@o", Command::sphere, 0, 1},
    {"@", Command::look_at, 3, 3},
    {"{", Command::polygon_open, 0, 0},
    {"}", Command::polygon_close, 0, 0},
    {".", Command::vertex, 0, 0},
    {"~", Command::surface, 1, 3},
    {"?P", Command::query_position, 2, 3},
    {"?H", Command::query_heading, 2, 3},
    {"?U", Command::query_up, 2, 3},
    {"?L", Command::query_left, 2, 3},
    {"%", Command::none, 0, 0},
    {"?", Command::open_edge, 0, 1},
    {"#", Command::close_edge, 0, 1},
}};

const CommandInfo* find_command(std::string_view name) {
  for (const CommandInfo& info : kCommands)
    if (info.name == name) return &info;
  return nullptr;
}

}  // namespace

void check_arity(std::string_view name, std::size_t arity) {
  const CommandInfo* info = find_command(name);
  if (!info) return;
  const bool is_color = info->command == Command::next_color || info->command == Command::previous_color;
  const int count = static_cast<int>(arity);
  if (is_color && count == 2)
    throw_input_error("module {}: got 2 parameters, the turtle expects 0, 1 or 3", name);
  if (count < info->least || count > info->most)
    throw_input_error("module {}: got {} parameters, the turtle expects {} to {}", name, count, info->least,
                      info->most);
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
