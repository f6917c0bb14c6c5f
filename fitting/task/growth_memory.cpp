#include <algorithm>

#include <espalier/core/field_error.h>
#include <espalier/fitting/task/growth_memory.h>

namespace espalier {

namespace {

// Measured on black oaks of 134,000 stems with 3 to 10 segments (1.8 to 3.6 kB each, drawing included) and of
// 2.5 million leaves (55 bytes each; an array that grows may hold twice what it needs).
constexpr double kStemBytes = 3000, kLeafBytes = 110;

double gigabytes(double bytes) { return bytes / 1e9; }

}  // namespace

double growth_memory_bytes(const GrowthBudget& budget, int threads) {
  return std::max(threads, 1) * (budget.max_stems * kStemBytes + budget.max_leaves * kLeafBytes);
}

void check_growth_memory(const GrowthBudget& budget, int threads, double available_bytes) {
  const double needed = growth_memory_bytes(budget, threads);
  if (needed <= available_bytes) return;
  const bool by_leaves = budget.max_leaves * kLeafBytes > budget.max_stems * kStemBytes;
  throw_field_error(by_leaves ? "growth.max_leaves" : "growth.max_stems",
                    "got {:g}, for which plants on {} threads may need {:.1f} GB, expected what fits into "
                    "{:.1f} GB of memory",
                    by_leaves ? budget.max_leaves : budget.max_stems, std::max(threads, 1), gigabytes(needed),
                    gigabytes(available_bytes));
}

}  // namespace espalier
