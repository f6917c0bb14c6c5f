// A file's lines as statements, its comments as blanks, and messages that name the place.
#include <gtest/gtest.h>

#include <espalier/lsystem/strings/statements.h>

namespace espalier::lsystem {
namespace {

FileText split(const std::string& text) {
  return split_statements(std::make_shared<Source>(Source{"fern.lsys", {}, text}));
}

std::vector<std::string> statements_of(const std::string& text) {
  const FileText file = split(text);
  std::vector<std::string> statements;
  for (const Statement& s : file.statements)
    statements.push_back(file.clean.substr(s.begin, s.end - s.begin));
  return statements;
}

TEST(Statements, GoOnInLinesThatAreIndentedDeeper) {
  EXPECT_EQ(statements_of("a\n  b\nc\n"), (std::vector<std::string>{"a\n  b", "c"}));
}

TEST(Statements, HeadingsEndWithTheirLine) {
  EXPECT_EQ(statements_of("productions:\n  A -> B\n"), (std::vector<std::string>{"productions:", "A -> B"}));
}

TEST(Statements, CommentsAreBlankAndSymbolsStay) {
  EXPECT_EQ(statements_of("A -> B#C # a comment\n# another\n"), (std::vector<std::string>{"A -> B#C "}));
}

TEST(Statements, KeepTheOffsetsOfTheFile) {
  const FileText file = split("# first\n  A # second\n");
  ASSERT_EQ(file.statements.size(), 1u);
  EXPECT_EQ(file.clean.size(), file.source->text.size());
  EXPECT_EQ(describe({file.source, file.statements[0].begin}), "fern.lsys:2:3");
}

TEST(Cursor, FindsStopsOutsideBracketsAndQuotesOnly) {
  const FileText file = split("f(a, b) + \",\" , c");
  const Cursor cursor(file, 0, file.clean.size());
  EXPECT_EQ(cursor.find_outside(","), 14u);
}

TEST(Cursor, TakesWholeWordsOnly) {
  const FileText file = split("tables table x");
  Cursor cursor(file, 0, file.clean.size());
  EXPECT_FALSE(cursor.take("table"));
  EXPECT_EQ(cursor.take_word(), "tables");
  EXPECT_TRUE(cursor.take("table"));
}

TEST(Cursor, ErrorsSayWhereAndWhatWasFound) {
  const FileText file = split("A\n B)");
  Cursor cursor(file, 0, file.clean.size());
  cursor.go_to(4);
  try {
    cursor.expect("(");
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "fern.lsys:2:3: got ')', expected '('");
  }
}

}  // namespace
}  // namespace espalier::lsystem
