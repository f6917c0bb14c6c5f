#include <algorithm>
#include <cmath>

#include <espalier/fitting/posterior/simulations/plant_quantities.h>
#include <espalier/fitting/posterior/simulations/plant_simulator.h>
#include <espalier/fitting/posterior/simulations/silhouette_summaries.h>
#include <espalier/image/reading/frame.h>
#include <espalier/render/camera.h>
#include <espalier/render/scanlines/scanline_renderer.h>

namespace espalier {

namespace {

/// Species have 250,000 leaves at most; the few draws beyond are drawn again.
constexpr GrowthBudget kBudget{.max_stems = 100'000, .max_leaves = 400'000};

/// How far the plant reaches: its knots with their radii and the tips of its leaves, which is close enough
/// for a frame.
struct Reach {
  float lowest_m = 0, highest_m = 0, half_width_m = 0;

  void add(Vec3 point, float radius_m) {
    lowest_m = std::min(lowest_m, point.z);
    highest_m = std::max(highest_m, point.z);
    half_width_m = std::max(half_width_m, std::fabs(point.x) + radius_m);
  }
};

Reach reach_of(const Plant& plant) {
  Reach reach;
  for (std::size_t k = 0; k < plant.knots.size(); ++k)
    reach.add(plant.knots.point_m[k], plant.knots.radius_m[k]);
  for (std::size_t i = 0; i < plant.leaves.size(); ++i)
    reach.add(plant.leaves.position_m[i] + plant.leaves.axis[i] * plant.leaves.length_m[i], 0);
  return reach;
}

/// As a picture of the plant is framed (image/reading/frame.h).
Camera camera_of(const Reach& reach) {
  const float tall_m = reach.highest_m - reach.lowest_m;
  const float metres_per_frame = std::max(tall_m / kFramedHeight, reach.half_width_m / kFramedHalfWidth);
  return frame_base({0, 0, reach.lowest_m}, View{}, metres_per_frame / kSummaryFramePx, kSummaryFramePx,
                    kSummaryFramePx, base_row_px(kSummaryFramePx));
}

}  // namespace

std::vector<Unknown> unknowns_of(const PlantPrior& prior) {
  std::vector<Unknown> unknowns;
  for (const std::size_t row : prior.rows()) {
    const ParameterInfo& info = prior.model().table().rows[row];
    unknowns.push_back({info.full_name(), info.unit, false});
  }
  for (const PlantQuantity& quantity : kPlantQuantities)
    unknowns.push_back({quantity.name, quantity.unit, true});
  return unknowns;
}

PlantSimulator::PlantSimulator(const PlantPrior& prior, double height_m)
    : prior_(prior), height_m_(height_m), renderer_(make_scanline_renderer()) {}

bool PlantSimulator::simulate(const PlantDraw& draw, Simulation& simulation) {
  const GrowthSettings settings{.budget = kBudget};
  if (!prior_.model().generate(draw.values, draw.seed, settings, plant_).grown) return false;
  const Reach reach = reach_of(plant_);
  const auto lowest_m = static_cast<double>(reach.lowest_m),
             tall_m = static_cast<double>(reach.highest_m) - lowest_m;
  if (!(tall_m > 0)) return false;
  renderer_->draw(plant_, camera_of(reach), mask_);
  if (area_px(mask_) == 0) return false;
  simulation.summaries = summaries_of(mask_);
  simulation.unknowns.clear();
  for (const std::size_t row : prior_.rows()) simulation.unknowns.push_back(draw.values[row]);
  const std::vector<double> quantities = quantities_of(plant_, lowest_m, tall_m, height_m_);
  simulation.unknowns.insert(simulation.unknowns.end(), quantities.begin(), quantities.end());
  return true;
}

}  // namespace espalier
