// A whole use of a stranger's file, within limits small enough to try many: for random and mutated files,
// and for the fuzz target.
#pragma once
#include <string>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {

/// Parses, derives and draws `text`. The message of its refusal, empty where there is none; other exceptions
/// pass.
inline std::string derive_bounded(const std::string& text) {
  Limits limits;
  limits.lua_instructions = 2e5;
  limits.lua_memory_bytes = 16 << 20;
  limits.modules = 5000;
  try {
    const Grammar grammar = parse_grammar(text, "any.lsys");
    Derivation derivation(grammar, limits);
    derivation.start(1);
    derivation.run(3);
    Plant plant;
    build_plant(derivation.interpreted(), derivation.alphabet(), derivation.settings(), plant);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace espalier::lsystem
