// Deriving small L-systems in tests.
#pragma once
#include <string>
#include <vector>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {

using Strings = std::vector<std::string>;

/// The strings of the axiom and of `steps` derivation steps.
inline Strings strings_of(const Grammar& grammar, int steps, Seed seed = 1) {
  Derivation derivation(grammar);
  derivation.start(seed);
  Strings strings{derivation.text()};
  for (int i = 0; i < steps; ++i) {
    derivation.step();
    strings.push_back(derivation.text());
  }
  return strings;
}

inline Strings strings_of(const std::string& text, int steps, Seed seed = 1) {
  return strings_of(parse_grammar(text, "test.lsys"), steps, seed);
}

}  // namespace espalier::lsystem
