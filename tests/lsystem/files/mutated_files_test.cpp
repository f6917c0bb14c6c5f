// Damaged files: the bundled L-systems with bytes changed, cut, doubled and swapped. Whatever comes of them
// is a derivation or one InputError; nothing else may be thrown, and nothing runs on.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <filesystem>

#include <espalier/core/files.h>
#include <espalier/core/random.h>
#include <espalier/lsystem/files/bundled.h>

#include "support/derive_files.h"

namespace espalier::lsystem {
namespace {

std::uint64_t draw(std::uint64_t& state, std::uint64_t below) {
  state = mix_bits(state);
  return state % below;
}

std::string mutated(std::string text, std::uint64_t& state) {
  constexpr std::string_view kBytes = "[](){}<>:-+*/&^|$!%~@#?.,;'\"=_ \n\tAFxk019\\\xff";
  const auto changes = 1 + draw(state, 4);
  for (std::uint64_t i = 0; i < changes && text.size() > 2; ++i) {
    const std::size_t at = draw(state, text.size() - 1),
                      size = 1 + draw(state, std::min<std::size_t>(20, text.size() - at));
    switch (draw(state, 4)) {
      case 0:
        text[at] = kBytes[draw(state, kBytes.size())];
        break;
      case 1:
        text.erase(at, size);
        break;
      case 2:
        text.insert(draw(state, text.size()), text.substr(at, size));
        break;
      default:
        std::swap(text[at], text[draw(state, text.size())]);
    }
  }
  return text;
}

/// False where the text is refused, which takes one line that says where.
bool derives(const std::string& text) {
  const std::string message = derive_bounded(text);
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  return message.empty();
}

TEST(MutatedFiles, EndInADerivationOrOneLine) {
  std::uint64_t state = 1;
  int refused = 0, derived = 0;
  for (int round = 0; round < 40; ++round)
    for (const EmbeddedFile& file : embedded_lsystems()) {
      const std::string text = mutated(std::string(file.text), state);
      SCOPED_TRACE(text);
      ++(derives(text) ? derived : refused);
    }
  EXPECT_GT(refused, 100);
  EXPECT_GT(derived, 100);
}

TEST(RandomFiles, EndInADerivationOrOneLine) {
  EXPECT_TRUE(rc::check("bytes", [](const std::string& bytes) {
    const std::string message = derive_bounded(bytes);
    RC_ASSERT(!message.empty());
    RC_ASSERT(message.find('\n') == std::string::npos);
    RC_ASSERT(message.find("any.lsys:") != std::string::npos);
  }));
  // Words of the notation in a wild order get further than bytes do.
  const std::vector<std::string> words{"axiom:",
                                       "productions:",
                                       "interpretation:",
                                       "-->",
                                       "A",
                                       "B(x)",
                                       "B(1)",
                                       "[",
                                       "]",
                                       "<",
                                       ">",
                                       ":",
                                       "x",
                                       "+",
                                       "(",
                                       ")",
                                       "\n",
                                       "\n ",
                                       "lua",
                                       "produce('A')",
                                       "param a = 1 in 0 .. 2",
                                       "const c = 1/0",
                                       "F(1)",
                                       "{",
                                       "}",
                                       ".",
                                       "?",
                                       "#",
                                       "~(\"petal\")",
                                       ";(1,0,0)",
                                       ";(9)",
                                       "*",
                                       "0.5",
                                       "?P(x,y,z)",
                                       "%",
                                       "surface s = \"petal.patch\"",
                                       "colors: ff0000",
                                       "table t when step > 1:",
                                       "@(1,2,3)",
                                       "!(-1)",
                                       "@o(1e300)",
                                       "F(1e300)",
                                       "$",
                                       "|",
                                       "let f(x) = x"};
  EXPECT_TRUE(rc::check("words", [&] {
    const auto chosen = *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(words));
    std::string text = "axiom: A\nproductions:\n A --> ";
    for (const std::string& word : chosen) text += word + " ";
    RC_ASSERT(derive_bounded(text).find('\n') == std::string::npos);
  }));
}

/// What the fuzzer found once, and seeds of several files ("files_…"), which derive:
/// tests/fuzz/seeds/lsystem.
TEST(RandomFiles, EarlierFindsStayRepaired) {
  const ScratchFolder folder;
  for (const auto& entry :
       std::filesystem::directory_iterator(ESPALIER_SOURCE_DIR "/tests/fuzz/seeds/lsystem")) {
    SCOPED_TRACE(entry.path().filename().string());
    const std::string text = read_file(entry.path());
    const bool is_several = text.find("\n=== ") != std::string::npos;
    const std::string message = is_several ? derive_files(text, folder) : derive_bounded(text);
    if (entry.path().filename().string().rfind("files_", 0) == 0) {
      EXPECT_EQ(message, "") << entry.path();
    }
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace espalier::lsystem
