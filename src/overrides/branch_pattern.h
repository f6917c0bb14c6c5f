// Which branches a node of overrides is of: a path whose parts may stand for several children of their
// parent, so that a node survives a change of their number [Boudon et al. 2003, Interactive design of bonsai
// tree models, §6: nodes for ranges of positions]. As text a part is
//   3, split4.1         one child
//   3..7                children 3 to 7, both included
//   @0.25..0.5          those from a quarter of the parent's length to less than half of it; a range up to 1
//                       has its end
//   *                   all
// Stems that split off belong to the axis of their stem and are none of its children: only their own part
// means them.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/plant/branch_path.h>

namespace espalier {

struct PatternPart {
  /// From the weakest to the strongest: where several nodes are of one branch, what a stronger one says comes
  /// after what weaker ones say.
  enum class Kind : std::uint8_t { all, positions, indices, one };

  Kind kind = Kind::one;
  std::uint32_t first = 0, last = 0;  ///< of one, and of indices
  float lower = 0, upper = 1;         ///< of positions

  bool means(std::uint32_t index, float position) const;
  bool operator==(const PatternPart&) const = default;
};

using BranchPattern = std::vector<PatternPart>;

std::string to_string(const BranchPattern& pattern);

/// Throws InputError, opening with `where`, unless `text` is a pattern, and for ranges that hold nothing.
BranchPattern parse_branch_pattern(std::string_view text, const std::string& where);

/// The path that the pattern is, where all of its parts are one; none: it has ranges.
std::optional<BranchPath> as_path(const BranchPattern& pattern);
BranchPattern as_pattern(const BranchPath& path);

/// Whether `a` is weaker than `b`, of two patterns of one length: by the first part, from the trunk on, whose
/// kinds differ.
bool is_weaker(const BranchPattern& a, const BranchPattern& b);

/// The level of the branches, trunks being 0; -1 of an empty pattern.
int level_of(const BranchPattern& pattern);

}  // namespace espalier
