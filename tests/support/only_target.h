// One of the machine's instruction sets at a time, for tests that all of them give the same bits.
#pragma once
#include <hwy/targets.h>

#include <cstdint>

namespace espalier {

/// Uses one instruction set until it goes out of scope.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) { use(target); }
  ~OnlyTarget() { use(0); }

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

}  // namespace espalier
