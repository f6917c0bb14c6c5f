// Plants at random for tests of what moves with what: stems that stand on stems, each with some leaves.
#pragma once
#include <rapidcheck.h>

#include <espalier/core/random.h>
#include <espalier/plant/joints.h>

namespace espalier {

/// Draws of one plant.
class PlantDraws {
 public:
  explicit PlantDraws(Seed seed) : key_(root_key(seed)) {}
  float unit() { return uniform_unit(key_, 1, next_++); }
  float signed_unit() { return 2 * unit() - 1; }
  int below(int n) { return static_cast<int>(unit() * static_cast<float>(n)); }
  Vec3 vector() { return {signed_unit(), signed_unit(), signed_unit()}; }

 private:
  RandomKey key_;
  std::uint32_t next_ = 0;
};

inline StemPlace any_place(const Stems& stems, std::size_t stem, PlantDraws& draws) {
  const std::uint32_t knots = stems.first_knot[stem + 1] - stems.first_knot[stem];
  const auto knot = static_cast<std::uint32_t>(draws.below(static_cast<int>(knots)));
  return {knot, knot + 1 < knots && draws.unit() < 0.5f ? draws.unit() : 0};
}

inline void add_curve(Vec3 base_m, PlantDraws& draws, Plant& plant) {
  const int knots = 2 + draws.below(5);
  const Vec3 heading = normalized(draws.vector() + Vec3{0, 0, 0.8f});
  Vec3 point_m = base_m;
  for (int k = 0; k < knots; ++k) {
    plant.knots.point_m.push_back(point_m);
    plant.knots.handle_in_m.push_back(point_m - heading * 0.2f + draws.vector() * 0.05f);
    plant.knots.handle_out_m.push_back(point_m + heading * 0.2f + draws.vector() * 0.05f);
    plant.knots.radius_m.push_back(0.1f * draws.unit());
    point_m += heading * 0.6f + draws.vector() * 0.3f;
  }
  plant.stems.first_knot.push_back(static_cast<std::uint32_t>(plant.knots.size()));
}

inline void add_leaf(Organ organ, std::uint32_t organ_index, PlantDraws& draws, JointedPlant& jointed) {
  Leaves& leaves = jointed.plant.leaves;
  const Plant& plant = jointed.plant;
  const Vec3 foot_m =
      organ.stem < 0
          ? Vec3{}
          : plant.knots
                .point_m[plant.stems.first_knot[static_cast<std::size_t>(organ.stem)] + organ.place.knot];
  leaves.position_m.push_back(foot_m + draws.vector() * 0.1f);
  leaves.axis.push_back(normalized(draws.vector()));
  leaves.side.push_back(any_perpendicular(leaves.axis.back()));
  leaves.length_m.push_back(0.1f);
  leaves.width_m.push_back(0.05f);
  leaves.kind.push_back(LeafKind::leaf);
  jointed.joints.organ_of_leaf.push_back(organ_index);
}

inline JointedPlant jointed_plant(Seed seed) {
  PlantDraws draws(seed);
  JointedPlant jointed;
  Stems& stems = jointed.plant.stems;
  const int count = 1 + draws.below(14), trunks = 1 + draws.below(2);
  stems.first_knot.push_back(0);
  std::vector<std::uint32_t> children(static_cast<std::size_t>(count) + 1, 0);
  for (int s = 0; s < count; ++s) {
    const int origin = s < trunks ? -1 : draws.below(s);
    const auto on = static_cast<std::size_t>(origin);
    const StemPlace place = origin < 0 ? StemPlace{} : any_place(stems, on, draws);
    const Vec3 base_m =
        origin < 0 ? draws.vector() : jointed.plant.knots.point_m[stems.first_knot[on] + place.knot];
    add_curve(base_m, draws, jointed.plant);
    stems.parent.push_back(origin);
    stems.origin.push_back(origin);
    stems.level.push_back(origin < 0 ? 0 : static_cast<std::uint8_t>(stems.level[on] + 1));
    stems.child_index.push_back(children[static_cast<std::size_t>(origin + 1)]++);
    stems.path_key.push_back(static_cast<std::uint64_t>(s));
    jointed.joints.stem_place.push_back(place);
  }
  const int organs = draws.below(20);
  for (int i = 0; i < organs; ++i) {
    const int stem = draws.below(count + 1) - 1;
    const Organ organ{stem, stem < 0 ? StemPlace{} : any_place(stems, static_cast<std::size_t>(stem), draws)};
    jointed.joints.organs.push_back(organ);
    for (int leaf = draws.below(3); leaf >= 0; --leaf)
      add_leaf(organ, static_cast<std::uint32_t>(i), draws, jointed);
  }
  jointed.plant.tree_scale_m = 3;
  return jointed;
}

inline JointedPlant any_jointed_plant() { return jointed_plant(*rc::gen::arbitrary<std::uint32_t>()); }

}  // namespace espalier
