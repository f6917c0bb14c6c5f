// Trees grown for their times, phase by phase: those of presets are stems and leaves, those of L-systems the
// derivation of the string and its interpretation, which the dissertation calls parsing.
#pragma once
#include <limits>
#include <memory>
#include <string>

#include <espalier/core/random.h>
#include <espalier/plant/plant.h>

namespace espalier {

/// Seconds of processor time; NaN for phases that a model does not have.
struct GrowthTimes {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double stems_s = kNone, leaves_s = kNone;
  double derivation_s = kNone, interpretation_s = kNone;
  double all_s = 0;
};

class TimedGrower {
 public:
  virtual ~TimedGrower() = default;
  /// Grows the tree of this seed several times. Of each phase the shortest time counts, which other programs
  /// on the processor disturbed least.
  virtual GrowthTimes grow(Seed seed) = 0;
  /// The tree that was grown last.
  const Plant& plant() const { return plant_; }

 protected:
  Plant plant_;
};

/// Of a preset. Throws InputError as load_preset does.
std::unique_ptr<TimedGrower> time_preset(const std::string& preset);

/// Of an L-system with its default parameters. Throws InputError where there is none or it is no L-system.
std::unique_ptr<TimedGrower> time_lsystem(const std::string& name_or_path);

}  // namespace espalier
