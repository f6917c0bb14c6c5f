// Numbers of the command line are what people write, or are refused: never another number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <espalier/app/options/plain_numbers.h>

namespace espalier {
namespace {

struct Numbers {
  std::uint64_t seed = 0;
  int count = 0;
  double size = 0;
  std::string text;
};

/// "" where the words are taken, else the first complaint.
std::string complaint(std::vector<std::string> words, Numbers& numbers) {
  CLI::App app;
  CLI::App* command = app.add_subcommand("do", "");
  command->add_option("--seed", numbers.seed);
  command->add_option("--count", numbers.count);
  command->add_option("--size", numbers.size);
  command->add_option("--text", numbers.text)->type_name("INT");
  demand_plain_numbers(app);
  std::reverse(words.begin(), words.end());
  words.emplace_back("do");
  try {
    app.parse(std::move(words));
    return "";
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
}

std::string complaint(const std::string& word) {
  Numbers ignored;
  return complaint({word}, ignored);
}

TEST(PlainNumbers, AreTaken) {
  Numbers numbers;
  EXPECT_EQ(complaint({"--seed=18446744073709551615", "--count=-12", "--size=-1.5e-3"}, numbers), "");
  EXPECT_EQ(numbers.seed, 18446744073709551615u);
  EXPECT_EQ(numbers.count, -12);
  EXPECT_EQ(numbers.size, -1.5e-3);
  EXPECT_EQ(complaint({"--seed=+010", "--count=010", "--size=+010"}, numbers), "");
  EXPECT_EQ(numbers.seed, 10u) << "in C it is 8";
  EXPECT_EQ(numbers.count, 10);
  EXPECT_EQ(numbers.size, 10);
}

TEST(PlainNumbers, OthersAreRefused) {
  for (const char* word : {"-1", "0x10", "1e3", "18446744073709551616", " 1", "1 2", "nan", "٣"})
    EXPECT_THAT(complaint(std::string("--seed=") + word), testing::HasSubstr(word)) << word;
  for (const char* word : {"4294967297", "0x10", "1e3", "-9223372036854775809", "1.5", " 1"})
    EXPECT_NE(complaint(std::string("--count=") + word), "") << word;
  for (const char* word : {"nan", "NaN", "-nan", "inf", "-Infinity", "1e999", "0x10", "0x1p3", " 1", "1 "})
    EXPECT_NE(complaint(std::string("--size=") + word), "") << word;
}

TEST(PlainNumbers, WordsAreLeftToTheOption) {
  Numbers numbers;
  EXPECT_EQ(complaint({"--text=auto"}, numbers), "");
  EXPECT_EQ(numbers.text, "auto");
}

}  // namespace
}  // namespace espalier
