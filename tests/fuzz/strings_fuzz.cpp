// libFuzzer's target for texts of the command line and of files that have a grammar: the first byte says
// which.
#include <espalier/core/assignment.h>
#include <espalier/environment/volume.h>
#include <espalier/fitting/record/search_space.h>
#include <espalier/fitting/record/start_names.h>
#include <espalier/fitting/record/view_record.h>
#include <espalier/image/measures/objective.h>
#include <espalier/models/models.h>
#include <espalier/overrides/branch_pattern.h>

#include "fuzz/stranger_file.h"

using namespace espalier;

namespace {

void parse_free(const std::string& text) {
  const ParameterTable& table = model_by_name("weber_penn").table();
  make_search_space(table, table.defaults(), {{text}, {}}, 1);
}

/// Meshes are files, which have a target of their own.
void parse_volume_without_files(const std::string& text) {
  if (text.find("mesh") == text.npos) parse_volume(text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  use_of_stranger([&] {
    switch (data[0] % 7) {
      case 0:
        return void(parse_objective(text));
      case 1:
        return parse_volume_without_files(text);
      case 2:
        return void(parse_view(text));
      case 3:
        return void(parse_branch_pattern(text, "text"));
      case 4:
        return parse_free(text);
      case 5:
        return void(parse_start(text));
      default:
        return void(parse_decimal(text));
    }
  });
  return 0;
}
