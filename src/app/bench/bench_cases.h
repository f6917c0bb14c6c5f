// What `espalier bench` measures: evaluations (grow, draw, compare) of a species at a size, on one thread and
// on all, and how far the drawn picture is from Embree's. Of trees with leaves, what leaves cover is drawn
// apart, as fits ask for it. Seconds, bytes and pixels.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <espalier/core/parameter_role.h>

namespace espalier {

struct BenchCase {
  std::string species;
  int size_px = 256;
  bool leaves = true;
  std::vector<std::pair<RoleOfLevel, double>> changes = {};  ///< values that are not the preset's
};

struct BenchResult {
  BenchCase of;
  double per_second = 0, per_second_all_threads = 0;
  double grow_s = 0, draw_s = 0, compare_s = 0;  ///< of one evaluation on one thread, means
  double stems = 0, leaf_count = 0;              ///< of a plant, means
  std::size_t bytes_per_thread = 0;              ///< kept from one evaluation to the next
  std::size_t differing_px = 0, set_px = 0;      ///< from Embree's picture of the first plant, and in it
};

/// Presets that are measured: aspen, poplar, pine, palm and willow.
std::vector<std::string> bench_species();

/// Each species at 128², 256² and 512², with and without leaves.
std::vector<BenchCase> bench_cases();

/// Measures for about `seconds` on one thread and as long on `threads`, if that is more than one. Every
/// evaluation is a new plant; the frame holds the whole plant.
BenchResult run_bench(const BenchCase& of, double seconds, int threads);

}  // namespace espalier
