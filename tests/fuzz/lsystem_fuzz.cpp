// libFuzzer's target for files from strangers: parse, derive a few steps, draw. Anything but a plant or one
// InputError of one line is a find. Built by clang with -DESPALIER_FUZZ=ON; see docs/lsystem.md.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "support/derive_bounded.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string message = espalier::lsystem::derive_bounded(text);
  if (message.find('\n') != std::string::npos) std::abort();
  return 0;
}
