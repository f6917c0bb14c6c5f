// The table of symbols that the turtle knows. They are those of [ABOP §1.3, §1.5] with the signs of [Topiary
// Fig. 1]. Parsing, checks of parameters, `espalier lsystem --help` and docs/lsystem.md are made from the
// rows. What each command does is in drawing/turtle_walk.h, a case each. To add one, give it a name here, a
// row here, and a case there; what is missing or out of order does not compile.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <espalier/lsystem/strings/symbols.h>

namespace espalier::lsystem {

enum class Command : std::uint8_t {
  none,
  draw,
  draw_unrecorded,
  move,
  turn_left,
  turn_right,
  pitch_down,
  pitch_up,
  roll_right,
  roll_left,
  turn_around,
  level,
  look_at,
  open,
  close,
  cut,
  narrower,
  wider,
  polygon_open,
  vertex,
  polygon_close,
  surface,
  sphere,
  next_color,
  previous_color,
  open_edge,
  close_edge,
  query_position,
  query_heading,
  query_up,
  query_left,
  count  ///< of the names above
};

inline constexpr std::size_t kCommandCount = static_cast<std::size_t>(Command::count);

struct CommandInfo {
  Command command = Command::none;
  std::string_view symbol, other_symbol;  ///< the second may be empty
  int least = 0, most = 0;                ///< numbers of parameters
  std::string_view parameters, help;
  bool ignores_more =
      true;  ///< further parameters are a model's own, as in cpfg and L-Py; else they are refused
};

/// A row a command but `none`, in the order of Command.
inline constexpr std::array<CommandInfo, kCommandCount - 1> kCommands{{
    {Command::draw, "F", "", 0, 5, "length, width, leaves, down, roll",
     "draw a segment; where segments are leafy, with leaves along it [CH §3.1.2]"},
    {Command::draw_unrecorded, "G", "", 0, 5, "length, width, leaves, down, roll",
     "the same, without a vertex of a polygon"},
    {Command::move, "f", "", 0, 1, "length", "move without drawing"},
    {Command::turn_left, "+", "", 0, 1, "angle", "turn left (about U)"},
    {Command::turn_right, "-", "", 0, 1, "angle", "turn right"},
    {Command::pitch_down, "&", "", 0, 1, "angle", "pitch down (about L)"},
    {Command::pitch_up, "^", "", 0, 1, "angle", "pitch up"},
    {Command::roll_right, "/", "", 0, 1, "angle", "roll right (about H)"},
    {Command::roll_left, "\\", "", 0, 1, "angle", "roll left"},
    {Command::turn_around, "|", "", 0, 0, "", "turn around"},
    {Command::level, "$", "", 0, 0, "", "roll until L is horizontal"},
    {Command::look_at, "@", "", 3, 3, "x, y, z", "look at a point"},
    {Command::open, "[", "", 0, 0, "", "begin a branch", false},
    {Command::close, "]", "", 0, 0, "", "end a branch", false},
    {Command::cut, "%", "", 0, 0, "", "cut: erase the rest of the branch, as soon as it is produced", false},
    {Command::narrower, "!", "", 0, 1, "width", "set the width; without a parameter, make it narrower"},
    {Command::wider, "_", "", 0, 1, "width", "set the width; without a parameter, make it wider"},
    {Command::polygon_open, "{", "", 0, 0, "",
     "begin a filled polygon: its vertices are where this is, the ends of F and f in it, and the dots"},
    {Command::vertex, ".", "", 0, 0, "", "a vertex of the polygon"},
    {Command::polygon_close, "}", "", 0, 0, "", "end the polygon"},
    {Command::surface, "~", "", 1, 3, "\"leaf\", scale, width",
     "a predefined surface (\"leaf\", \"blossom\", \"maple\", …), see below", false},
    {Command::sphere, "@o", "", 0, 1, "diameter", "a ball"},
    {Command::next_color, ";", "'", 0, 3, "n",
     "the next colour of the table; colour n, 0 that of the material; or red, green, blue, 0 to 1", false},
    {Command::previous_color, ",", "", 0, 3, "n", "the previous colour of the table, or as before", false},
    {Command::open_edge, "?", "", 0, 1, "k",
     "the start of an edge between nodes: with the segments between them it bounds a polygon, see below"},
    {Command::close_edge, "#", "", 0, 1, "k", "the end of that edge"},
    {Command::query_position, "?P", "", 2, 3, "x, y, z", "becomes the turtle's position, see Productions",
     false},
    {Command::query_heading, "?H", "", 2, 3, "x, y, z", "becomes its heading", false},
    {Command::query_up, "?U", "", 2, 3, "x, y, z", "becomes its up vector", false},
    {Command::query_left, "?L", "", 2, 3, "x, y, z", "becomes its left vector", false},
}};

consteval bool commands_are_in_order() {
  for (std::size_t i = 0; i < kCommands.size(); ++i)
    if (kCommands[i].command != static_cast<Command>(i + 1) || kCommands[i].help.empty()) return false;
  return true;
}
static_assert(commands_are_in_order(), "kCommands: a row is missing, or is not where Command has its name");

/// The row of a symbol, or nullptr.
const CommandInfo* find_command(std::string_view symbol);

/// The command of each symbol, by id. Throws InputError for a command with a wrong number of parameters.
std::vector<Command> commands_of(const SymbolTable& alphabet);

/// Throws InputError where the turtle knows the symbol, but not with so many parameters.
void check_arity(std::string_view name, std::size_t arity);

}  // namespace espalier::lsystem
