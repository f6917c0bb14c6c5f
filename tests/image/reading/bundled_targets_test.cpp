// The pictures in targets/: each may ship (its sidecar says so) and shows a tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <espalier/core/toml/toml_file.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/image/reading/roots.h>

namespace espalier {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in_targets(const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(ESPALIER_SOURCE_DIR "/targets"))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class BundledTarget : public testing::TestWithParam<fs::path> {
 protected:
  toml::table read_sidecar() {
    fs::path path = GetParam();
    path.replace_extension(".toml");
    return parse_toml(read_toml_text(path), path.string());
  }
};

TEST_P(BundledTarget, SidecarSaysWhereItIsFromAndThatItMayShip) {
  const toml::table sidecar = read_sidecar();
  EXPECT_NE(sidecar["title"].value_or(std::string()), "");
  EXPECT_NE(sidecar["source"].value_or(std::string()), "");
  EXPECT_THAT(
      sidecar["licence"].value_or(std::string()),
      testing::AnyOf("public domain", "CC0-1.0", "made for this project, under its licence (Apache-2.0)"));
  EXPECT_EQ(sidecar["camera"]["projection"].value_or(std::string()), "orthographic");
  EXPECT_EQ(sidecar["camera"]["view"].value_or(std::string()), "front");
}

TEST_P(BundledTarget, SidecarTellsTheTruthWhereItIsKnown) {
  const std::string name = GetParam().stem().string();
  const toml::table sidecar = read_sidecar();
  const bool known = name.starts_with("reference_");
  EXPECT_EQ(sidecar.contains("truth"), known);
  if (!known) return;
  const std::string species = sidecar["truth"]["species"].value_or(std::string());
  EXPECT_EQ("reference_" + species, name);
  EXPECT_TRUE(fs::exists(ESPALIER_SOURCE_DIR "/src/weber_penn/species/" + species + ".toml"));
  EXPECT_EQ(sidecar["truth"]["tree"].value_or(0), 1);
}

TEST_P(BundledTarget, GivesASaneMask) {
  const TargetPicture target = read_target(GetParam());
  const double share = static_cast<double>(area_px(target.mask)) / (256.0 * 256.0);
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 0.6);
  EXPECT_GT(target.tree_height_px, 0.5f * 256);
  const Mask straight = without_roots(target.mask);
  EXPECT_TRUE(straight.get(128, static_cast<int>(base_row_px(256)) - 2)) << "the trunk stands in the middle";
  for (int x = 0; x < 256; ++x) {
    EXPECT_FALSE(target.mask.get(x, 0));
    EXPECT_FALSE(target.mask.get(x, 255));
  }
}

/// FNV-1a over the bits of the masks of 512 pixels, as fits see them at last: recorded fits of these pictures
/// repeat only while their masks keep their bits.
TEST_P(BundledTarget, MaskKeepsItsBits) {
  static const std::map<std::string, std::uint64_t> kHashes = {
      {"fir", 0x6c337aa39291dc86ull},
      {"oc_cypress", 0x0f6a154c39e47edaull},
      {"oc_evergreen", 0x4ac55278a05db031ull},
      {"oc_orange", 0x495a3b5eb9fad9dfull},
      {"oc_palm", 0xa312cc610acee3eaull},
      {"oc_roundcrown", 0xebd433c24b768266ull},
      {"oc_rpg01", 0x616585a0500bac26ull},
      {"oc_rpg11", 0x5fd36e8472120e2eull},
      {"reference_apple", 0x30487837f25928d2ull},
      {"reference_lombardy_poplar", 0x8abaac1cddcf3321ull},
      {"reference_palm", 0xdd7999aceebe6afeull},
      {"reference_quaking_aspen", 0x3748569edec33db7ull},
      {"reference_small_pine", 0x23980e090d357028ull},
      {"reference_weeping_willow", 0x5f725230515cc7a0ull},
      {"snowy_tree", 0x47f07477c64787fbull},
      {"tr_birch", 0x44c374f7fc7f1bafull},
      {"tr_blandbirch", 0xd4ff9339c5025951ull},
      {"tr_crookedtree4", 0xdd124debd6d30d1aull},
      {"tr_fir", 0x2fc704f13d92b68dull},
      {"tr_horsechestnuttree", 0x6ed5ba50c10c1932ull},
      {"tr_palmtree2", 0x8d60e7412c7d3afdull},
      {"tr_peartree", 0x80fb297e8d3c91e7ull},
      {"tr_snowytree", 0x621fbb0827250054ull}};
  std::uint64_t hash = 0xcbf29ce484222325ull;
  const TargetPicture target = read_target(GetParam(), {.size_px = 512, .one_tree = true});
  for (std::uint64_t word : target.mask.words())
    for (int i = 0; i < 8; ++i, word >>= 8) hash = (hash ^ (word & 0xff)) * 0x100000001b3ull;
  const auto known = kHashes.find(GetParam().stem().string());
  ASSERT_NE(known, kHashes.end());
  EXPECT_EQ(hash, known->second);
}

INSTANTIATE_TEST_SUITE_P(Targets, BundledTarget, testing::ValuesIn(files_in_targets(".png")),
                         [](const auto& info) { return info.param.stem().string(); });

TEST(BundledTargets, EveryPictureHasASidecarAndTheReverse) {
  std::set<std::string> pictures, sidecars;
  for (const fs::path& path : files_in_targets(".png")) pictures.insert(path.stem());
  for (const fs::path& path : files_in_targets(".toml")) sidecars.insert(path.stem());
  EXPECT_EQ(pictures, sidecars);
  EXPECT_GE(pictures.size(), 23u);
}

TEST(BundledTargets, TheCutOutFirIsTheFirOfTheMask) {
  const Mask fir = read_target(ESPALIER_SOURCE_DIR "/targets/fir.png").mask;
  const Mask same = read_target(ESPALIER_SOURCE_DIR "/targets/tr_fir.png").mask;
  EXPECT_GT(iou(fir, same), 0.9);
}

}  // namespace
}  // namespace espalier
