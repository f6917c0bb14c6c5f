// The table of a fit's options: each row is written, read, checked and named alike, and what is made from the
// rows is made for each of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

#include "support/option_samples.h"
#include "support/temporary_folders.h"

namespace espalier {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

FitRecord whole_record() {
  FitRecord record;
  record.views = {{"/a.png", {}}};
  record.space = "species:2";  // so that all rows are written
  record.target.hints = {.threshold = 0.4,
                         .ground_color = "#ffffff",
                         .tree_color = "#000000",
                         .region = "0,0,90,90",
                         .tree_seeds = "5,5",
                         .ground_seeds = "6,6",
                         .label = "3",
                         .keep_marks = "all",
                         .scale_bar = "10=1",
                         .tree = 2,
                         .frame = 3};
  record.height_m = 7;
  record.search.fixed = {{"levels", 2}};
  record.optimizer_settings = {{"population", 20}};
  record.versions = {{"espalier", "0.1.0"}};
  return record;
}

FitRecord read_text(const std::string& text) {
  const auto path = fresh_folder("options") / "run.toml";
  std::ofstream(path) << text;
  return read_record(path).record;
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

bool is_a_line(const FitOption& option) {
  return type_of(option) != ValueType::assignments && type_of(option) != ValueType::views;
}

std::string last_name(const FitOption& option) {
  return std::string(option.key.substr(option.key.rfind('.') + 1));
}

/// The record's text with another value on the option's line, and the number of that line.
struct Spoiled {
  std::string text;
  long line;
};
Spoiled with_value(const FitOption& option, const std::string& value) {
  std::string text = record_to_toml(whole_record(), {});
  const std::size_t at = text.find("\n" + last_name(option) + " = ") + 1, end = text.find('\n', at);
  text.replace(at, end - at, last_name(option) + " = " + value);
  return {text, 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n')};
}

std::string place_of(const FitOption& option, const Spoiled& spoiled) {
  return fmt::format("run.toml:{}: {}: got ", spoiled.line, option.key);
}

TEST(FitExecution, FieldsKeysAndOptionsAreOnesOwn) {
  std::set<std::string_view> fields, keys, options;
  std::size_t with_option = 0;
  for (const FitOption& option : fit_options()) {
    fields.insert(option.field), keys.insert(option.key);
    if (option.option.empty()) continue;
    options.insert(option.option);
    ++with_option;
  }
  EXPECT_EQ(fields.size(), fit_options().size());
  EXPECT_EQ(keys.size(), fit_options().size());
  EXPECT_EQ(options.size(), with_option);
}

TEST(FitExecution, ARowsValueIsReadWhereItWasSetAndNowhereElse) {
  for (const FitOption& changed : fit_options()) {
    FitRecord record;
    set_value(changed, sample_of(changed).another, record);
    for (const FitOption& option : fit_options())
      EXPECT_EQ(to_words(get_value(option, record)) != to_words(get_value(option, FitRecord{})),
                option.field == changed.field && type_of(option) != ValueType::views)
          << changed.field << " changes " << option.field;
  }
}

TEST(FitExecution, EachValueSurvivesTheFile) {
  for (const FitOption& option : fit_options()) {
    FitRecord record = whole_record();
    if (option.field == "optimizer") record.optimizer_settings.clear();
    set_value(option, sample_of(option).another, record);
    const std::string text = record_to_toml(record, {});
    EXPECT_EQ(record_to_toml(read_text(text), {}), text) << option.key;
  }
}

TEST(FitExecution, AFileIsToldTheLineAndKeyOfAWrongType) {
  for (const FitOption& option : fit_options()) {
    if (!is_a_line(option)) continue;
    const Spoiled spoiled = with_value(option, sample_of(option).of_wrong_type);
    EXPECT_THAT(
        message_of([&] { read_text(spoiled.text); }),
        AllOf(HasSubstr(place_of(option, spoiled)), HasSubstr(", expected " + describe_values(option))));
  }
}

TEST(FitExecution, AFileIsToldTheLineAndKeyOfABadValue) {
  int tried = 0;
  for (const FitOption& option : fit_options())
    for (const std::string& bad : sample_of(option).bad) {
      const Spoiled spoiled = with_value(option, bad);
      EXPECT_THAT(message_of([&] { read_text(spoiled.text); }),
                  AllOf(HasSubstr(place_of(option, spoiled)), HasSubstr("expected")))
          << option.key << " = " << bad;
      ++tried;
    }
  EXPECT_GT(tried, 25);
}

TEST(FitExecution, AFileIsToldTheLineOfAnUnknownKey) {
  for (const FitOption& option : fit_options()) {
    if (!is_a_line(option)) continue;
    Spoiled spoiled = with_value(option, "1");
    const std::string line = "\n" + last_name(option) + " = 1";
    spoiled.text.replace(spoiled.text.find(line), line.size(), "\n" + last_name(option) + "s_ = 1");
    EXPECT_THAT(
        message_of([&] { read_text(spoiled.text); }),
        AllOf(HasSubstr(fmt::format("run.toml:{}: {}s_: got an unknown key", spoiled.line, option.key)),
              HasSubstr("written by espalier 0.1.0"), HasSubstr("'" + std::string(option.key) + "'")));
  }
}

TEST(FitExecution, AFileIsToldOfAMissingKeyUnlessEarlierVersionsHadNone) {
  for (const FitOption& option : fit_options()) {
    if (!is_a_line(option) || option.is_written) continue;
    Spoiled spoiled = with_value(option, "1");
    const std::string line = "\n" + last_name(option) + " = 1";
    spoiled.text.erase(spoiled.text.find(line), line.size());
    const std::size_t check = spoiled.text.find("check = ");  // of a record that nobody changed
    spoiled.text.erase(check, spoiled.text.find('\n', check) + 1 - check);
    const std::string message = message_of([&] { read_text(spoiled.text); });
    EXPECT_THAT(message, option.before ? HasSubstr("no error")
                                       : HasSubstr(fmt::format("run.toml: {}: got nothing", option.key)));
  }
}

TEST(FitExecution, ACallerOfCppIsToldTheField) {
  int tried = 0;
  for (const FitOption& option : fit_options()) {
    if (option.lower == -kUnbounded) continue;
    FitRecord record = whole_record();
    const double outside = option.upper + 1;
    std::visit(
        [&]<typename Type>(Member<Type> member) {
          if constexpr (std::is_arithmetic_v<Type>) member(record) = static_cast<Type>(outside);
          if constexpr (std::is_same_v<Type, std::optional<double>>) member(record) = outside;
        },
        option.member);
    EXPECT_THAT(message_of([&] { check_record(record); }), StartsWith(std::string(option.field) + ": got "));
    ++tried;
  }
  EXPECT_GT(tried, 10);
}

TEST(FitExecution, WordsOfAUserAreReadAsTheFileIs) {
  for (const FitOption& option : fit_options()) {
    if (!is_a_line(option)) continue;
    FitRecord by_words, by_value;
    set_value(option, sample_of(option).another, by_value);
    set_from_words(option, {to_words(sample_of(option).another)}, by_words);
    if (type_of(option) == ValueType::texts) continue;  // whose words come one by one
    EXPECT_EQ(to_words(get_value(option, by_words)), to_words(get_value(option, by_value))) << option.field;
  }
}

TEST(FitExecution, NobodyAsksForWhatIsNone) {
  for (const FitOption& option : fit_options())
    if (option.zero_is_none) {
      FitRecord record;
      EXPECT_THAT(message_of([&] { set_from_words(option, {"0"}, record); }),
                  StartsWith(fmt::format("{}: got 0, expected a", option.field)));
      EXPECT_EQ(message_of([&] { set_value(option, OptionValue(record_zero(option)), record); }), "no error");
    }
}

TEST(FitExecution, SeedsAreWholeNumbersOfSixtyFourBits) {
  const FitOption& seed = *find_option("seed");
  FitRecord record;
  set_from_words(seed, {"18446744073709551615"}, record);
  EXPECT_EQ(record.seed, 18446744073709551615ull);
  for (const char* word : {"-1", "x", "1.5", "0x1", "18446744073709551616"})
    EXPECT_THAT(message_of([&] { set_from_words(seed, {word}, record); }),
                HasSubstr("a whole number from 0"));
}

TEST(FitExecution, FixedParametersAreTakenByNameOfChoiceAndInDecimal) {
  const FitOption& fixed = *find_option("search.fixed");
  FitRecord record;
  set_from_words(fixed, {"leaf_shape=ovate", "curve_v=3", "levels=2", "levels=3"}, record);
  EXPECT_GT(record.search.fixed.at("leaf_shape"), 0);
  EXPECT_EQ(record.search.fixed.at("curve_v"), 3);
  EXPECT_EQ(record.search.fixed.at("levels"), 3) << "the last one counts";
  for (const char* word : {"leaf_shape=0x3", "leaf_shape=elm", "levels=0x2", "levels=9", "levls=2", "levels"})
    EXPECT_THAT(message_of([&] { set_from_words(fixed, {word}, record); }),
                StartsWith("search.fixed: got '"));
}

}  // namespace
}  // namespace espalier
