#include <espalier/lsystem/strings/work.h>

namespace espalier::lsystem {

void Work::fail() const {
  throw TooMuchWork(
      fmt::format("{}: got more than {:.3g} units of work, expected less (--max-work)", label_, limit_));
}

}  // namespace espalier::lsystem
