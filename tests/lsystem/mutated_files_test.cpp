// Damaged files: the bundled L-systems with bytes changed, cut, doubled and swapped. Whatever comes of them
// is a derivation or one InputError; nothing else may be thrown, and nothing runs on.
#include <gtest/gtest.h>

#include <algorithm>

#include "lsystem/bundled.h"
#include "lsystem/plant_builder.h"
#include "lsystem/strings.h"

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

/// False where the text is refused.
bool derives(const std::string& text) {
  Limits limits;
  limits.lua_instructions = 2e5;
  limits.modules = 5000;
  try {
    const Grammar grammar = parse_grammar(text, "mutated.lsys");
    Derivation derivation(grammar, limits);
    derivation.start(1);
    derivation.run(3);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
    return true;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
    return false;
  }
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

}  // namespace
}  // namespace espalier::lsystem
