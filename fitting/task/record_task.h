// The task that a record describes: its pictures read, its objective parsed, its seeds listed.
#pragma once
#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

/// Height of the target in metres: the record's, or the nominal one.
double target_height_m(const FitRecord& record);

/// Reads the record's pictures, notes in `warnings` what is wrong with them, and puts their hash into the
/// record. `model` is used instead of the record's model by name where it is not null. Throws InputError for
/// pictures that cannot be read, or that differ from those of the record's hash.
FitTask make_task(FitRecord& record, const Model* model = nullptr);

/// The same with masks of another size: more of a picture than a search looks at.
FitTask make_task_at(const FitRecord& record, int size_px, const Model* model);

}  // namespace espalier
