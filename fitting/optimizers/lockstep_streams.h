// Runs sequential searches side by side: each stream is a thread that asks for one value at a time; when all
// live streams have asked, their points are evaluated as one batch, in stream order, on the calling thread.
// The result depends on the number of streams only, never on how the threads were scheduled.
#pragma once
#include <cstddef>
#include <functional>
#include <span>

#include <espalier/fitting/optimizers/evaluator.h>

namespace espalier {

class LockstepExchange;

/// A stream's connection to the evaluator. It must not outlive the stream's body.
class StreamPort {
 public:
  StreamPort(LockstepExchange& exchange, std::size_t stream) : exchange_(exchange), stream_(stream) {}

  /// Waits until the batch with `point` is evaluated. False where the run has ended: the body should then
  /// return soon; more calls return false at once. Never throws, so C code may stand above it.
  bool ask(std::span<const double> point, double& value) noexcept;

 private:
  LockstepExchange& exchange_;
  std::size_t stream_;
};

/// Runs body(stream, port) for each stream 0 .. count-1 in its own thread until all have returned.
/// Whatever the evaluator throws (StopSearch, an objective's error) or a body throws ends all streams; all
/// threads are joined before it is thrown on.
void run_lockstep(Evaluator& evaluator, std::size_t count,
                  const std::function<void(std::size_t, StreamPort&)>& body);

}  // namespace espalier
