#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <fstream>

#include <espalier/core/error.h>
#include <espalier/experiments/runner/csv.h>

#include "support/temporary_folders.h"

namespace espalier {
namespace {

std::filesystem::path file_with(const std::string& text) {
  const auto path = fresh_folder("csv") / "table.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_csv(file_with(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, AnyTextReadsBackAsItWasWritten) {
  EXPECT_TRUE(rc::check([] {
    const auto cells = *rc::gen::container<std::vector<std::string>>(
        3, rc::gen::container<std::string>(rc::gen::element('a', ',', '"', '\n', ' ', '\r', '0')));
    const CsvTable table{{"a", "b", "c"}, {cells, {"1", "2", "3"}}, ""};
    RC_ASSERT(read_csv(file_with(to_csv(table))).rows == table.rows);
  }));
}

TEST(Csv, AnEmptyCellIsNotANumber) {
  const CsvTable table = read_csv(file_with("a,b\n,2.5\n"));
  EXPECT_TRUE(std::isnan(table.number(0, "a")));
  EXPECT_EQ(table.number(0, "b"), 2.5);
}

TEST(Csv, RefusesWhatIsNoTable) {
  EXPECT_THAT(error_of(""), testing::HasSubstr("empty"));
  EXPECT_THAT(error_of("a,b\n1\n"), testing::HasSubstr("table.csv:2: got 1 cells, expected 2"));
  EXPECT_THAT(error_of("a,b\n\"1,2\n"), testing::HasSubstr("quote"));
}

TEST(Csv, NamesTheCellThatIsNoNumber) {
  const CsvTable table = read_csv(file_with("a\nx\n"));
  EXPECT_THROW(table.number(0, "a"), InputError);
  EXPECT_THROW(table.number(0, "b"), InputError);
}

}  // namespace
}  // namespace espalier
