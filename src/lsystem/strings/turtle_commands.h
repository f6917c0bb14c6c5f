// The symbols that the turtle knows. They are those of [ABOP §1.3, §1.5] with the signs of [Topiary Fig. 1];
// docs/lsystem.md lists them. What each of them does is in drawing/turtle_walk.h.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include <espalier/lsystem/strings/symbols.h>

namespace espalier::lsystem {

enum class Command : std::uint8_t {
  none,
  draw,             // F(length, width, leaves, down angle, roll angle)
  draw_unrecorded,  // G: as F, but no vertex of a polygon
  move,             // f(length)
  turn_left,
  turn_right,
  pitch_down,
  pitch_up,
  roll_right,
  roll_left,
  turn_around,
  open,
  close,
  level,
  narrower,
  wider,
  next_color,
  previous_color,
  sphere,
  look_at,
  polygon_open,
  polygon_close,
  vertex,
  open_edge,  // ? and # of [Herbaceous §6]
  close_edge,
  surface,
  query_position,
  query_heading,
  query_up,
  query_left
};

/// The command of each symbol, by id. Throws InputError for a command with a wrong number of parameters.
std::vector<Command> commands_of(const SymbolTable& alphabet);

/// Throws InputError where the turtle knows the symbol, but not with so many parameters.
void check_arity(std::string_view name, std::size_t arity);

}  // namespace espalier::lsystem
