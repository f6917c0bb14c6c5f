#include <time.h>

#include <algorithm>

#include <espalier/experiments/growth/growth_phases.h>
#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/drawing/plant_builder.h>
#include <espalier/lsystem/files/bundled.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

constexpr int kRepeats = 3;

/// Processor time of this thread, which does all of the growing: other programs do not count.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <typename Work>
double seconds_of(Work work) {
  const double began = thread_seconds();
  work();
  return thread_seconds() - began;
}

/// With its leaves and without them: leaves take what a tree takes longer with them.
class PresetGrower final : public TimedGrower {
 public:
  explicit PresetGrower(const Preset& preset)
      : model_(model_by_name(preset.model)), values_(preset.values), bare_(preset.values) {
    if (const auto row = model_.table().find(Role::leaf_count)) bare_[*row] = 0;
  }

  GrowthTimes grow(Seed seed) override {
    GrowthTimes times;
    times.stems_s = shortest(bare_, seed);
    times.all_s = shortest(values_, seed);
    times.leaves_s = std::max(0.0, times.all_s - times.stems_s);
    return times;
  }

 private:
  double shortest(const ParameterValues& values, Seed seed) {
    const auto once = [&] { return seconds_of([&] { model_.generate(values, seed, {}, plant_); }); };
    double shortest_s = once();
    for (int i = 1; i < kRepeats; ++i) shortest_s = std::min(shortest_s, once());
    return shortest_s;
  }

  const Model& model_;
  ParameterValues values_, bare_;
};

class LsystemGrower final : public TimedGrower {
 public:
  explicit LsystemGrower(const std::string& name)
      : grammar_(lsystem::load_grammar(name)), derivation_(grammar_) {}

  GrowthTimes grow(Seed seed) override {
    GrowthTimes times = once(seed);
    for (int i = 1; i < kRepeats; ++i) {
      const GrowthTimes again = once(seed);
      times.derivation_s = std::min(times.derivation_s, again.derivation_s);
      times.interpretation_s = std::min(times.interpretation_s, again.interpretation_s);
    }
    times.all_s = times.derivation_s + times.interpretation_s;
    return times;
  }

 private:
  GrowthTimes once(Seed seed) {
    GrowthTimes times;
    times.derivation_s = seconds_of([&] {
      derivation_.start(seed);
      derivation_.run(derivation_.settings().steps);
    });
    times.interpretation_s = seconds_of([&] {
      build_plant(derivation_.interpreted(), derivation_.alphabet(), derivation_.settings(), plant_);
    });
    return times;
  }

  lsystem::Grammar grammar_;
  lsystem::Derivation derivation_;
};

}  // namespace

std::unique_ptr<TimedGrower> time_preset(const std::string& preset) {
  return std::make_unique<PresetGrower>(load_preset(preset));
}

std::unique_ptr<TimedGrower> time_lsystem(const std::string& name_or_path) {
  return std::make_unique<LsystemGrower>(name_or_path);
}

}  // namespace espalier
