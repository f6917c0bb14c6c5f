#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <espalier/experiments/runner/plan.h>

namespace espalier {

std::string table_number(double value) { return fmt::format("{:.6g}", value); }

std::string table_cell(double value) { return std::isnan(value) ? "" : table_number(value); }

void make_names_unique(Plan& plan) {
  std::map<std::string, int> uses;
  for (PlannedRun& run : plan.runs)
    if (const int use = ++uses[run.name]; use > 1) run.name += fmt::format("-{}", use);
}

}  // namespace espalier
