// The step size of the (1+1) evolution strategy of branches, in coordinates of kBranchDimensions.
// Rechenberg's rule (Evolutionsstrategie, 1973): a success widens it, a failure narrows it, and it stays as
// it is where one step in five succeeds: 1.5 · 0.92^4 is about 1.
#pragma once
#include <algorithm>

namespace espalier {

inline constexpr double kWidestStep = 0.5, kNarrowestStep = 0.01;
inline constexpr double kWiden = 1.5, kNarrow = 0.92;

/// After a success.
constexpr double wider(double sigma) { return std::min(kWidestStep, kWiden * sigma); }

/// After a failure.
constexpr double narrower(double sigma) { return std::max(kNarrowestStep, kNarrow * sigma); }

}  // namespace espalier
