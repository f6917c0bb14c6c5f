#include "lsystem/plant_builder.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "lsystem/stem_splines.h"
#include "lsystem/surfaces.h"
#include "lsystem/triangle_leaves.h"
#include "lsystem/turtle_walk.h"

namespace espalier::lsystem {

namespace {

/// Collects what the turtle draws.
class Builder : public SilentVisitor {
 public:
  Builder(const Settings& settings, Plant& plant)
      : unit_(static_cast<float>(settings.unit_m)), settings_(settings), plant_(plant) {}

  void begin_segment(const Turtle& turtle, const Step& step) {
    if (!polygons_.empty()) return;
    if (axis_.stem < 0) axis_.stem = stems_.add_stem(axis_.parent);
    stems_.start_segment(axis_.stem, point(turtle.position), radius(turtle));
    if (step.arity >= 3) add_leaves(turtle, step);
  }

  void end_segment(const Turtle& turtle, const Step& step) {
    if (polygons_.empty())
      stems_.end_segment(axis_.stem, point(turtle.position), radius(turtle));
    else if (step.command == Command::draw)
      polygons_.back().push_back(point(turtle.position));
  }

  void jump(const Turtle& turtle, const Step&) {
    if (!polygons_.empty()) polygons_.back().push_back(point(turtle.position));
    axis_.stem = -1;
  }

  void open_branch() {
    stack_.push_back(axis_);
    axis_ = {-1, axis_.stem >= 0 ? axis_.stem : axis_.parent};
  }
  void close_branch() {
    axis_ = stack_.back();
    stack_.pop_back();
  }

  void other(const Turtle& turtle, const Step& step) {
    switch (step.command) {
      case Command::polygon_open:
        polygons_.push_back({point(turtle.position)});
        return;
      case Command::polygon_close:
        return close_polygon(step);
      case Command::vertex:
        if (polygons_.empty())
          throw_input_error("module {} of the string: got '.', expected it inside {{ }}", step.module);
        polygons_.back().push_back(point(turtle.position));
        return;
      case Command::sphere:
        return add_sphere(turtle, step);
      default:
        return add_surface(turtle, step);
    }
  }

  void finish() {
    if (!polygons_.empty())
      throw_input_error("got '{{' without '}}' in the string, expected polygons to end");
    stems_.write(plant_, settings_.joint >= 0.5);
    plant_.leaf_shape = settings_.leaf_shape;
    plant_.blossom_shape = settings_.blossom_shape;
    if (!triangles_.empty()) draw_as_triangles(triangles_, plant_);
    const Bounds box = bounds(plant_);
    plant_.tree_scale_m = std::max(box.upper.z - box.lower.z, 0.0f);
  }

 private:
  struct Axis {
    std::int32_t stem = -1;    ///< -1 before its first segment
    std::int32_t parent = -1;  ///< the stem it springs from
  };

  Vec3 point(const Vector& p) const {
    return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)} * unit_;
  }
  static Vec3 direction(const Vector& v) {
    return normalized({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  }
  float radius(const Turtle& turtle) const {
    return std::max(0.f, static_cast<float>(turtle.width) * unit_ / 2);
  }

  void add_leaf(const Turtle& turtle, double length, double width, LeafKind kind) {
    plant_.leaves.position_m.push_back(point(turtle.position));
    plant_.leaves.axis.push_back(direction(turtle.heading));
    plant_.leaves.side.push_back(direction(turtle.left * -1));
    plant_.leaves.length_m.push_back(static_cast<float>(length) * unit_);
    plant_.leaves.width_m.push_back(static_cast<float>(width) * unit_);
    plant_.leaves.kind.push_back(kind);
  }

  /// ~(surface, scale, width scale)
  void add_surface(const Turtle& turtle, const Step& step) {
    const double scale = step.value_or(1, 1), width = step.value_or(2, scale);
    const auto kind = step.values[0] == static_cast<int>(Surface::leaf) ? LeafKind::leaf : LeafKind::blossom;
    if (scale > 0 && width > 0)
      add_leaf(turtle, scale * settings_.leaf_length, width * settings_.leaf_width, kind);
  }

  /// F(length, width, leaves, down angle, roll angle): leaves spread evenly along the segment, each turned
  /// about it from the one before [CH §3.1.2].
  void add_leaves(const Turtle& turtle, const Step& step) {
    const int count = static_cast<int>(std::clamp(step.values[2], 0.0, 1e5));
    Rotation down, roll;
    down.set(-step.value_or(3, 45));
    roll.set(step.value_or(4, 140));
    Turtle along = turtle;
    for (int i = 0; i < count; ++i) {
      along.position = turtle.position + turtle.heading * (step.values[0] * (i + 1) / count);
      along.roll_left(roll);
      Turtle leaf = along;
      leaf.pitch_up(down);
      add_leaf(leaf, settings_.leaf_length, settings_.leaf_width, LeafKind::leaf);
    }
  }

  /// A ball is a short stem whose radii follow a circle.
  void add_sphere(const Turtle& turtle, const Step& step) {
    constexpr int kSegments = 8;
    const double size = step.value_or(0, 2 * turtle.width) / 2;
    const std::int32_t stem = stems_.add_stem(axis_.stem >= 0 ? axis_.stem : axis_.parent);
    for (int i = 0; i <= kSegments; ++i) {
      const double angle_rad = std::numbers::pi * i / kSegments;
      const Vec3 center = point(turtle.position - turtle.heading * (size * std::cos(angle_rad)));
      const float radius = static_cast<float>(size * std::sin(angle_rad)) * unit_;
      if (i > 0) stems_.end_segment(stem, center, radius);
      if (i < kSegments) stems_.start_segment(stem, center, radius);
    }
  }

  void close_polygon(const Step& step) {
    if (polygons_.empty())
      throw_input_error("module {} of the string: got '}}', expected a '{{' before it", step.module);
    triangulate(polygons_.back(), triangles_);
    polygons_.pop_back();
  }

  const float unit_;
  const Settings& settings_;
  Plant& plant_;
  StemSplines stems_;
  Axis axis_;
  std::vector<Axis> stack_;
  std::vector<std::vector<Vec3>> polygons_;  ///< those that are open
  std::vector<Triangle> triangles_;
};

}  // namespace

void build_plant(const ModuleString& string, const SymbolTable& alphabet, const Settings& settings,
                 Plant& plant) {
  plant.clear();
  Builder builder(settings, plant);
  TurtleWalk(settings, builder).run(string, alphabet);
  builder.finish();
}

}  // namespace espalier::lsystem
