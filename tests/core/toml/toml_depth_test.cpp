// Laws of how deep TOML nests: levels of keys, tables and arrays are counted as the parser makes them, and
// nothing else is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <espalier/core/error.h>
#include <espalier/core/toml/toml_depth.h>
#include <espalier/core/toml/toml_file.h>

namespace espalier {
namespace {

std::string repeated(std::string_view part, long count) {
  std::string text;
  for (long i = 0; i < count; ++i) text += part;
  return text;
}

std::string key_of(long parts) { return "a" + repeated(".a", parts - 1); }

/// Of tables and arrays in each other.
long levels_of(const toml::node& node) {
  long deepest = 0;
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table) deepest = std::max(deepest, 1 + levels_of(value));
  if (const toml::array* array = node.as_array())
    for (const toml::node& value : *array) deepest = std::max(deepest, 1 + levels_of(value));
  return deepest;
}

/// Texts that nest `depth` deep on their third line.
std::vector<std::string> texts_of(long depth) {
  return {
      "\n\n" + key_of(depth) + " = 1.5",
      "\n\n[" + key_of(depth) + "]",
      "\n\n[[" + key_of(depth - 1) + "]]",
      "\n[" + key_of(depth - 1) + "]  # a.a\nb = 1",
      "\n\na = " + repeated("[", depth - 1) + "1.5" + repeated("]", depth - 1),
      "\n\na = " + repeated("{a = ", depth - 1) + "1" + repeated("}", depth - 1),
      "\n[b.c]\na.a = [[2], {" + key_of(depth - 5) + " = 1}]",
      "\n\n'a'.\"b\" . " + key_of(depth - 2) + " = ''",
      "b = [\n1,\n" + repeated("[", depth - 2) + "1" + repeated("]", depth - 2) + "]",
      "b = \"\"\"[[\n\"\\\"]\"\"\"\"\n" + key_of(depth) + " = 1",
      "b = '''\n{ '' { \\''''\n" + key_of(depth) + " = 1",
      "\xef\xbb\xbf[b]\n\n[" + key_of(depth) + "]",
  };
}

TEST(TomlDepth, LevelsUpToTheLimitAreRead) {
  for (const std::string& text : texts_of(kMaxTomlDepth)) {
    EXPECT_EQ(line_of_too_deep_toml(text), std::nullopt) << text;
    EXPECT_EQ(levels_of(parse_toml(text, "deep")), kMaxTomlDepth) << text;
  }
}

TEST(TomlDepth, OneMoreIsRefusedOnItsLine) {
  for (const std::string& text : texts_of(kMaxTomlDepth + 1))
    EXPECT_EQ(line_of_too_deep_toml(text), 3) << text;
}

TEST(TomlDepth, TheMessageSaysWhereAndHowMany) {
  try {
    parse_toml("\n" + key_of(31'000) + " = 1", "my.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "my.toml:2: got keys, tables or arrays nested more than 100 deep, expected fewer levels");
  }
}

TEST(TomlDepth, StringsAndCommentsNestNothing) {
  const std::string deep = repeated("[{", 200) + repeated("a.", 200);
  for (const std::string& text :
       {"a = '" + deep + "'", "a = \"" + deep + "\\\"" + deep + "\"", "# " + deep, "'" + deep + "' = 1",
        "a = '''\n" + deep + "'\n''" + deep + "'''", "a = \"\"\"\n" + deep + "\\\n\\\"\"\"" + deep + "\"\"\"",
        "a = ['" + deep + "', # " + deep + "\n1]"}) {
    EXPECT_EQ(line_of_too_deep_toml(text), std::nullopt) << text;
    EXPECT_NO_THROW(parse_toml(text, "strings")) << text;
  }
}

TEST(TomlDepth, LinesDoNotAddUp) {
  EXPECT_EQ(line_of_too_deep_toml(repeated("[a.b]\nc.d = {e = 1.5, f.g = [1, 2.5]}\n", 500)), std::nullopt);
}

}  // namespace
}  // namespace espalier
