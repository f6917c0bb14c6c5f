#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/random.h>
#include <espalier/lsystem/drawing/copy_plant.h>
#include <espalier/lsystem/drawing/frames.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/drawing/stem_splines.h>
#include <espalier/lsystem/drawing/turtle_walk.h>
#include <espalier/lsystem/strings/limits.h>
#include <espalier/lsystem/surfaces/surfaces.h>
#include <espalier/lsystem/surfaces/triangle_leaves.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostVertices = 2000;     // of a polygon: cutting it takes the square of it
constexpr std::size_t kMostLeaves = 5'000'000;  // and triangles of a plant
constexpr int kMostLeavesOfSegment = 1000;
constexpr std::size_t kMostCopiedKnots = 10'000'000;

/// 0 · x is 0 only where x is finite: one test for all of them.
float zero_unless_infinite(const std::vector<Vec3>& points) {
  float sum = 0;
  for (const Vec3& p : points) sum += 0 * (p.x + p.y + p.z);
  return sum;
}

void check_places(const Plant& plant) {
  float sum = zero_unless_infinite(plant.knots.handle_in_m) + zero_unless_infinite(plant.knots.handle_out_m) +
              zero_unless_infinite(plant.leaves.position_m);
  for (const float radius_m : plant.knots.radius_m) sum += 0 * radius_m;
  if (sum != 0)
    throw_input_error("the string draws what is too large or too far away, expected less than 1e30 m");
}

/// Collects what the turtle draws.
class Builder : public SilentVisitor {
 public:
  Builder(const Settings& settings, bool has_frames, Plant& plant, Work& work)
      : unit_(static_cast<float>(settings.unit_m)),
        settings_(settings),
        plant_(plant),
        work_(work),
        frames_(work),
        has_frames_(has_frames) {
    if (has_frames) axis_.node = frames_.add_node(-1, {0, 0, 0});
  }

  void begin_segment(const Turtle& turtle, const Step& step) {
    if (!polygons_.empty()) return;
    work_.add(work_of::kKnot);
    if (axis_.stem < 0) axis_.holder = axis_.stem = stems_.add_stem(axis_.parent);
    stems_.start_segment(axis_.stem, point(turtle.position), radius(turtle), turtle.color);
    if (settings_.leafy_segments && step.arity >= 3) add_leaves(turtle, step);
  }

  void end_segment(const Turtle& turtle, const Step& step) {
    if (polygons_.empty())
      stems_.end_segment(axis_.stem, point(turtle.position), radius(turtle));
    else if (step.command == Command::draw)
      add_vertex(turtle);
    move_on(turtle);
  }

  void jump(const Turtle& turtle, const Step&) {
    if (!polygons_.empty()) add_vertex(turtle);
    axis_.stem = -1;
    move_on(turtle);
  }

  void open_branch() {
    stack_.push_back(axis_);
    axis_ = {-1, axis_.stem >= 0 ? axis_.stem : axis_.parent, axis_.holder, axis_.node};
  }
  void close_branch() {
    axis_ = stack_.back();
    stack_.pop_back();
  }

  void other(const Turtle& turtle, const Step& step) {
    switch (step.command) {
      case Command::polygon_open:
        polygons_.push_back({{point(turtle.position)}, add_organ()});
        return;
      case Command::polygon_close:
        return close_polygon(turtle, step);
      case Command::open_edge:
        return frames_.open_edge(label_of(step), axis_.node);
      case Command::close_edge:
        return close_edge(turtle, step);
      case Command::vertex:
        if (polygons_.empty())
          throw_input_error("module {} of the string: got '.', expected it inside {{ }}", step.module);
        return add_vertex(turtle);
      case Command::sphere:
        return add_sphere(turtle, step);
      default:
        return add_surface(turtle, step);
    }
  }

  /// Valid after finish().
  PlantJoints& joints() { return joints_; }

  void finish() {
    if (!polygons_.empty())
      throw_input_error("got '{{' without '}}' in the string, expected polygons to end");
    stems_.write(plant_, settings_.joint >= 0.5, joints_.stem_place);
    plant_.leaf_shape = settings_.leaf_shape;
    plant_.blossom_shape = settings_.blossom_shape;
    if (!triangles_.empty()) draw_as_triangles(triangles_, plant_, joints_.organ_of_leaf);
    check_places(plant_);
    const Bounds box = bounds(plant_);
    plant_.tree_scale_m = std::max(box.upper.z - box.lower.z, 0.0f);
  }

 private:
  struct Axis {
    std::int32_t stem = -1;    ///< -1 before its first segment
    std::int32_t parent = -1;  ///< the stem it springs from
    std::int32_t holder = -1;  ///< the stem that bears what is placed here: also one before a jump
    Frames::Node node = -1;    ///< where the turtle is, in strings with frames
  };

  struct Polygon {
    std::vector<Vec3> outline;
    std::uint32_t organ = 0;
  };

  Organ here(float t = 0) const {
    StemPlace place = stems_.last_knot_of(axis_.holder);
    place.t = t;
    return {axis_.holder, place};
  }
  std::uint32_t add_organ(float t = 0) {
    joints_.organs.push_back(here(t));
    return static_cast<std::uint32_t>(joints_.organs.size() - 1);
  }

  std::string label() const { return settings_.appearance ? settings_.appearance->file + ": " : ""; }

  Vec3 point(const Vector& p) const {
    return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)} * unit_;
  }
  static Vec3 direction(const Vector& v) {
    return normalized({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
  }
  float radius(const Turtle& turtle) const {
    return std::max(0.f, static_cast<float>(turtle.width) * unit_ / 2);
  }

  /// t: how far it is from the last knot to the next.
  void add_leaf(const Turtle& turtle, double length, double width, LeafKind kind, float t = 0) {
    check_count();
    joints_.organ_of_leaf.push_back(add_organ(t));
    plant_.leaves.position_m.push_back(point(turtle.position));
    plant_.leaves.axis.push_back(direction(turtle.heading));
    plant_.leaves.side.push_back(direction(turtle.left * -1));
    plant_.leaves.length_m.push_back(static_cast<float>(length) * unit_);
    plant_.leaves.width_m.push_back(static_cast<float>(width) * unit_);
    plant_.leaves.kind.push_back(kind);
    if (turtle.color.is_set && plant_.leaves.color.empty())
      plant_.leaves.color.resize(plant_.leaves.size() - 1);
    if (turtle.color.is_set || !plant_.leaves.color.empty()) plant_.leaves.color.push_back(turtle.color);
  }

  /// ~(surface, scale, width scale)
  void add_surface(const Turtle& turtle, const Step& step) {
    const double scale = step.value_or(1, 1), width = step.value_or(2, scale);
    const std::size_t own_count = settings_.appearance ? settings_.appearance->surfaces.size() : 0;
    if (!(step.values[0] >= 0 && step.values[0] < static_cast<double>(kFirstOwnSurface + own_count)))
      throw_input_error("module {} of the string: got surface {}, expected the name of one", step.module,
                        step.values[0]);
    if (!(scale > 0 && width > 0)) return;
    const int surface = static_cast<int>(step.values[0]);
    const double length = scale * settings_.leaf_length, across = width * settings_.leaf_width;
    if (surface == kLeafSurface) return add_leaf(turtle, length, across, LeafKind::leaf);
    if (surface == kBlossomSurface) return add_leaf(turtle, length, across, LeafKind::blossom);
    if (surface < kFirstOwnSurface) return add_triangles(turtle, outline_triangles(surface), length, across);
    const NamedSurface& own =
        settings_.appearance->surfaces[static_cast<std::size_t>(surface - kFirstOwnSurface)];
    if (own.plant) return add_copy(turtle, *own.plant, scale, width);
    add_triangles(turtle, own.triangles, scale, width);
  }

  /// F(length, width, leaves, down angle, roll angle): leaves spread evenly along the segment, each turned
  /// about it from the one before [CH §3.1.2].
  void add_leaves(const Turtle& turtle, const Step& step) {
    if (step.values[2] > kMostLeavesOfSegment)
      throw_input_error("module {} of the string: got {} leaves on a segment, expected at most {}",
                        step.module, step.values[2], kMostLeavesOfSegment);
    const int count = static_cast<int>(std::max(step.values[2], 0.0));
    Rotation down, roll;
    down.set(-step.value_or(3, 45));
    roll.set(step.value_or(4, 140));
    Turtle along = turtle;
    for (int i = 0; i < count; ++i) {
      const double share = static_cast<double>(i + 1) / count;
      along.position = turtle.position + turtle.heading * (step.values[0] * (i + 1) / count);
      along.roll_left(roll);
      Turtle leaf = along;
      leaf.pitch_up(down);
      add_leaf(leaf, settings_.leaf_length, settings_.leaf_width, LeafKind::leaf,
               std::min(static_cast<float>(share), 1.f));
    }
  }

  /// A ball is a short stem whose radii follow a circle.
  void add_sphere(const Turtle& turtle, const Step& step) {
    constexpr int kSegments = 8;
    const double size = step.value_or(0, 2 * turtle.width) / 2;
    work_.add(work_of::kKnot * (kSegments + 1));
    const std::int32_t stem = stems_.add_stem(axis_.stem >= 0 ? axis_.stem : axis_.parent);
    for (int i = 0; i <= kSegments; ++i) {
      const double angle_rad = std::numbers::pi * i / kSegments;
      const Vec3 center = point(turtle.position - turtle.heading * (size * std::cos(angle_rad)));
      const float radius = static_cast<float>(size * std::sin(angle_rad)) * unit_;
      if (i > 0) stems_.end_segment(stem, center, radius);
      if (i < kSegments) stems_.start_segment(stem, center, radius, turtle.color);
    }
  }

  void add_vertex(const Turtle& turtle) {
    if (polygons_.back().outline.size() >= kMostVertices)
      throw_input_error("got a polygon of more than {} vertices, expected fewer", kMostVertices);
    polygons_.back().outline.push_back(point(turtle.position));
  }

  void fill(const std::vector<Vec3>& outline, PartColor color, std::uint32_t organ) {
    std::vector<Triangle> triangles;
    triangulate(outline, triangles, work_);
    for (const Triangle& triangle : triangles) add_triangle(triangle, color, organ, true);
  }

  void close_polygon(const Turtle& turtle, const Step& step) {
    if (polygons_.empty())
      throw_input_error("module {} of the string: got '}}', expected a '{{' before it", step.module);
    fill(polygons_.back().outline, turtle.color, polygons_.back().organ);
    polygons_.pop_back();
  }

  void move_on(const Turtle& turtle) {
    if (has_frames_) axis_.node = frames_.add_node(axis_.node, point(turtle.position));
  }
  static int label_of(const Step& step) {
    return static_cast<int>(std::clamp(step.value_or(0, 0), -1e9, 1e9));
  }
  void close_edge(const Turtle& turtle, const Step& step) {
    std::vector<Vec3> outline;
    try {
      outline = frames_.close_edge(label_of(step), axis_.node);
    } catch (const TooMuchWork&) {
      throw;
    } catch (const InputError& error) {
      throw_input_error("module {} of the string: {}", step.module, error.what());
    }
    if (outline.size() > kMostVertices)
      throw_input_error("module {} of the string: got a polygon of {} vertices, expected at most {}",
                        step.module, outline.size(), kMostVertices);
    fill(outline, turtle.color, add_organ());
  }

  void add_triangle(const Triangle& triangle, PartColor color, std::uint32_t organ, bool is_plain = false) {
    check_count();
    triangles_.push_back({triangle, color, organ, is_plain});
  }
  void check_count(std::size_t more_leaves = 1, std::size_t more_copied_knots = 0) {
    work_.add(work_of::kLeaf * static_cast<double>(more_leaves) +
              work_of::kKnot * static_cast<double>(more_copied_knots));
    if (triangles_.size() + plant_.leaves.size() + more_leaves > kMostLeaves)
      throw TooManyModules(fmt::format("{}got more than {} leaves and triangles of surfaces, expected fewer",
                                       label(), kMostLeaves));
    if (copied_knots_ + more_copied_knots > kMostCopiedKnots)
      throw TooManyModules(fmt::format("{}got copies of plants with more than {} knots, expected fewer",
                                       label(), kMostCopiedKnots));
  }

  /// A copy of a plant, as if its turtle started with the position and the directions of this one.
  void add_copy(const Turtle& turtle, const JointedPlant& from, double scale, double width) {
    const Plant& plant = from.plant;
    const bool as_leaves = is_copied_as_leaves(plant, settings_.leaf_shape);
    const std::size_t pieces = as_leaves ? 1 : leaf_outline(plant.leaf_shape).triangles.size();
    check_count(pieces * plant.leaves.size(), plant.knots.size());
    copied_knots_ += plant.knots.size();
    const auto metres = [&](const Vector& v, double factor) {
      return Vec3{static_cast<float>(v.x * factor), static_cast<float>(v.y * factor),
                  static_cast<float>(v.z * factor)} *
             unit_;
    };
    const CopyFrame frame{point(turtle.position), metres(turtle.left, -width), metres(turtle.up, -width),
                          metres(turtle.heading, scale)};
    const auto copies = copy_stems(from, frame, axis_.stem >= 0 ? axis_.stem : axis_.parent, stems_);
    const auto first_organ = static_cast<std::uint32_t>(joints_.organs.size());
    copy_organs(from, copies, here(), joints_.organs);
    copy_leaves(from, frame, settings_.leaf_shape, first_organ, plant_.leaves, joints_.organ_of_leaf,
                triangles_);
  }

  /// A surface of triangles, in the frame of a leaf.
  void add_triangles(const Turtle& turtle, const std::vector<Triangle>& surface, double length,
                     double width) {
    const auto x = [&](const Vec3& v) { return turtle.left * (-width * static_cast<double>(v.x)); };
    const auto y = [&](const Vec3& v) { return turtle.heading * (length * static_cast<double>(v.y)); };
    const auto z = [&](const Vec3& v) { return turtle.up * (length * static_cast<double>(v.z)); };
    const std::uint32_t organ = add_organ();
    for (const Triangle& triangle : surface) {
      Triangle placed;
      for (std::size_t k = 0; k < 3; ++k)
        placed[k] = point(turtle.position + x(triangle[k]) + y(triangle[k]) + z(triangle[k]));
      add_triangle(placed, turtle.color, organ);
    }
  }

  const float unit_;
  const Settings& settings_;
  Plant& plant_;
  Work& work_;
  StemSplines stems_;
  Axis axis_;
  std::vector<Axis> stack_;
  std::vector<Polygon> polygons_;  ///< those that are open
  PlantJoints joints_;
  std::vector<ColoredTriangle> triangles_;
  std::size_t copied_knots_ = 0;
  Frames frames_;
  const bool has_frames_;
};

bool has_frames(const SymbolTable& alphabet) {
  for (std::size_t id = 0; id < alphabet.size(); ++id)
    if (alphabet[static_cast<SymbolId>(id)].name == "#") return true;
  return false;
}

}  // namespace

void build_plant(const ModuleString& string, const SymbolTable& alphabet, const Settings& settings,
                 Plant& plant, Work& work, PlantJoints* joints) {
  plant.clear();
  work.add(2 * work_of::kModule * static_cast<double>(string.size()) +
           work_of::kSymbol * static_cast<double>(alphabet.size()));
  try {
    Builder builder(settings, has_frames(alphabet), plant, work);
    TurtleWalk(settings, builder).run(string, alphabet);
    builder.finish();
    if (joints) *joints = std::move(builder.joints());
  } catch (const TooManyModules&) {
    throw;
  } catch (const InputError& error) {
    if (!settings.appearance) throw;
    throw_input_error("{}: {}", settings.appearance->file, error.what());
  }
}

void build_plant(const ModuleString& string, const SymbolTable& alphabet, const Settings& settings,
                 Plant& plant, PlantJoints* joints) {
  Work work(settings.appearance ? settings.appearance->file : "L-system");
  build_plant(string, alphabet, settings, plant, work, joints);
}

}  // namespace espalier::lsystem
