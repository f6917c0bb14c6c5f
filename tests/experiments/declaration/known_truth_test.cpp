// Fits of known trees do not begin at the answer.
#include <gtest/gtest.h>

#include <espalier/core/field_error.h>
#include <espalier/experiments/declaration/known_truth.h>

namespace espalier {
namespace {

std::string beside(const std::string& start, const std::string& species) {
  return start_beside_truth(start, species, "weber_penn");
}

TEST(KnownTruth, IsNoStart) {
  EXPECT_EQ(beside("auto", "acer"), "auto,-acer");
  EXPECT_EQ(beside("auto,-acer", "acer"), "auto,-acer");
  EXPECT_EQ(beside("apple,acer", "acer"), "apple");
  EXPECT_EQ(beside("random:4", "acer"), "random:4");
  EXPECT_EQ(beside("defaults", "acer"), "defaults");
}

TEST(KnownTruth, OfPicturesAndOwnFilesIsNotKnown) {
  EXPECT_EQ(beside("auto", ""), "auto");
  EXPECT_EQ(beside("auto", "my/tree.toml"), "auto");
}

TEST(KnownTruth, AloneIsRefused) {
  EXPECT_THROW(beside("acer", "acer"), FieldError);
  EXPECT_THROW(beside("defaults", "quaking_aspen"), FieldError) << "the table's defaults are its values";
}

TEST(KnownTruth, OfAnotherModelThanTheSpeciesIsNoStart) {
  EXPECT_EQ(start_beside_truth("defaults", "quaking_aspen", "small_pine.lsys"), "defaults");
  EXPECT_EQ(start_of_model("auto", "small_pine.lsys"), "defaults") << "as espalier fit begins";
  EXPECT_EQ(start_of_model("auto", "weber_penn"), "auto");
}

}  // namespace
}  // namespace espalier
