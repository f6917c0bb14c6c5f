// Reading a string with the turtle. A visitor is told of what is drawn; the walk itself only moves, turns
// and keeps the turtles of open branches. strings/turtle_commands.h has the table of commands.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/lsystem/drawing/turtle.h>
#include <espalier/lsystem/notation/settings.h>
#include <espalier/lsystem/strings/module_string.h>
#include <espalier/lsystem/strings/turtle_commands.h>
#include <espalier/lsystem/surfaces/appearance.h>

namespace espalier::lsystem {

/// A module as the walk meets it.
struct Step {
  Command command = Command::none;
  std::size_t module = 0;        ///< its place in the string
  std::size_t value_offset = 0;  ///< of its parameters
  const double* values = nullptr;
  std::size_t arity = 0;

  double value_or(std::size_t i, double otherwise) const { return i < arity ? values[i] : otherwise; }
};

/// A visitor that draws nothing.
struct SilentVisitor {
  void begin_segment(const Turtle&, const Step&) {}
  void end_segment(const Turtle&, const Step&) {}
  void jump(const Turtle&, const Step&) {}
  void open_branch() {}
  void close_branch() {}
  void other(const Turtle&, const Step&) {}  ///< surfaces, spheres, polygons
  void query(const Turtle&, const Step&) {}
};

template <typename Visitor>
class TurtleWalk {
 public:
  TurtleWalk(const Settings& settings, Visitor& visitor) : settings_(settings), visitor_(visitor) {
    turtle_.width = settings.width;
    around_.set(180);
    for (Rotation& rotation : rotations_) rotation.set(settings.angle_deg);
  }

  void run(const ModuleString& string, const SymbolTable& alphabet) {
    const std::vector<Command> commands = commands_of(alphabet);
    const std::uint8_t* arities = alphabet.arities().data();
    Step step;
    for (std::size_t i = 0; i < string.size(); ++i) {
      const SymbolId symbol = string.symbols[i];
      step.command = commands[symbol];
      step.module = i;
      step.values = string.values.data() + step.value_offset;
      step.arity = arities[symbol];
      if (step.command != Command::none) take(step);
      step.value_offset += step.arity;
    }
  }

 private:
  const Rotation& rotation(const Step& step) {
    Rotation& rotation = rotations_[static_cast<std::size_t>(step.command)];
    rotation.set(step.value_or(0, settings_.angle_deg));
    return rotation;
  }
  const Rotation& reversed(const Step& step) {
    Rotation& rotation = rotations_[static_cast<std::size_t>(step.command)];
    rotation.set(-step.value_or(0, settings_.angle_deg));
    return rotation;
  }

  void segment(const Step& step) {
    if (step.arity >= 2) turtle_.width = step.values[1];
    visitor_.begin_segment(turtle_, step);
    turtle_.move(step.value_or(0, settings_.length));
    visitor_.end_segment(turtle_, step);
    if (settings_.susceptibility != 0)
      turtle_.bend({settings_.tropism[0], settings_.tropism[1], settings_.tropism[2]},
                   settings_.susceptibility);
  }

  /// ; , ': the next or the previous colour of the table, colour (n), or (red, green, blue), each 0 to 1.
  void set_color(const Step& step, int change) {
    if (step.arity == 3) {
      turtle_.color = rgb(step.values);
      return;
    }
    const int count = settings_.appearance ? static_cast<int>(settings_.appearance->colors.size()) : 0;
    if (step.arity == 1 && !(step.values[0] >= 0 && step.values[0] <= count))
      throw_input_error("module {} of the string: got colour {}, expected 0 to {}", step.module,
                        step.values[0], count);
    turtle_.color_index = step.arity == 1 ? static_cast<int>(step.values[0])
                                          : std::clamp(turtle_.color_index + change, 0, count);
    turtle_.color = count > 0 ? settings_.appearance->color(turtle_.color_index) : PartColor{};
  }
  static PartColor rgb(const double* values) {
    const auto byte = [](double x) {
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
    };
    return {byte(values[0]), byte(values[1]), byte(values[2]), true};
  }

  void take(const Step& step) {
    switch (step.command) {
      case Command::draw:
      case Command::draw_unrecorded:
        return segment(step);
      case Command::move:
        turtle_.move(step.value_or(0, settings_.length));
        return visitor_.jump(turtle_, step);
      case Command::turn_left:
        return turtle_.turn_left(rotation(step));
      case Command::turn_right:
        return turtle_.turn_left(reversed(step));
      case Command::pitch_down:
        return turtle_.pitch_up(reversed(step));
      case Command::pitch_up:
        return turtle_.pitch_up(rotation(step));
      case Command::roll_right:
        return turtle_.roll_left(reversed(step));
      case Command::roll_left:
        return turtle_.roll_left(rotation(step));
      case Command::turn_around:
        return turtle_.turn_left(around_);
      case Command::open:
        stack_.push_back(turtle_);
        return visitor_.open_branch();
      case Command::close:
        turtle_ = stack_.back();
        stack_.pop_back();
        return visitor_.close_branch();
      case Command::level:
        return turtle_.level();
      case Command::narrower:
        turtle_.width = step.value_or(0, turtle_.width * settings_.width_factor);
        return;
      case Command::wider:
        turtle_.width = step.value_or(0, turtle_.width / settings_.width_factor);
        return;
      case Command::look_at:
        return turtle_.look_at({step.values[0], step.values[1], step.values[2]});
      case Command::query_position:
      case Command::query_heading:
      case Command::query_up:
      case Command::query_left:
        return visitor_.query(turtle_, step);
      case Command::sphere:
      case Command::surface:
      case Command::polygon_open:
      case Command::polygon_close:
      case Command::vertex:
      case Command::open_edge:
      case Command::close_edge:
        return visitor_.other(turtle_, step);
      case Command::next_color:
        return set_color(step, 1);
      case Command::previous_color:
        return set_color(step, -1);
      case Command::cut:  // the derivation has done it
      case Command::none:
      case Command::count:
        return;
    }
  }

  const Settings& settings_;
  Visitor& visitor_;
  Turtle turtle_;
  std::vector<Turtle> stack_;
  std::array<Rotation, kCommandCount> rotations_;  ///< by command
  Rotation around_;
};

}  // namespace espalier::lsystem
