// Who a module is, while the string around it grows: a number that it keeps for as long as it stays or is
// only rewritten to an older one of itself. Random numbers of interpretation rules are keyed by it, so that
// in a film of growth what does not change does not jump. Kept only where interpretation rules draw random
// numbers.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/lsystem/strings/module_string.h>

namespace espalier::lsystem {

/// By module of a string.
using Identities = Buffer<std::uint64_t>;

/// For each symbol the first one of the same name: A(x) and A(x,y) are the same module with other parameters.
std::vector<SymbolId> symbols_by_name(const SymbolTable& alphabet);

/// Appends the identities of a successor. The first module with the name of the predecessor is its heir and
/// takes over `identity`, or where there is none, the only module of the successor; the others are new in
/// this step.
void append_identities(std::uint64_t identity, SymbolId predecessor, std::span<const SymbolId> successor,
                       std::span<const SymbolId> by_name, std::uint64_t step, Identities& identities);

}  // namespace espalier::lsystem
