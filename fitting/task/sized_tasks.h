// A fit's task with masks of other sizes than the search's: twice as large for the finish, 512 pixels for
// tracing and for the last look. Each is made once, when it is first asked for.
#pragma once
#include <map>

#include <espalier/fitting/record/fit_record.h>
#include <espalier/fitting/task/fit_task.h>

namespace espalier {

class SizedTasks {
 public:
  /// Both must outlive it.
  SizedTasks(const FitRecord& record, const FitTask& task) : record_(record), task_(task) {}

  /// The task with square masks of `size_px`. Throws InputError where the pictures can no longer be read.
  const FitTask& at(int size_px);

 private:
  const FitRecord& record_;
  const FitTask& task_;
  std::map<int, FitTask> made_;
};

}  // namespace espalier
