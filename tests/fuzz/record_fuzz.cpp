// libFuzzer's target for what goes on with a run reads: the first byte says which of run.toml,
// evaluations.bin and branches.json the others are.
#include <espalier/fitting/branches/branch_rounds.h>
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/search/evaluation_log.h>
#include <espalier/models/models.h>

#include "fuzz/stranger_file.h"

using namespace espalier;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const ParameterTable& table = model_by_name("weber_penn").table();
  use_of_stranger([&] {
    if (data[0] == 'r') {
      const RecordedRun run = read_record(fuzz_file("run.toml", bytes));
      record_to_toml(run.record, run.outcome);
    } else if (data[0] == 'e') {
      read_evaluation_log(fuzz_file("evaluations.bin", bytes));
    } else {
      BranchRounds state = branch_rounds_from_json(bytes, table, "branches.json");
      restore(table, state);
      branch_rounds_to_json(stored(state, table), "weber_penn");
    }
  });
  return 0;
}
