// libFuzzer's target for saved species spaces: read, and written again.
#include <espalier/fitting/species_space/species_space_file.h>

#include "fuzz/stranger_file.h"

using namespace espalier;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz_file("any.toml", {reinterpret_cast<const char*>(data), size});
  use_of_stranger([&] { species_space_to_toml(read_species_space(file)); });
  return 0;
}
