// The pictures of a run: a copy beside its record, so that the run can be moved and goes on without the files
// that it was begun with. Runs of earlier versions have no copy: theirs are where run.toml says, or where the
// caller does.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_record.h>

namespace espalier {

/// Throws InputError where the file cannot be read.
FileContent content_of(const std::filesystem::path& file);

/// From the run's directory on: as the view says, or else "picture.png" for the first view, "picture_2.jpg"
/// for the second: the ending is that of the picture.
std::string kept_picture_name(const ViewRecord& view, std::size_t index);

/// Says of each view of a record that was read from `directory` which file to read: that of `given`, which
/// holds none or one a view, or else the run's copy, or else the picture that the record names; the last two
/// only while they hold what they held when the run began. A file that a view says already is only
/// checked. Throws FieldError in "picture" where there is no such file, or it is another one.
void find_pictures(FitRecord& record, const std::filesystem::path& directory,
                   const std::vector<std::string>& given = {});

/// Enters the contents of the pictures, of those that are files that can be read twice.
void note_contents(FitRecord& record);

/// Copies the pictures whose content is known into the directory, where they are not there already.
void keep_pictures(const FitRecord& record, const std::filesystem::path& directory);

/// From now on the copies are read, whatever becomes of the files they were made from.
void read_kept_pictures(FitRecord& record, const std::filesystem::path& directory);

}  // namespace espalier
