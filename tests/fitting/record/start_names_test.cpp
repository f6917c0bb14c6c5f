// What --start says, and how a preset is left out of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/start_names.h>

namespace espalier {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(StartNames, SayWhereToBegin) {
  EXPECT_EQ(parse_start("auto").source, StartSource::bundled);
  EXPECT_THAT(parse_start("auto").left_out, IsEmpty());
  EXPECT_THAT(parse_start("auto,-acer,-apple").left_out, ElementsAre("acer", "apple"));
  EXPECT_EQ(parse_start("defaults").source, StartSource::defaults);
  EXPECT_EQ(parse_start("random").draws, 1);
  EXPECT_EQ(parse_start("random:12").draws, 12);
  EXPECT_THAT(parse_start("acer,runs/my tree.toml").presets, ElementsAre("acer", "runs/my tree.toml"));
  EXPECT_EQ(parse_start("random.toml").source, StartSource::named);
}

TEST(StartNames, RefuseWhatSaysNothing) {
  for (const char* text : {"", ",", "random:", "random:0", "random:-1", "random:1001", "random:2x",
                           "random:2.5", "auto,acer", "auto,-"})
    EXPECT_THROW(parse_start(text), FieldError) << text;
}

TEST(StartNames, OnlyBundledPresetsAreChosenByTheProgram) {
  for (const char* text : {"auto", "auto,-acer"}) EXPECT_TRUE(is_automatic(parse_start(text))) << text;
  for (const char* text : {"defaults", "random:3", "acer"})
    EXPECT_FALSE(is_automatic(parse_start(text))) << text;
}

TEST(StartNames, LeaveOutAPreset) {
  EXPECT_EQ(start_without("auto", "acer"), "auto,-acer");
  EXPECT_EQ(start_without("auto,-apple", "acer"), "auto,-apple,-acer");
  EXPECT_EQ(start_without("apple,acer,palm", "acer"), "apple,palm");
  EXPECT_EQ(start_without("acer", "acer"), "");
  for (const char* text : {"apple", "defaults", "random:3"}) EXPECT_EQ(start_without(text, "acer"), text);
}

}  // namespace
}  // namespace espalier
