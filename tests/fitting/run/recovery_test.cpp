// Recovery: the silhouette of a tree with known parameters is fitted from presets of other species. The
// fit gets at least the IoU that the true parameters get with other seeds: more nobody can ask, since
// the picture does not tell a seed's branches from its species'.
#include <gtest/gtest.h>

#include <espalier/fitting/run/fit.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr int kSizePx = 96;
constexpr Seed kTrueSeed = 1000;

/// The known tree: a preset that does not vary in height, and what its silhouettes look like in one frame.
class KnownTree {
 public:
  explicit KnownTree(const std::string& species)
      : preset_(load_preset(species)), model_(model_by_name(preset_.model)) {
    preset_.values[*model_.table().find("g_scale_v")] = 0;
    camera_ = frame_bounds(bounds(grown(kTrueSeed)), {}, kSizePx, kSizePx);
    mask_ = silhouette(kTrueSeed);
  }

  const Mask& mask() const { return mask_; }

  double mean_iou_of_other_seeds(int seeds) const {
    double sum = 0;
    for (int i = 1; i <= seeds; ++i) sum += iou(silhouette(kTrueSeed + static_cast<Seed>(i)), mask_);
    return sum / seeds;
  }

 private:
  Plant grown(Seed seed) const {
    Plant plant;
    model_.generate(preset_.values, seed, {}, plant);
    return plant;
  }
  Mask silhouette(Seed seed) const {
    Mask mask;
    make_embree_renderer()->draw(grown(seed), camera_, mask);
    return mask;
  }

  Preset preset_;
  const Model& model_;
  Camera camera_;
  Mask mask_;
};

/// All bundled presets but one, as a record names them.
std::string presets_without(const std::string& species) {
  std::string names;
  for (const std::string& name : bundled_presets())
    if (name != species) names += name + ",";
  return names;
}

class Recovery : public testing::TestWithParam<std::string> {};

TEST_P(Recovery, AFitFromOtherSpeciesIsAsCloseAsAnotherSeedOfTheTruth) {
  const KnownTree truth(GetParam());
  const fs::path folder = fresh_folder("recovery_" + GetParam());
  write_mask_png(folder / "truth.png", truth.mask());

  FitRecord record;
  record.views = {{folder / "truth.png", {}}};
  record.target.size_px = kSizePx;
  record.budget = {1'500, 0, 0};
  record.growth = {1'500, 6'000};
  record.start = presets_without(GetParam());
  const FitResult result = fit(record, folder / "run");

  EXPECT_GE(result.metrics["iou"], truth.mean_iou_of_other_seeds(10)) << "best start: " << result.best_start;
}

INSTANTIATE_TEST_SUITE_P(Species, Recovery, testing::Values("quaking_aspen", "small_pine", "black_tupelo"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace espalier
