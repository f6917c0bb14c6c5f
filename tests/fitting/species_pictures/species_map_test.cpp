// The map: all names on it, none over another, and pictures that hold what the layout says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <espalier/fitting/species_pictures/plant_pictures.h>
#include <espalier/fitting/species_pictures/species_map.h>
#include <espalier/fitting/species_space/preset_collection.h>

namespace espalier {
namespace {

using testing::HasSubstr;

const SpeciesMap& bundled_map() {
  static const SpeciesMap kMap = draw_species_map(make_species_space(load_presets({}), "monotone", 2));
  return kMap;
}

/// Half the room a label takes to each side; for those written from left to right.
bool overlap(const ChartLabel& a, const ChartLabel& b) {
  if (a.upwards || b.upwards || a.anchor != TextAnchor::middle || b.anchor != TextAnchor::middle)
    return false;
  const float widths = (text_width_px(a.text) + text_width_px(b.text)) / 2;
  return std::fabs(a.at.x_px - b.at.x_px) < widths && std::fabs(a.at.y_px - b.at.y_px) < 14;
}

TEST(SpeciesMap, NamesEverySpeciesAndItsAxes) {
  std::vector<std::string> texts;
  for (const ChartLabel& label : bundled_map().layout.labels) texts.push_back(label.text);
  const std::vector<Preset> species = load_presets({});
  for (const Preset& one : species) EXPECT_THAT(texts, testing::Contains(one.name));
  EXPECT_THAT(texts, testing::Contains(HasSubstr("component 1: ")));
  EXPECT_THAT(texts, testing::Contains(HasSubstr("component 2: ")));
  EXPECT_EQ(bundled_map().layout.images.size(), species.size());
}

TEST(SpeciesMap, NoLabelLiesOverAnother) {
  const std::vector<ChartLabel>& labels = bundled_map().layout.labels;
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = i + 1; j < labels.size(); ++j)
      EXPECT_FALSE(overlap(labels[i], labels[j])) << labels[i].text << ", " << labels[j].text;
}

TEST(SpeciesMap, EveryTreeShowsAndLiesInThePicture) {
  for (const ChartImage& image : bundled_map().layout.images) {
    EXPECT_GT(std::count_if(image.cover.begin(), image.cover.end(), [](auto cover) { return cover > 128; }),
              100);
    EXPECT_GE(image.upper_left.x_px, 0);
    EXPECT_LE(image.upper_left.x_px + static_cast<float>(image.picture.width_px),
              static_cast<float>(bundled_map().width_px));
  }
}

TEST(SpeciesMap, OfOneComponentIsALine) {
  const SpeciesMap map = draw_species_map(make_species_space(load_presets({"palm", "acer"}), "monotone", 1));
  EXPECT_EQ(map.layout.images.size(), 2u);
}

TEST(PlantPictures, ATileAPlantAndALineOfText) {
  const Model& model = *make_species_space(load_presets({"palm", "acer"}), "raw", 1).model;
  const PlantTile palm{load_preset("palm").values, "palm", 0};
  const Picture picture = tile_picture(model, {{palm, palm, palm}, {palm}}, {.size_px = 64});
  EXPECT_EQ(picture.width_px, 3 * 64 + 2 * 4);
  EXPECT_EQ(picture.height_px, 2 * (64 + 24));
  const auto dark = [&](int left, int top) {
    int count = 0;
    for (int y = top; y < top + 64; ++y)
      for (int x = left; x < left + 64; ++x) count += picture.at(x, y).g < 200;
    return count;
  };
  EXPECT_GT(dark(0, 0), 50);
  EXPECT_GT(dark(136, 0), 50);
  EXPECT_GT(dark(0, 88), 50);
  EXPECT_EQ(dark(136, 88), 0) << "no plant there";
}

}  // namespace
}  // namespace espalier
