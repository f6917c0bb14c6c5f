// Silhouettes of a few species against the pictures in tests/golden/: a change of growth or rendering that
// moves more than edge pixels is seen here. Where the change is meant, write them anew and look at them:
//   ESPALIER_UPDATE_GOLDEN=1 build/tests/test_render --gtest_filter='Golden*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <espalier/image/measures/compare.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {
namespace {

constexpr int kSizePx = 128;
constexpr double kSmallestIou = 0.98;  // instruction sets round edge pixels differently

Mask silhouette_of(const std::string& species) {
  const Preset preset = load_preset(species);
  Plant plant;
  model_by_name(preset.model).generate(preset.values, 1, {}, plant);
  Mask mask;
  make_embree_renderer()->draw(plant, frame_bounds(bounds(plant), {}, kSizePx, kSizePx), mask);
  return mask;
}

Mask read_golden(const std::filesystem::path& path) {
  const DecodedPicture picture = decode_picture(path);
  Mask mask(picture.width_px, picture.height_px);
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) mask.set(x, y, picture.at(x, y)[0] > 0.5f);
  return mask;
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, SilhouetteIsAsItWas) {
  const auto path =
      std::filesystem::path(ESPALIER_SOURCE_DIR) / "tests" / "golden" / (GetParam() + "_seed1.png");
  const Mask drawn = silhouette_of(GetParam());
  if (std::getenv("ESPALIER_UPDATE_GOLDEN") != nullptr) {
    std::filesystem::create_directories(path.parent_path());
    write_mask_png(path, drawn);
    GTEST_SKIP() << "written anew: " << path;
  }
  const Mask golden = read_golden(path);
  ASSERT_EQ(golden.width_px(), kSizePx);
  ASSERT_EQ(golden.height_px(), kSizePx);
  EXPECT_GT(iou(drawn, golden), kSmallestIou);
}

INSTANTIATE_TEST_SUITE_P(Species, Golden,
                         testing::Values("quaking_aspen", "lombardy_poplar", "small_pine", "palm", "bamboo",
                                         "apple"),
                         [](const auto& species) { return species.param; });

}  // namespace
}  // namespace espalier
