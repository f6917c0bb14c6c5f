#include "fitting/picture_choice.h"

#include "fitting/stages/picture_reading.h"

namespace espalier {

namespace {

PictureReading reading_of(const FitTask& task) { return read_picture(task.views.front().target.mask()); }

/// Where the model has the parameter and the user says nothing of it.
void fix(const FitTask& task, const std::string& name, double value, SearchChoice& choice) {
  if (choice.free.empty() && task.model->table().find(name)) choice.fixed.insert({name, value});
}

}  // namespace

std::string kind_of(const FitRecord& record, const FitTask& task) {
  return record.kind == "auto" ? kind_name(reading_of(task).kind) : record.kind;
}

SearchChoice choice_for(const FitRecord& record, const FitTask& task) {
  SearchChoice choice = record.search;
  if (kind_of(record, task) == "leafless") fix(task, "leaf_blos_num", 0, choice);
  if (record.kind == "auto" && reading_of(task).trunks == 1) fix(task, "branches[0]", 1, choice);
  return choice;
}

}  // namespace espalier
