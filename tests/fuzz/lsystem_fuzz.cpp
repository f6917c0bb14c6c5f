// libFuzzer's target for files from strangers: parse, derive a few steps, draw. Anything but a plant or one
// InputError of one line is a find. An input with lines "=== NAME" is several files: includes, volumes,
// surfaces, plants (tests/support/derive_files.h). Built by clang with -DESPALIER_FUZZ=ON; see
// docs/lsystem.md.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "support/derive_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const espalier::lsystem::ScratchFolder folder;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::string message = text.find("\n=== ") == std::string::npos
                                  ? espalier::lsystem::derive_bounded(text)
                                  : espalier::lsystem::derive_files(text, folder);
  if (message.find('\n') != std::string::npos) std::abort();
  return 0;
}
