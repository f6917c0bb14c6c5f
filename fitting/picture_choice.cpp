#include "fitting/picture_choice.h"

#include "fitting/record_task.h"
#include "fitting/stages/measured_start.h"
#include "fitting/stages/picture_reading.h"

namespace espalier {

namespace {

PictureReading reading_of(const FitTask& task) { return read_picture(task.views.front().target.mask()); }

/// Where the model has the parameter and the user says nothing of it.
void fix(const FitTask& task, const std::string& name, double value, SearchChoice& choice) {
  if (choice.free.empty() && task.model->table().find(name)) choice.fixed.insert({name, value});
}

/// Whether the picture is to say anything.
bool is_read(const FitRecord& record) { return record.kind != "any"; }

void measure(const FitRecord& record, const FitTask& task, ParameterValues& values) {
  const double height_m = target_height_m(record);
  const Seed seed = task.plant_seeds.front();
  take_measures(*task.model, record.growth, reading_of(task), height_m, seed, values);
  prepare_start(*task.model, record.growth, height_m, seed, values);
}

}  // namespace

std::string kind_of(const FitRecord& record, const FitTask& task) {
  return record.kind == "auto" ? kind_name(reading_of(task).kind) : record.kind;
}

SearchChoice choice_for(const FitRecord& record, const FitTask& task) {
  SearchChoice choice = record.search;
  const std::string kind = kind_of(record, task);
  if (kind == "leafless") fix(task, "leaf_blos_num", 0, choice);
  if (!is_read(record) || !choice.free.empty()) return choice;
  const PictureReading reading = reading_of(task);
  if (record.kind == "auto" && reading.trunks == 1) fix(task, "branches[0]", 1, choice);
  choice.ranges = measured_ranges(reading, kind_by_name(kind), target_height_m(record));
  return choice;
}

std::vector<StartPoint> starts_for(const FitRecord& record, const FitTask& task) {
  const double height_m = target_height_m(record);
  const Seed seed = task.plant_seeds.front();
  const SearchChoice choice = choice_for(record, task);
  if (!record.stages.search && record.start != "auto")
    return presets_as_written(task.model->table(), record.start);
  std::vector<StartPoint> starts =
      make_start_points(*task.model, record.start, choice, record.growth, height_m, seed);
  for (StartPoint& start : starts) {
    if (is_read(record) && record.start == "auto") measure(record, task, start.values);
    keep_in_ranges(task.model->table(), choice, start.values);
    apply_fixed(task.model->table(), choice, start.values);
  }
  return starts;
}

double search_share(const std::string& kind) { return kind == "leafless" ? 0.15 : 0.4; }

}  // namespace espalier
