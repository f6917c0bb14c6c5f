// Texts from outside become UTF-8, and what is UTF-8 stays as it is; hashes tell texts apart.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include <espalier/core/text/text_hash.h>
#include <espalier/core/text/utf8.h>

namespace espalier {
namespace {

TEST(Utf8, TextsThatAreUtf8StayAsTheyAre) {
  for (const char* text : {"", "a\nb", "öäü … 樹 🌳", "\xf4\x8f\xbf\xbf"}) EXPECT_EQ(as_utf8(text), text);
}

TEST(Utf8, OtherBytesAreShown) {
  EXPECT_EQ(as_utf8("a\xff.png"), "a\\xff.png");
  EXPECT_EQ(as_utf8("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(as_utf8("\xc0\xaf"), "\\xc0\\xaf") << "a slash in more bytes than it needs";
}

RC_GTEST_PROP(Utf8, AnyBytesBecomeUtf8, (const std::string& bytes)) {
  const std::string text = as_utf8(bytes);
  RC_ASSERT(as_utf8(text) == text);
}

RC_GTEST_PROP(TextHash, OfATextWithAnotherBitIsAnother, (const std::string& text)) {
  std::set<std::string> hashes{text_hash(text)};
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    RC_ASSERT(hashes.insert(text_hash(other)).second);
  }
}

}  // namespace
}  // namespace espalier
