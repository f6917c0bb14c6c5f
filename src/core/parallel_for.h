// A loop over independent tasks on all processors. Each writes into its own slot, so the result does not
// depend on how many there are.
#pragma once
#include <omp.h>

#include <cstddef>
#include <exception>
#include <vector>

namespace espalier {

/// Calls body(0) … body(count - 1), in no order, on `threads` threads (0: one a processor). Where some throw,
/// the one with the lowest index is rethrown at the end.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, int threads = 0) {
  std::vector<std::exception_ptr> errors(count);
  const int used = threads > 0 ? threads : omp_get_max_threads();
#pragma omp parallel for schedule(dynamic, 1) num_threads(used)
  for (long i = 0; i < static_cast<long>(count); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    try {
      body(slot);
    } catch (...) {
      errors[slot] = std::current_exception();
    }
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace espalier
