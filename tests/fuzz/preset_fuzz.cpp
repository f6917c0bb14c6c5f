// libFuzzer's target for presets: read, and written as TOML that reads back to the same text.
#include <espalier/models/preset.h>

#include "fuzz/stranger_file.h"

using namespace espalier;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz_file("any.toml", {reinterpret_cast<const char*>(data), size});
  std::string written;
  use_of_stranger([&] { written = preset_to_toml(load_preset(file)); });
  if (written.empty()) return 0;
  const auto again = fuzz_file("again.toml", written);
  if (preset_to_toml(load_preset(again)) != written) std::abort();
  return 0;
}
