#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <optional>
#include <string>
#include <vector>

#include <espalier/core/near_name.h>

namespace espalier {
namespace {

TEST(ClosestName, IsTheNameItselfWhereItIsKnown) {
  const std::vector<std::string> known = {"ratio", "ratio_power", "rotate"};
  for (const std::string& name : known) EXPECT_EQ(closest_name(name, known), name);
}

TEST(ClosestName, MendsOneWrongLetter) {
  const std::vector<std::string> known = {"quaking_aspen", "weeping_willow", "palm", "acer"};
  EXPECT_TRUE(rc::check([&] {
    std::string name = *rc::gen::elementOf(known);
    const std::string original = name;
    name[*rc::gen::inRange<std::size_t>(0, name.size())] = '#';
    RC_ASSERT(closest_name(name, known) == original);
  }));
}

TEST(ClosestName, CountsExchangedLettersOnce) {
  EXPECT_EQ(closest_name("plam", std::vector<std::string>{"prim", "palm"}), "palm");
}

TEST(ClosestName, IsEmptyWhereNothingIsKnown) { EXPECT_EQ(closest_name("palm", {}), ""); }

TEST(NearName, IsNotFarFromTheWord) {
  const std::vector<std::string> known = {"quaking_aspen", "acer", "palm"};
  EXPECT_EQ(near_name("plam", known), "palm");
  EXPECT_EQ(near_name("qua", known), "quaking_aspen");
  EXPECT_EQ(near_name("pxyz", known), std::nullopt);
  EXPECT_EQ(near_name("q", known), std::nullopt);
  EXPECT_EQ(near_name("acer", {}), std::nullopt);
}

}  // namespace
}  // namespace espalier
