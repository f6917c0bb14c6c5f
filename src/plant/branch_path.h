// The path of a stem in its plant: which trunk, which child of it, and so on. The stem that a split adds is
// addressed from the stem it splits off. As text "0/12/3", or "0/split4.1/7": the first stem that split
// off trunk 0 at the end of its 4th segment, and child 7 of that. Paths stay the same while parameters
// change, as random numbers do (core/random.h); the decomposition graph of Boudon et al. 2003 (Interactive
// design of bonsai tree models, §4) keys its nodes by them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/plant/plant.h>

namespace espalier {

using BranchPath = std::vector<std::uint32_t>;

/// Split stems are numbered beyond all children: kFirstSplit + kStemsPerSplit·(segment end) + number.
inline constexpr std::uint32_t kFirstSplit = 1'000'000, kStemsPerSplit = 16;

std::string to_string(const BranchPath& path);

/// One part of a path; none: `text` is none.
std::optional<std::uint32_t> parse_path_part(std::string_view text);

/// The path of stem `stem` of the plant.
BranchPath path_of(const Plant& plant, std::size_t stem);

}  // namespace espalier
