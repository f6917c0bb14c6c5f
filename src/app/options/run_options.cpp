#include <CLI/CLI.hpp>

#include <espalier/app/options/run_options.h>

namespace espalier {

CLI::Option* add_picture_option(CLI::App& command, std::vector<std::string>& pictures) {
  return command
      .add_option(
          "--picture", pictures,
          "where the picture of a run is now that holds none itself, as those of version 0.1 do; of a "
          "run of several views one each, in their order (repeatable)")
      ->allow_extra_args(false);
}

}  // namespace espalier
