// A whole use of a stranger's file, within limits small enough to try many: for random and mutated files,
// and for the fuzz target.
#pragma once
#include <string>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {

/// Derives and draws the grammar that `read` gives. The message of its refusal, empty where there is none;
/// other exceptions pass.
template <typename Read>
std::string derive_bounded(const Read& read) {
  Limits limits;
  limits.lua_instructions = 2e5;
  limits.lua_memory_bytes = 16 << 20;
  limits.modules = 5000;
  limits.work = 1e7;
  try {
    const Grammar grammar = read();
    Derivation derivation(grammar, limits);
    derivation.start(1);
    derivation.run(3);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant,
                derivation.work());
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// The same of a text.
inline std::string derive_bounded(const std::string& text) {
  return derive_bounded([&] { return parse_grammar(text, "any.lsys"); });
}

}  // namespace espalier::lsystem
