// Laws of the unit outlines: published widths and areas, triangles that tile the boundary, cups of a size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/plant/leaf_outlines.h>

namespace espalier {
namespace {

struct Published {
  int shape;
  double width, area;
};

// Width and area at length 1, of the published implementation's outlines.
const Published kPublished[] = {{1, 0.50, 0.28}, {2, 0.20, 0.17}, {3, 0.70, 0.36}, {4, 1.0, 0.45},
                                {5, 1.0, 0.37},  {6, 0.64, 0.29}, {7, 0.50, 0.28}, {8, 0.50, 0.30},
                                {9, 1.0, 1.0},   {10, 1.0, 0.5}};

double extent(const LeafOutline& outline, float Vec3::*axis) {
  const auto [low, high] = std::minmax_element(outline.vertices.begin(), outline.vertices.end(),
                                               [=](Vec3 a, Vec3 b) { return a.*axis < b.*axis; });
  return (*high).*axis - (*low).*axis;
}

double boundary_area(const LeafOutline& outline) {
  double twice_area = 0;
  for (std::size_t i = 0; i < outline.vertices.size(); ++i) {
    const Vec3 a = outline.vertices[i], b = outline.vertices[(i + 1) % outline.vertices.size()];
    twice_area += double{a.x} * b.y - double{a.y} * b.x;
  }
  return twice_area / 2;
}

double triangle_area(const LeafOutline& outline, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3 a = outline.vertices[triangle[0]], b = outline.vertices[triangle[1]],
             c = outline.vertices[triangle[2]];
  return 0.5 * cross(b - a, c - a).z;
}

TEST(LeafOutlines, HaveThePublishedWidthAndArea) {
  for (const auto& [shape, width, area] : kPublished) {
    SCOPED_TRACE(shape);
    EXPECT_NEAR(extent(leaf_outline(shape), &Vec3::x), width, 0.02 * width);
    EXPECT_NEAR(boundary_area(leaf_outline(shape)), area, 0.02 * area);
  }
}

TEST(LeafOutlines, AreFlatAndReachFromStalkToLengthOne) {
  for (int shape = 0; shape <= 10; ++shape) {
    SCOPED_TRACE(shape);
    const LeafOutline& outline = leaf_outline(shape);
    EXPECT_EQ(extent(outline, &Vec3::z), 0);
    float lowest = 1, highest = 0;
    for (const Vec3 v : outline.vertices) {
      lowest = std::min(lowest, v.y);
      highest = std::max(highest, v.y);
    }
    EXPECT_EQ(lowest, 0);
    EXPECT_EQ(highest, 1);
  }
}

TEST(LeafOutlines, AreSymmetric) {
  for (int shape = 0; shape <= 10; ++shape) {
    const auto& vertices = leaf_outline(shape).vertices;
    for (const Vec3 v : vertices)
      EXPECT_NE(std::find(vertices.begin(), vertices.end(), Vec3{-v.x, v.y, v.z}), vertices.end()) << shape;
  }
}

TEST(LeafOutlines, TrianglesTileTheBoundary) {
  for (int shape = 0; shape <= 10; ++shape) {
    SCOPED_TRACE(shape);
    const LeafOutline& outline = leaf_outline(shape);
    EXPECT_EQ(outline.triangles.size(), outline.vertices.size() - 2);
    double area = 0;
    for (const auto& triangle : outline.triangles) {
      EXPECT_GT(triangle_area(outline, triangle), 0);
      area += triangle_area(outline, triangle);
    }
    EXPECT_NEAR(area, boundary_area(outline), 1e-5);
  }
}

TEST(LeafOutlines, ShapeZeroIsElliptic) { EXPECT_EQ(&leaf_outline(0), &leaf_outline(8)); }

TEST(LeafOutlines, UnknownShapesAreRefused) {
  EXPECT_THROW(leaf_outline(11), InternalError);
  EXPECT_THROW(leaf_outline(-1), InternalError);
  EXPECT_THROW(blossom_outline(0), InternalError);
  EXPECT_THROW(blossom_outline(4), InternalError);
}

TEST(Blossoms, AreCupsOfTheStatedSize) {
  for (int shape = 1; shape <= 3; ++shape) {
    SCOPED_TRACE(shape);
    const LeafOutline& cup = blossom_outline(shape);
    EXPECT_NEAR(extent(cup, &Vec3::x), 1.3, 0.1);
    EXPECT_NEAR(extent(cup, &Vec3::z), 1.3, 0.1);
    EXPECT_GE(extent(cup, &Vec3::y), 0.499);
    EXPECT_LE(extent(cup, &Vec3::y), 0.701);
    for (const auto& triangle : cup.triangles)
      for (const std::uint32_t corner : triangle) EXPECT_LT(corner, cup.vertices.size());
  }
}

TEST(Blossoms, OpenAwayFromTheStalk) {
  for (int shape = 1; shape <= 3; ++shape)
    for (const Vec3 v : blossom_outline(shape).vertices)
      EXPECT_NEAR(v.y > 0.4, std::hypot(v.x, v.z) > 0.6, 0) << shape;
}

}  // namespace
}  // namespace espalier
