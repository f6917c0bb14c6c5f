// Fits of known trees do not begin at the answer.
#include <gtest/gtest.h>

#include <espalier/core/field_error.h>
#include <espalier/experiments/declaration/known_truth.h>

namespace espalier {
namespace {

TEST(KnownTruth, IsNoStart) {
  EXPECT_EQ(start_beside_truth("auto", "acer"), "auto,-acer");
  EXPECT_EQ(start_beside_truth("auto,-acer", "acer"), "auto,-acer");
  EXPECT_EQ(start_beside_truth("apple,acer", "acer"), "apple");
  EXPECT_EQ(start_beside_truth("random:4", "acer"), "random:4");
  EXPECT_EQ(start_beside_truth("defaults", "acer"), "defaults");
}

TEST(KnownTruth, OfPicturesAndOwnFilesIsNotKnown) {
  EXPECT_EQ(start_beside_truth("auto", ""), "auto");
  EXPECT_EQ(start_beside_truth("auto", "my/tree.toml"), "auto");
}

TEST(KnownTruth, AloneIsRefused) {
  EXPECT_THROW(start_beside_truth("acer", "acer"), FieldError);
  EXPECT_THROW(start_beside_truth("defaults", "quaking_aspen"), FieldError)
      << "the table's defaults are its values";
}

}  // namespace
}  // namespace espalier
