// Bodies of productions in Lua: their comments and operators are Lua's, and surfaces go by their names.
#include <gtest/gtest.h>

#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

#include "support/strings.h"

namespace espalier::lsystem {
namespace {

std::string after_a_step(const std::string& body, const std::string& head = "") {
  return strings_of(head + "axiom: A\nproductions:\n  A --> lua\n" + body, 1).back();
}

Plant plant_after_a_step(const std::string& text) {
  const Grammar grammar = parse_grammar(text, "test.lsys");
  Derivation derivation(grammar);
  derivation.start(1);
  derivation.run(1);
  Plant plant;
  build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
  return plant;
}

TEST(LuaBodies, TakeTheLengthOfATable) {
  EXPECT_EQ(after_a_step("    local t = {1, 2, 3}\n    for i = 1, # t do produce(\"F\") end\n"), "FFF");
  EXPECT_EQ(after_a_step("    local t = {1, 2}  -- # is no comment here\n    produce(\"F\", #t + # t)\n"),
            "F(4)");
  EXPECT_EQ(strings_of("axiom: A(2)\nproductions:\n  A(x) :\n      x > 1 -->\n      lua\n"
                       "        local t = {x}\n        produce(\"F\", # t)\n",
                       1)
                .back(),
            "F(1)");
}

TEST(LuaBodies, AreReadAsTheCodeOfTheFileIs) {
  EXPECT_EQ(strings_of("lua: n = # {1, 2}\n  m = # {1}  -- one\naxiom: A(n,m)\n", 0).back(), "A(2,1)");
}

TEST(LuaBodies, EndWithTheirProduction) {
  EXPECT_EQ(strings_of("axiom: AB\nproductions:\n  A --> lua\n    local t = {1}\n    produce(\"F\", # t)\n"
                       "  # a comment of the file\n  B --> C  # another\n",
                       1)
                .back(),
            "F(1)C");
}

TEST(LuaBodies, PlaceSurfacesByTheirNames) {
  const char* head = "steps: 1\nunit: 2\naxiom: A\nproductions:\n  A --> ";
  const Plant lua = plant_after_a_step(
                  std::string(head) +
                  "lua\n    produce(\"F\", \"~\", \"leaf\", 1, \"F[+~\", \"blossom\", 0.5, 0.2, \"]\")\n"),
              plain = plant_after_a_step(std::string(head) + "F~(\"leaf\",1)F[+~(\"blossom\",0.5,0.2)]\n");
  EXPECT_EQ(lua.leaves.position_m, plain.leaves.position_m);
  EXPECT_EQ(lua.leaves.length_m, plain.leaves.length_m);
  EXPECT_EQ(lua.leaves.width_m, plain.leaves.width_m);
  EXPECT_EQ(lua.leaves.kind, plain.leaves.kind);
  EXPECT_EQ(lua.leaves.size(), 2u);
}

TEST(LuaBodies, PlaceSurfacesOfTheFile) {
  const Plant plant = plant_after_a_step(
      "surface own = \"petal.patch\"\naxiom: A\nproductions:\n  A --> lua\n"
      "    produce(\"~\", \"own\", 1)\n");
  EXPECT_GT(plant.leaves.size(), 2u);
}

}  // namespace
}  // namespace espalier::lsystem
