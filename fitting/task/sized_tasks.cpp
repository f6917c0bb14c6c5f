#include <espalier/fitting/task/record_task.h>
#include <espalier/fitting/task/sized_tasks.h>

namespace espalier {

const FitTask& SizedTasks::at(int size_px) {
  const auto found = made_.find(size_px);
  if (found != made_.end()) return found->second;
  return made_.emplace(size_px, make_task_at(record_, size_px, task_.model)).first->second;
}

}  // namespace espalier
