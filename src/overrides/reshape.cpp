#include <algorithm>
#include <numeric>

#include <espalier/core/error.h>
#include <espalier/overrides/reshape.h>

namespace espalier {

namespace {

constexpr Vec3 kUp{0, 0, 1};

/// What a change adds to what was measured; an offset alone to its last bit.
float added(const Modification& change, float measured) {
  if (std::isnan(change.replaced_by) && change.factor == 1) return change.offset;
  return change.apply(measured) - measured;
}

/// Where rotations about this direction are counted from.
Vec3 rotation_start(Vec3 direction) {
  const Vec3 from = std::fabs(direction.z) > 0.7f ? Vec3{1, 0, 0} : kUp;
  return normalized(from - direction * dot(direction, from));
}

Vec3 to_vector(AxisPoint p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// sin(x/2) / (x/2): of an arc of this angle, the chord's share of the length.
float chord_share(float angle_deg) {
  const float half_rad = angle_deg * 0.00872664626f;
  return std::fabs(half_rad) < 1e-3f ? 1 : std::sin(half_rad) / half_rad;
}

std::uint32_t most_kept(const Modification& change, std::size_t count) {
  return static_cast<std::uint32_t>(std::clamp(change.apply(static_cast<float>(count)), 0.f, 1e9f));
}

/// 0 · x is 0 only where x is finite: one test for all of them.
void check_finite(const Plant& plant) {
  float sum = 0;
  for (const auto* points : {&plant.knots.point_m, &plant.knots.handle_in_m, &plant.knots.handle_out_m,
                             &plant.leaves.position_m, &plant.leaves.axis, &plant.leaves.side})
    for (const Vec3& p : *points) sum += 0 * (p.x + p.y + p.z);
  for (const float radius_m : plant.knots.radius_m) sum += 0 * radius_m;
  if (sum != 0)
    throw_input_error("overrides of branches make the plant too large, expected less than 1e18 m");
}

}  // namespace

Turn Reshaper::Shape::turn_at(float fraction) const {
  if (!bends()) return turn;
  return turn * turn_about(bend_axis, bend_deg * fraction + bend_back_deg * std::max(0.f, 2 * fraction - 1));
}

/// Along an axis all is turned the shortest way from the direction that grew to the one that is drawn.
Turn Reshaper::turn_along(std::uint32_t stem, const Shape& shape, float fraction) const {
  const Turn bent = shape.turn_at(fraction);
  if (!shape.axis) return bent;
  const Plant& plant = base_.plant;
  const StemPlace place = arcs_.place_at(plant.stems, stem, fraction);
  const AxisPoint drawn = shape.axis_arcs->direction(shape.axis_arcs->place_at(fraction));
  return turn_between(bent(direction_at(plant.stems, plant.knots, stem, place)),
                      shape.axis_frame(to_vector(drawn))) *
         bent;
}

Reshaper::Reshaper(JointedPlant plant)
    : base_(std::move(plant)),
      arcs_(base_.plant),
      stems_on_(base_.plant.stems.size(), base_.plant.stems.size(),
                [&](std::size_t stem) { return base_.plant.stems.origin[stem]; }),
      organs_on_(base_.joints.organs.size(), base_.plant.stems.size(),
                 [&](std::size_t organ) { return base_.joints.organs[organ].stem; }),
      leaves_of_(
          base_.plant.leaves.size(), base_.joints.organs.size(),
          [&](std::size_t leaf) { return static_cast<std::int32_t>(base_.joints.organ_of_leaf[leaf]); }),
      organ_rank_(base_.joints.organs.size()),
      shapes_(base_.plant.stems.size()),
      written_as_(base_.plant.stems.size(), -1) {
  for (std::size_t stem = 0; stem < base_.plant.stems.size(); ++stem) {
    std::uint32_t rank = 0;
    for (const std::uint32_t organ : organs_on_.of(static_cast<std::int32_t>(stem)))
      organ_rank_[organ] = rank++;
  }
  for (auto* column : {&moved_.point_m, &moved_.handle_in_m, &moved_.handle_out_m})
    column->resize(base_.plant.knots.size());
}

/// Fills way_ with the stems that lead to the part, and chosen_ with those of the part.
void Reshaper::choose(const PlantPart* only_part) {
  way_.clear();
  chosen_.clear();
  if (!only_part || only_part->path.empty()) {
    chosen_.resize(base_.plant.stems.size());
    std::iota(chosen_.begin(), chosen_.end(), 0u);
    return;
  }
  std::int32_t at = -1;
  for (const std::uint32_t index : only_part->path) {
    const auto children = stems_on_.of(at);
    const auto child = std::find_if(children.begin(), children.end(), [&](std::uint32_t stem) {
      return base_.plant.stems.child_index[stem] == index;
    });
    if (child == children.end()) return;
    way_.push_back(*child);
    at = static_cast<std::int32_t>(*child);
  }
  chosen_.push_back(way_.back());
  way_.pop_back();
  if (!only_part->alone) choose_all_on_chosen();
  std::sort(chosen_.begin(), chosen_.end());
}

void Reshaper::choose_all_on_chosen() {
  for (std::size_t next = 0; next < chosen_.size(); ++next) {
    const auto children = stems_on_.of(static_cast<std::int32_t>(chosen_[next]));
    chosen_.insert(chosen_.end(), children.begin(), children.end());
  }
}

void Reshaper::shape_stem(std::uint32_t stem, const ChangeGraph* changes) {
  const Stems& stems = base_.plant.stems;
  const std::int32_t origin = stems.origin[stem];
  const std::uint32_t index = stems.child_index[stem];
  const Shape* below = origin < 0 ? nullptr : &shapes_[static_cast<std::size_t>(origin)];
  Shape shape;
  shape.cursor = below ? below->cursor.child(index, position_of(stem)) : ChangeCursor(changes).child(index);
  const BranchChange* change = shape.cursor.change();
  float length_factor = 1;
  shape.is_gone = (below && (below->is_gone || index >= below->most_stems)) || (change && change->removed) ||
                  (change && !change_length(stem, *change, length_factor));
  if (shape.is_gone || (!change && !(below && below->moves))) {
    shapes_[stem] = shape;
    return;
  }
  const Stand stand = stand_of(stem, change);
  shape.turn = stand.turn;
  shape.moves = (below && below->moves) || length_factor != 1;
  if (change) {
    change_direction(stem, *change, stand, shape);
    change_numbers(stem, *change, shape);
    set_axis(stem, stand, shape);
  }
  if (shape.moves) move_knots(stem, shape, stand.new_base_m, length_factor);
  shapes_[stem] = shape;
}

/// Along its origin, as it grew.
float Reshaper::position_of(std::uint32_t stem) const {
  const Stems& stems = base_.plant.stems;
  const auto origin = static_cast<std::size_t>(stems.origin[stem]);
  return arcs_.fraction_at(stems, origin, base_.joints.stem_place[stem]);
}

Reshaper::Stand Reshaper::stand_of(std::uint32_t stem, const BranchChange* change) const {
  const Plant& plant = base_.plant;
  const Stems& stems = plant.stems;
  const Vec3 base_m = point_at(stems, plant.knots, stem, {});
  if (stems.origin[stem] < 0) return {base_m, kUp, base_m, {}};
  const auto origin = static_cast<std::uint32_t>(stems.origin[stem]);
  const StemPlace place = base_.joints.stem_place[stem];
  const Vec3 direction = direction_at(stems, plant.knots, origin, place);
  StemPlace new_place = place;
  Turn turn;
  if (change && !(*change)[Quantity::position].changes_nothing()) {
    const float position = (*change)[Quantity::position].apply(arcs_.fraction_at(stems, origin, place));
    new_place = arcs_.place_at(stems, origin, std::clamp(position, 0.f, 1.f));
    turn = turn_between(direction, direction_at(stems, plant.knots, origin, new_place));
  }
  if (shapes_[origin].moves)
    turn = turn_along(origin, shapes_[origin], arcs_.fraction_at(stems, origin, new_place)) * turn;
  const Vec3 foot_m = point_at(stems, plant.knots, origin, place),
             new_foot_m = point_at(stems, knots_of(origin), origin, new_place);
  return {base_m, direction, new_foot_m + turn(base_m - foot_m), turn};
}

/// False where nothing is left of the stem.
bool Reshaper::change_length(std::uint32_t stem, const BranchChange& change, float& factor) const {
  const Modification& length = change[Quantity::length];
  const float grown_m = arcs_.of_stem_m(base_.plant.stems, stem);
  if (length.changes_nothing() || !(grown_m > 0)) return true;
  factor = length.apply(grown_m) / grown_m;
  return factor > 0;
}

void Reshaper::change_direction(std::uint32_t stem, const BranchChange& change, const Stand& stand,
                                Shape& shape) const {
  const Plant& plant = base_.plant;
  const Stems& stems = plant.stems;
  const StemPlace middle = arcs_.place_at(stems, stem, 0.5f), tip = arcs_.place_at(stems, stem, 1);
  const Vec3 first = direction_at(stems, plant.knots, stem, {}),
             halfway = direction_at(stems, plant.knots, stem, middle),
             last = direction_at(stems, plant.knots, stem, tip), along = stand.direction;
  const Vec3 down_axis = axis_between(along, first);
  const float down_deg = added(change[Quantity::down_angle], angle_about_deg(down_axis, along, first)),
              rotation_deg =
                  added(change[Quantity::rotation], angle_about_deg(along, rotation_start(along), first));
  shape.bend_axis = down_axis;
  shape.bend_deg = added(change[Quantity::curvature], angle_about_deg(down_axis, first, last));
  shape.bend_back_deg = added(change[Quantity::curvature_back], angle_about_deg(down_axis, halfway, last));
  if (rotation_deg != 0) shape.turn = shape.turn * turn_about(along, rotation_deg);
  if (down_deg != 0) shape.turn = shape.turn * turn_about(down_axis, down_deg);
  shape.moves = shape.moves || down_deg != 0 || rotation_deg != 0 || shape.bends() ||
                !change[Quantity::position].changes_nothing();
}

void Reshaper::change_numbers(std::uint32_t stem, const BranchChange& change, Shape& shape) const {
  const Stems& stems = base_.plant.stems;
  const auto key = static_cast<std::int32_t>(stem);
  if (const Modification& count = change[Quantity::child_count]; !count.changes_nothing()) {
    shape.most_stems = most_kept(count, stems_on_.of(key).size());
    shape.most_organs = most_kept(count, organs_on_.of(key).size());
  }
  const Modification& radius = change[Quantity::radius];
  if (radius.changes_nothing() || stems.first_knot[stem] == stems.first_knot[stem + 1]) return;
  const auto radii = base_.plant.knots.radius_m.begin();
  float grown_m = radii[stems.first_knot[stem]];
  if (grown_m == 0)
    grown_m = *std::max_element(radii + stems.first_knot[stem], radii + stems.first_knot[stem + 1]);
  if (grown_m > 0) shape.radius_factor = std::max(0.f, radius.apply(grown_m) / grown_m);
}

/// An axis says all of the stem's form: nothing bends it further.
void Reshaper::set_axis(std::uint32_t stem, const Stand& stand, Shape& shape) const {
  shape.axis = shape.cursor.axis();
  if (!shape.axis) return;
  shape.axis_arcs.emplace(shape.axis->curve);
  shape.moves = true;
  shape.bend_deg = shape.bend_back_deg = 0;
  if (shape.axis->frame == AxisFrame::world) return;
  shape.axis_frame = shape.turn;
  if (base_.plant.stems.origin[stem] < 0) return;
  const Vec3 first = direction_at(base_.plant.stems, base_.plant.knots, stem, {});
  const Vec3 away = cross(axis_between(stand.direction, first), first);
  shape.axis_frame = shape.turn * Turn{cross(away, first), away, first};
}

/// As the axis is drawn, in the size of the stem.
void Reshaper::draw_knots(std::uint32_t stem, const Shape& shape, Vec3 base_m, float factor) {
  const Knots& from = base_.plant.knots;
  const float whole_m = arcs_.of_stem_m(base_.plant.stems, stem);
  const float metres = whole_m * factor / static_cast<float>(shape.axis_arcs->length());
  for (std::size_t k = base_.plant.stems.first_knot[stem]; k < base_.plant.stems.first_knot[stem + 1]; ++k) {
    const float fraction = whole_m > 0 ? arcs_.at_knot_m(k) / whole_m : 0;
    const AxisPoint drawn = axis_point(shape.axis->curve, shape.axis_arcs->place_at(fraction));
    const Turn turn = turn_along(stem, shape, fraction);
    moved_.point_m[k] = base_m + shape.axis_frame(to_vector(drawn)) * metres;
    moved_.handle_in_m[k] = moved_.point_m[k] + turn(from.handle_in_m[k] - from.point_m[k]) * factor;
    moved_.handle_out_m[k] = moved_.point_m[k] + turn(from.handle_out_m[k] - from.point_m[k]) * factor;
  }
}

void Reshaper::move_knots(std::uint32_t stem, const Shape& shape, Vec3 base_m, float factor) {
  if (shape.axis) return draw_knots(stem, shape, base_m, factor);
  const Knots& from = base_.plant.knots;
  const std::size_t first = base_.plant.stems.first_knot[stem], end = base_.plant.stems.first_knot[stem + 1];
  const float whole_m = arcs_.of_stem_m(base_.plant.stems, stem);
  const auto fraction = [&](float at_m) { return whole_m > 0 ? at_m / whole_m : 0; };
  Vec3 point_m = base_m;
  for (std::size_t k = first; k < end; ++k) {
    const float at_m = arcs_.at_knot_m(k);
    const Turn turn = shape.turn_at(fraction(at_m));
    moved_.point_m[k] = point_m;
    moved_.handle_in_m[k] = point_m + turn(from.handle_in_m[k] - from.point_m[k]) * factor;
    moved_.handle_out_m[k] = point_m + turn(from.handle_out_m[k] - from.point_m[k]) * factor;
    if (k + 1 == end) break;
    const float next_m = arcs_.at_knot_m(k + 1), middle = fraction((at_m + next_m) / 2);
    const float here_deg = shape.bend_deg + (middle > 0.5f ? 2 * shape.bend_back_deg : 0);
    const Vec3 chord_m = shape.turn_at(middle)(from.point_m[k + 1] - from.point_m[k]);
    point_m += chord_m * (factor * chord_share(here_deg * fraction(next_m - at_m)));
  }
}

bool Reshaper::is_borne(std::uint32_t organ) const {
  const std::int32_t stem = base_.joints.organs[organ].stem;
  if (stem < 0) return true;
  const Shape& on = shapes_[static_cast<std::size_t>(stem)];
  return !on.is_gone && organ_rank_[organ] < on.most_organs;
}

void Reshaper::choose_leaves(const PlantPart* only_part) {
  chosen_leaves_.clear();
  const std::vector<std::uint32_t>& organs = base_.joints.organ_of_leaf;
  if (!only_part || only_part->path.empty()) {
    for (std::uint32_t leaf = 0; leaf < organs.size(); ++leaf)
      if (is_borne(organs[leaf])) chosen_leaves_.push_back(leaf);
    return;
  }
  for (const std::uint32_t stem : chosen_) choose_leaves_on(static_cast<std::int32_t>(stem));
  if (only_part->path == BranchPath{0}) choose_leaves_on(-1);
}

void Reshaper::choose_leaves_on(std::int32_t stem) {
  for (const std::uint32_t organ : organs_on_.of(stem)) {
    if (!is_borne(organ)) continue;
    const auto leaves = leaves_of_.of(static_cast<std::int32_t>(organ));
    chosen_leaves_.insert(chosen_leaves_.end(), leaves.begin(), leaves.end());
  }
}

void Reshaper::write_stem(std::uint32_t stem, Plant& shaped) {
  const Stems& from = base_.plant.stems;
  Stems& to = shaped.stems;
  const auto written = [&](std::int32_t old) {
    return old < 0 ? -1 : written_as_[static_cast<std::size_t>(old)];
  };
  written_as_[stem] = static_cast<std::int32_t>(to.size());
  to.parent.push_back(written(from.parent[stem]));
  to.level.push_back(from.level[stem]);
  to.path_key.push_back(from.path_key[stem]);
  to.origin.push_back(written(from.origin[stem]));
  to.child_index.push_back(from.child_index[stem]);
  const auto first = static_cast<std::ptrdiff_t>(from.first_knot[stem]),
             end = static_cast<std::ptrdiff_t>(from.first_knot[stem + 1]);
  const auto append = [&](auto& column, const auto& source) {
    column.insert(column.end(), source.begin() + first, source.begin() + end);
  };
  const Knots &old = base_.plant.knots, &points = knots_of(stem);
  Knots& knots = shaped.knots;
  append(knots.point_m, points.point_m);
  append(knots.handle_in_m, points.handle_in_m);
  append(knots.handle_out_m, points.handle_out_m);
  append(knots.radius_m, old.radius_m);
  if (!old.color.empty()) append(knots.color, old.color);
  if (const float factor = shapes_[stem].radius_factor; factor != 1)
    std::for_each(knots.radius_m.end() - (end - first), knots.radius_m.end(),
                  [&](float& radius_m) { radius_m *= factor; });
  to.first_knot.push_back(static_cast<std::uint32_t>(knots.size()));
}

void Reshaper::write_leaf(std::uint32_t leaf, Plant& shaped) const {
  const Leaves& from = base_.plant.leaves;
  Leaves& to = shaped.leaves;
  Vec3 position_m = from.position_m[leaf], axis = from.axis[leaf], side = from.side[leaf];
  const Organ& organ = base_.joints.organs[base_.joints.organ_of_leaf[leaf]];
  const auto stem = static_cast<std::uint32_t>(organ.stem);
  if (organ.stem >= 0 && shapes_[stem].moves) {
    const Stems& stems = base_.plant.stems;
    const Turn turn = turn_along(stem, shapes_[stem], arcs_.fraction_at(stems, stem, organ.place));
    position_m = point_at(stems, moved_, stem, organ.place) +
                 turn(position_m - point_at(stems, base_.plant.knots, stem, organ.place));
    axis = normalized(turn(axis));
    side = normalized(turn(side));
  }
  to.position_m.push_back(position_m);
  to.axis.push_back(axis);
  to.side.push_back(side);
  to.length_m.push_back(from.length_m[leaf]);
  to.width_m.push_back(from.width_m[leaf]);
  to.kind.push_back(from.kind[leaf]);
  if (!from.color.empty()) to.color.push_back(from.color[leaf]);
  if (!from.shade.empty()) to.shade.push_back(from.shade[leaf]);
}

void Reshaper::reshape(const ChangeGraph* changes, const PlantPart* only_part, Plant& shaped,
                       std::vector<ChangeCursor>* stem_cursors) {
  shaped.clear();
  shaped.leaf_shape = base_.plant.leaf_shape;
  shaped.blossom_shape = base_.plant.blossom_shape;
  shaped.tree_scale_m = base_.plant.tree_scale_m;
  choose(only_part);
  for (const std::uint32_t stem : way_) {
    shape_stem(stem, changes);
    written_as_[stem] = -1;
  }
  for (const std::uint32_t stem : chosen_) shape_stem(stem, changes);
  choose_leaves(only_part);
  shaped.stems.first_knot.push_back(0);
  for (const std::uint32_t stem : chosen_)
    if (!shapes_[stem].is_gone) write_stem(stem, shaped);
  for (const std::uint32_t leaf : chosen_leaves_) write_leaf(leaf, shaped);
  if (stem_cursors && changes)
    for (const std::uint32_t stem : chosen_)
      if (!shapes_[stem].is_gone) stem_cursors->push_back(shapes_[stem].cursor);
  check_finite(shaped);
}

}  // namespace espalier
