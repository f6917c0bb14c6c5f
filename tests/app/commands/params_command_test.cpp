// The parameter table as printed: docs/parameters.md is fresh, the JSON is whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <espalier/app/parameter_docs.h>
#include <espalier/models/models.h>

#include "support/run_espalier.h"

namespace espalier {
namespace {

TEST(ParamsCommand, TheDocumentationIsWhatItPrints) {
  const ProgramRun run = run_espalier("params --format markdown");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, read_text_file(ESPALIER_SOURCE_DIR "/docs/parameters.md"))
      << "make it anew: docs/update_tables.py";
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

TEST(ParamsCommand, RefusesAnUnknownFormat) { expect_one_clear_error(run_espalier("params --format html")); }

TEST(ParamsCommand, RefusesAnUnknownModel) {
  const ProgramRun run = run_espalier("params --model oak");
  expect_one_clear_error(run);
  EXPECT_THAT(run.err, testing::HasSubstr("weber_penn"));
}

}  // namespace
}  // namespace espalier
