// The L-system and the presets of a run where they are files of the user's: copies beside its record, so that
// the run, and the plant that comes of it, can be moved. What comes with the program is only named.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_record.h>

namespace espalier {

/// A file that a run keeps.
struct RunFile {
  std::filesystem::path name;  ///< from the run's directory on: "model/fern.lsys", "presets/old_oak.toml"
  std::string text;

  bool operator==(const RunFile&) const = default;
};

struct KeptFiles {
  FitRecord record;  ///< names the copies, from the run's directory on, as run.toml does
  std::vector<RunFile> files;
};

/// What a run of `record` keeps: its L-system with all that this was read from, and the presets that it
/// names, each with what it extends as one. Throws InputError where a file cannot be read.
KeptFiles files_to_keep(const FitRecord& record, const Model& model);

/// Writes those that are not there as they are.
void keep_files(const std::vector<RunFile>& files, const std::filesystem::path& directory);

}  // namespace espalier
