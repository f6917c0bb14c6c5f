// What an L-system may use. Files come from strangers: each limit ends a derivation with one clear line. All
// of them count; none looks at a clock, so that a derivation has the same end on every machine.
#pragma once
#include <cstddef>

#include <espalier/core/error.h>

namespace espalier::lsystem {

struct Limits {
  double lua_instructions = 1e8;  ///< of the whole derivation, and what else Lua does in their measure
  std::size_t lua_memory_bytes = 256u * 1024 * 1024;  ///< of Lua's objects at a time
  std::size_t modules = 30'000'000;                   ///< of a string
  double work = 1e9;                                  ///< of the whole derivation, and of a drawing (work.h)
  int steps = 10'000;
};

/// The string grew beyond Limits::modules: a degenerate candidate for a search, an error for a user.
struct TooManyModules : InputError {
  using InputError::InputError;
};

/// The same of Limits::work.
struct TooMuchWork : TooManyModules {
  using TooManyModules::TooManyModules;
};

}  // namespace espalier::lsystem
