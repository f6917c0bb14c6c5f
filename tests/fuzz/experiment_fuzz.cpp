// libFuzzer's target for experiments: read and checked, nothing is run.
#include <espalier/experiments/declaration/experiment.h>

#include "fuzz/stranger_file.h"

using namespace espalier;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz_file("any.toml", {reinterpret_cast<const char*>(data), size});
  use_of_stranger([&] { read_experiment(file); });
  return 0;
}
