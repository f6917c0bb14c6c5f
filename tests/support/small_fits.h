// Records of fits that take a moment.
#pragma once
#include <filesystem>

#include <espalier/fitting/record/fit_record.h>

namespace espalier {

/// A palm at 32×32 pixels, begun with the bundled palm.
inline FitRecord small_palm_fit(long evaluations) {
  FitRecord record;
  record.views = {{std::filesystem::path(ESPALIER_SOURCE_DIR) / "targets/oc_palm.png", {}}};
  record.target.size_px = 32;
  record.budget = {evaluations, 0, 0};
  record.growth = {300, 3'000};
  record.start = "palm";
  return record;
}

}  // namespace espalier
