// How even are blend strips? For all pairs of the bundled presets (or of those named), each encoding: strips of
// 11 trees, t = 0, 0.1 … 1, and the change of the silhouette from each tree to the next, the mean over some seeds
// of the share of pixels that differ. Prints the median step, the largest and their ratio (docs/species_space.md).
//   build/bin/blend_evenness > evenness.csv
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "fitting/blend_strip.h"
#include "measured_target.h"
#include "models/preset.h"

namespace espalier {
namespace {

constexpr int kSteps = 10;

void measure_pair(const Preset& a, const Preset& b, bool every_step) {
  fmt::print("{},{}", a.name, b.name);
  for (const char* name : {"monotone", "raw"}) {
    const auto encoding = make_encoding(name, measured_model().table());
    const std::vector<double> changes =
        silhouette_changes(measured_model(), blend_strip(measured_model(), *encoding, a.values, b.values, kSteps));
    const StripEvenness evenness = strip_evenness(changes);
    fmt::print(",{:.4f},{:.4f},{:.2f},{}", evenness.median, evenness.largest, evenness.ratio(),
               evenness.largest_step);
    if (every_step)
      for (const double change : changes) fmt::print(" {:.3f}", change);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void measure_pairs(const std::vector<std::string>& names, bool every_step) {
  std::vector<Preset> presets;
  for (const std::string& name : names) presets.push_back(load_preset(name));
  fmt::print("a,b,monotone_median,monotone_largest,monotone_ratio,monotone_step,raw_median,raw_largest,raw_ratio,"
             "raw_step\n");
  for (std::size_t i = 0; i < presets.size(); ++i)
    for (std::size_t j = i + 1; j < presets.size(); ++j) measure_pair(presets[i], presets[j], every_step);
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  using namespace espalier;
  try {
    const std::vector<std::string> named(argv + 1, argv + argc);
    measure_pairs(named.empty() ? bundled_presets() : named, !named.empty());
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", argv[0], error.what());
    return 2;
  }
  return 0;
}
