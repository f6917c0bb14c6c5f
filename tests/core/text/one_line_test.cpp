// A message is one line that a terminal can be given, whatever is in it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <espalier/core/text/one_line.h>

namespace espalier {
namespace {

bool is_printable_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
}

TEST(OneLine, IsTheTextWhereThatIsALine) {
  for (const char* text : {"", "a.png: got 3, expected 4", "öäü … 樹 🌳"})
    EXPECT_EQ(one_line(text, 300), text);
}

TEST(OneLine, ShowsWhatTerminalsWouldObey) {
  EXPECT_EQ(one_line("a\x1b[31mb\r\t\x7f", 300), "a\\x1b[31mb\\x0d\\x09\\x7f");
  EXPECT_EQ(one_line("\xc2\x9b"
                     "31m",
                     300),
            "\\xc2\\x9b31m")
      << "a control of ISO 6429 in UTF-8";
  EXPECT_EQ(one_line("two\nlines", 300), "two lines");
}

TEST(OneLine, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(one_line("\xff\xc3", 300), "\\xff\\xc3");
  EXPECT_EQ(one_line("\xc0\xaf", 300), "\\xc0\\xaf") << "a longer form than needed";
  EXPECT_EQ(one_line("\xed\xa0\x80", 300), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(one_line("\xf4\x90\x80\x80", 300), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
}

TEST(OneLine, KeepsBeginAndEndOfWhatIsLong) {
  const std::string line =
      one_line("preset.toml:3: got '" + std::string(100'000, 'x') + "', expected a number", 300);
  EXPECT_LE(line.size(), 300u);
  EXPECT_GT(line.size(), 290u);
  EXPECT_TRUE(line.starts_with("preset.toml:3: got 'xxx"));
  EXPECT_TRUE(line.ends_with("xxx', expected a number"));
}

TEST(OneLine, LeavesOutWhatALibraryPutsBeforeItsReason) {
  EXPECT_EQ(one_line("a.json: [json.exception.parse_error.101] parse error at line 1", 300),
            "a.json: parse error at line 1");
  EXPECT_EQ(one_line("[json.exception.", 300), "[json.exception.");
  EXPECT_EQ(one_line("curve[1] is [0, 1]", 300), "curve[1] is [0, 1]");
}

RC_GTEST_PROP(OneLine, OfAnyBytesIsShortAndPrintable, (const std::string& bytes)) {
  const auto longest = *rc::gen::inRange<std::size_t>(150, 700);
  const std::string line = one_line(bytes, longest);
  RC_ASSERT(line.size() <= longest);
  const bool is_ascii = std::all_of(bytes.begin(), bytes.end(), [](char c) { return c >= 0; });
  if (is_ascii && line.find("…") == std::string::npos) RC_ASSERT(is_printable_ascii(line));
  RC_ASSERT(one_line(line, longest) == line);
}

}  // namespace
}  // namespace espalier
