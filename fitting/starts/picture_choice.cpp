#include <espalier/fitting/branches/palm_trunk.h>
#include <espalier/fitting/picture/picture_reading.h>
#include <espalier/fitting/starts/measured_start.h>
#include <espalier/fitting/starts/picture_choice.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/reading/roots.h>

namespace espalier {

namespace {

PictureReading reading_of(const FitTask& task) { return read_picture(task.views.front().target.mask()); }

/// Where the model has the parameter and the user says nothing of it.
void fix(const FitTask& task, const std::string& name, double value, SearchChoice& choice) {
  if (choice.free.empty() && task.model->table().find(name)) choice.fixed.insert({name, value});
}

constexpr const char* kPresetsWithFronds = "palm,fan_palm";

/// Whether the picture is to say anything.
bool is_read(const FitRecord& record) { return record.kind != KindChoice::any; }

/// The trunk that a palm is held to; none where the user says how to search, or the model has no such trunks.
std::optional<TrunkLine> held_trunk(const FitRecord& record, const FitTask& task) {
  const bool is_left_to_us = record.start == "auto" && record.search.free.empty() && record.fit_seeds == 1;
  if (!is_left_to_us || kind_of(record, task) != KindChoice::palm ||
      task.model->table().model != FitRecord{}.model)
    return std::nullopt;
  return read_trunk_line(without_roots(task.views.front().target.mask()));
}

/// Fronds stay as long as they are while the trunk gets another length.
void fix_trunk(const ParameterTable& table, const SearchChoice& choice, ParameterValues& values) {
  const std::size_t scale = table.index_of("g_scale"), frond = table.index_of("length[1]");
  const double before_m = values[scale];
  apply_fixed(table, choice, values);
  values[frond] =
      std::clamp(values[frond] * before_m / values[scale], table.rows[frond].lower, table.rows[frond].upper);
}

void measure(const FitRecord& record, const FitTask& task, ParameterValues& values) {
  const double height_m = target_height_m(record);
  const Seed seed = task.plant_seeds.front();
  take_measures(*task.model, record.growth, reading_of(task), height_m, seed, values);
  prepare_start(*task.model, record.growth, height_m, seed, values);
}

}  // namespace

KindChoice kind_of(const FitRecord& record, const FitTask& task) {
  return record.kind == KindChoice::automatic ? choice_of(reading_of(task).kind) : record.kind;
}

SearchChoice choice_for(const FitRecord& record, const FitTask& task) {
  SearchChoice choice = record.search;
  const KindChoice kind = kind_of(record, task);
  if (kind == KindChoice::leafless) fix(task, "leaf_blos_num", 0, choice);
  if (!is_read(record) || !choice.free.empty()) return choice;
  const PictureReading reading = reading_of(task);
  if (record.kind == KindChoice::automatic && reading.trunks == 1) fix(task, "branches[0]", 1, choice);
  choice.ranges = measured_ranges(reading, stated_kind(kind).value(), target_height_m(record));
  if (const auto trunk = held_trunk(record, task))
    for (const auto& [name, value] : palm_parameters(*trunk, task.views.front().metres_per_px))
      fix(task, name, value, choice);
  return choice;
}

std::vector<StartPoint> starts_for(const FitRecord& record, const FitTask& task) {
  const double height_m = target_height_m(record);
  const Seed seed = task.plant_seeds.front();
  const SearchChoice choice = choice_for(record, task);
  if (!record.stages.search && record.start != "auto")
    return presets_as_written(task.model->table(), record.start);
  const bool has_fronds = held_trunk(record, task).has_value();
  std::vector<StartPoint> starts = make_start_points(
      *task.model, has_fronds ? kPresetsWithFronds : record.start, choice, record.growth, height_m, seed);
  for (StartPoint& start : starts) {
    if (is_read(record) && record.start == "auto") measure(record, task, start.values);
    keep_in_ranges(task.model->table(), choice, start.values);
    if (has_fronds) fix_trunk(task.model->table(), choice, start.values);
    apply_fixed(task.model->table(), choice, start.values);
  }
  return starts;
}

void hold_trunk(const FitRecord& record, FitTask& task) {
  const auto trunk = held_trunk(record, task);
  if (!trunk) return;
  task.overrides = lay_palm_trunk(task, *trunk, starts_for(record, task).front().values);
  task.changes = std::make_shared<const ChangeGraph>(task.overrides);
  task.growth.changes = task.changes.get();
}

double search_share(KindChoice kind) { return kind == KindChoice::leafless ? 0.15 : 0.4; }

}  // namespace espalier
