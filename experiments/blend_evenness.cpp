// How even are blend strips? For all pairs of the bundled presets (or of those named), each encoding: strips
// of 11 trees, t = 0, 0.1 … 1, and the change of the silhouette from each tree to the next, the mean over
// some seeds of the share of pixels that differ. Prints the median step, the largest and their ratio
// (docs/species_space.md). A number before the presets asks for as many steps instead of 10.
//   build/bin/blend_evenness > evenness.csv
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/fitting/species_pictures/blend_strip.h>
#include <espalier/models/preset.h>

#include "measured_target.h"

namespace espalier {
namespace {

void measure_pair(const Preset& a, const Preset& b, int steps) {
  fmt::print("{},{}", a.name, b.name);
  for (const char* name : {"monotone", "raw"}) {
    const auto encoding = make_encoding(name, measured_model().table());
    const std::vector<double> changes = silhouette_changes(
        measured_model(), blend_strip(measured_model(), *encoding, a.values, b.values, steps));
    const StripEvenness evenness = strip_evenness(changes);
    fmt::print(",{:.4f},{:.4f},{:.2f},{}", evenness.median, evenness.largest, evenness.ratio(),
               evenness.largest_step);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void measure_pairs(const std::vector<std::string>& names, int steps) {
  std::vector<Preset> presets;
  presets.reserve(names.size());
  for (const std::string& name : names) presets.push_back(load_preset(name));
  fmt::print(
      "a,b,monotone_median,monotone_largest,monotone_ratio,monotone_step,raw_median,raw_largest,raw_ratio,"
      "raw_step\n");
  for (std::size_t i = 0; i < presets.size(); ++i)
    for (std::size_t j = i + 1; j < presets.size(); ++j) measure_pair(presets[i], presets[j], steps);
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  using namespace espalier;
  try {
    std::vector<std::string> names(argv + 1, argv + argc);
    int steps = 10;
    if (!names.empty() && std::isdigit(static_cast<unsigned char>(names[0][0]))) {
      steps = std::clamp(std::stoi(names[0].substr(0, 4)), 1, 1000);
      names.erase(names.begin());
    }
    measure_pairs(names.empty() ? bundled_presets() : names, steps);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
  return 0;
}
