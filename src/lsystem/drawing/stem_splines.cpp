#include <algorithm>

#include <espalier/core/random.h>
#include <espalier/lsystem/drawing/stem_splines.h>

namespace espalier::lsystem {

namespace {

/// Handles of the knots [begin, end) of one stem, from its points.
void write_handles(Knots& knots, std::size_t begin, std::size_t end, bool smooth) {
  for (std::size_t k = begin; k < end; ++k) {
    const Vec3 point = knots.point_m[k];
    const Vec3 before = k > begin ? point - knots.point_m[k - 1] : knots.point_m[k + 1] - point;
    const Vec3 after = k + 1 < end ? knots.point_m[k + 1] - point : before;
    const Vec3 along_before = normalized(before), along_after = normalized(after, along_before);
    const Vec3 tangent = normalized(along_before + along_after, along_after);
    knots.handle_in_m[k] = point - (smooth ? tangent : along_before) * (length(before) / 3);
    knots.handle_out_m[k] = point + (smooth ? tangent : along_after) * (length(after) / 3);
  }
}

}  // namespace

std::int32_t StemSplines::add_stem(std::int32_t parent, StemPlace place) {
  stems_.push_back({.parent = parent, .place = place});
  return static_cast<std::int32_t>(stems_.size() - 1);
}

StemPlace StemSplines::last_knot_of(std::int32_t stem) const {
  const std::uint32_t knots = stem < 0 ? 0 : stems_[static_cast<std::size_t>(stem)].knot_count;
  return {knots > 0 ? knots - 1 : 0, 0};
}

void StemSplines::start_segment(std::int32_t stem, Vec3 point_m, float radius_m, PartColor color) {
  Stem& of = stems_[static_cast<std::size_t>(stem)];
  if (of.last_knot < 0) end_segment(stem, point_m, radius_m);
  Knot& joint = knots_[static_cast<std::size_t>(of.last_knot)];
  // Where the width changes between two segments, their joint has the mean.
  joint.radius_m = (joint.radius_m + radius_m) / 2;
  joint.color = color;
  has_colors_ = has_colors_ || color.is_set;
}

void StemSplines::end_segment(std::int32_t stem, Vec3 point_m, float radius_m) {
  Stem& of = stems_[static_cast<std::size_t>(stem)];
  of.last_knot = static_cast<std::int32_t>(knots_.size());
  ++of.knot_count;
  knots_.push_back({point_m, radius_m, stem, {}});
}

void StemSplines::write(Plant& plant, bool smooth, std::vector<StemPlace>& stem_place) const {
  std::vector<std::uint32_t> next(stems_.size());
  std::vector<std::uint32_t> children(stems_.size(), 0);
  std::uint32_t knot = 0;
  std::uint32_t trunks = 0;
  for (std::size_t s = 0; s < stems_.size(); ++s) {
    const auto parent = static_cast<std::size_t>(stems_[s].parent);
    const bool trunk = stems_[s].parent < 0;
    const std::uint32_t index = trunk ? trunks++ : children[parent]++;
    const RandomKey key = child_key(trunk ? root_key(0) : RandomKey{plant.stems.path_key[parent]}, index);
    plant.stems.first_knot.push_back(knot);
    plant.stems.parent.push_back(stems_[s].parent);
    plant.stems.level.push_back(
        trunk ? 0 : static_cast<std::uint8_t>(std::min(plant.stems.level[parent] + 1, 255)));
    plant.stems.path_key.push_back(key.value);
    plant.stems.origin.push_back(stems_[s].parent);
    plant.stems.child_index.push_back(index);
    stem_place.push_back(stems_[s].place);
    next[s] = knot;
    knot += stems_[s].knot_count;
  }
  plant.stems.first_knot.push_back(knot);
  plant.knots.point_m.resize(knot);
  plant.knots.radius_m.resize(knot);
  plant.knots.handle_in_m.resize(knot);
  plant.knots.handle_out_m.resize(knot);
  if (has_colors_) plant.knots.color.resize(knot);
  for (const Knot& of : knots_) {
    const std::uint32_t place = next[static_cast<std::size_t>(of.stem)]++;
    plant.knots.point_m[place] = of.point_m;
    plant.knots.radius_m[place] = of.radius_m;
    if (has_colors_) plant.knots.color[place] = of.color;
  }
  for (std::size_t s = 0; s < stems_.size(); ++s)
    write_handles(plant.knots, plant.stems.first_knot[s], plant.stems.first_knot[s + 1], smooth);
}

}  // namespace espalier::lsystem
