#include <fmt/format.h>

#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/core/text/utf8.h>
#include <espalier/fitting/run/run_pictures.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::string in_words(const FileContent& content) {
  return fmt::format("{} bytes (hash {})", content.bytes, content.hash);
}

/// What a record of an earlier version does not know is checked by the masks that come of it.
bool is_that_of(const ViewRecord& view, const fs::path& file) {
  return is_file(file) && (!view.content || content_of(file) == *view.content);
}

void check_given(const ViewRecord& view, const std::string& file) {
  if (!is_file(file)) throw_field_error("picture", "got '{}', expected a picture's file", file);
  if (!is_that_of(view, file))
    throw_field_error("picture", "got '{}' of {}, expected the picture of the run, of {}", file,
                      in_words(content_of(file)), in_words(*view.content));
}

std::string state_of(const fs::path& file) {
  return fmt::format("'{}' {}", file.string(), is_file(file) ? "is another picture" : "is not there");
}

/// The first of the run's copy and the named picture that is the run's.
fs::path found_picture(const ViewRecord& view, const fs::path& directory, std::size_t index) {
  const fs::path kept = directory / kept_picture_name(view, index);
  for (const fs::path& file : {kept, view.picture})
    if (is_that_of(view, file)) return file;
  throw_field_error("picture", "got none, and {}{}: expected the picture of the run in {}",
                    is_file(kept) ? state_of(kept) + ", " : "", state_of(view.picture), directory.string());
}

}  // namespace

FileContent content_of(const fs::path& file) {
  const std::string bytes = read_file(file);
  return {static_cast<std::int64_t>(bytes.size()), text_hash(bytes)};
}

std::string kept_picture_name(const ViewRecord& view, std::size_t index) {
  if (!view.kept_as.empty()) return view.kept_as.string();
  const std::string number = index == 0 ? "" : fmt::format("_{}", index + 1);
  return "picture" + number + as_utf8(view.picture.extension().string());
}

void find_pictures(FitRecord& record, const fs::path& directory, const std::vector<std::string>& given) {
  if (!given.empty() && given.size() != record.views.size())
    throw_field_error("picture", "got {} pictures, expected {}, one for each view of {}", given.size(),
                      record.views.size(), directory.string());
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    ViewRecord& view = record.views[i];
    if (!given.empty()) view.copy = given[i];
    if (view.copy.empty())
      view.copy = found_picture(view, directory, i);
    else
      check_given(view, view.copy.string());
  }
}

void note_contents(FitRecord& record) {
  for (ViewRecord& view : record.views)
    if (is_file(view.file())) view.content = content_of(view.file());
}

void keep_pictures(const FitRecord& record, const fs::path& directory) {
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    const ViewRecord& view = record.views[i];
    const fs::path kept = directory / kept_picture_name(view, i);
    if (view.content && !is_that_of(view, kept)) write_file_atomically(kept, read_file(view.file()));
  }
}

void read_kept_pictures(FitRecord& record, const fs::path& directory) {
  for (std::size_t i = 0; i < record.views.size(); ++i)
    if (record.views[i].content) record.views[i].copy = directory / kept_picture_name(record.views[i], i);
}

}  // namespace espalier
