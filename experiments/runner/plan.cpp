#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include <espalier/experiments/runner/plan.h>

namespace espalier {

std::string table_number(double value) { return fmt::format("{:.6g}", value); }

std::string table_cell(double value) { return std::isnan(value) ? "" : table_number(value); }

std::string directory_name(const std::string& text) {
  std::string name = text;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("_.=-").find(c) == std::string::npos)
      c = '-';
  return name;
}

void make_names_unique(Plan& plan) {
  std::map<std::string, int> uses;
  for (PlannedRun& run : plan.runs)
    if (const int use = ++uses[run.name]; use > 1) run.name += fmt::format("-{}", use);
}

}  // namespace espalier
