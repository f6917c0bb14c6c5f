// The parameter table as printed: docs/parameters.md is fresh, the JSON is whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <espalier/app/parameter_docs.h>
#include <espalier/fitting/task/fit_options.h>
#include <espalier/models/models.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

TEST(ParamsCommand, TheDocumentationIsWhatItPrints) {
  const ProgramRun run = run_espalier("params --format markdown");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, read_text_file(ESPALIER_SOURCE_DIR "/docs/parameters.md"))
      << "make it anew: ./espalier params --format markdown > docs/parameters.md";
}

TEST(ParamsCommand, JsonHasARowForEachRowOfTheTable) {
  const ParameterTable& table = model_by_name("weber_penn").table();
  const auto json = nlohmann::json::parse(run_espalier("params --format json").out);
  ASSERT_EQ(json["parameters"].size(), table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(json["parameters"][i]["full_name"], table.rows[i].full_name());
    EXPECT_EQ(json["parameters"][i]["lower"], table.rows[i].lower);
    EXPECT_EQ(json["parameters"][i]["default"], table.rows[i].default_value);
  }
}

TEST(ParamsCommand, TextNamesEveryParameterWithItsHelp) {
  const ProgramRun run = run_espalier("params");
  for (const ParameterInfo& row : model_by_name("weber_penn").table().rows) {
    EXPECT_THAT(run.out, testing::HasSubstr(row.name));
    EXPECT_THAT(run.out, testing::HasSubstr(row.help));
  }
}

TEST(ParamsCommand, TheDocumentationOfFitsIsWhatItPrints) {
  const ProgramRun run = run_espalier("params --fit --format markdown");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, read_text_file(ESPALIER_SOURCE_DIR "/docs/fit_options.md"))
      << "make it anew: ./espalier params --fit --format markdown > docs/fit_options.md";
}

TEST(ParamsCommand, EachOptionOfAFitIsInItsHelpAndInAllFormats) {
  const std::string help = run_espalier("fit --help").out, text = run_espalier("params --fit").out;
  const auto json = nlohmann::json::parse(run_espalier("params --fit --format json").out);
  ASSERT_EQ(json["options"].size(), fit_options().size());
  for (std::size_t i = 0; i < fit_options().size(); ++i) {
    const FitOption& option = fit_options()[i];
    EXPECT_EQ(json["options"][i]["key"], option.key);
    if (option.option.empty()) continue;
    const std::string name = "--" + std::string(option.option);
    EXPECT_EQ(json["options"][i]["option"], name);
    EXPECT_THAT(help, testing::HasSubstr("  " + name + " ")) << name;
    EXPECT_THAT(text, testing::HasSubstr(name + " ")) << name;
  }
}

TEST(ParamsCommand, RefusesAnUnknownFormat) { expect_one_clear_error(run_espalier("params --format html")); }

TEST(ParamsCommand, RefusesAnUnknownModel) {
  const ProgramRun run = run_espalier("params --model oak");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, testing::HasSubstr("weber_penn"));
}

}  // namespace
}  // namespace espalier
