// The exchange between the streams and the evaluating thread: one mutex, a condition for each side.
// `running_` counts the streams that have neither asked nor finished; the one that brings it to 0 wakes the
// evaluating thread.
#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <espalier/fitting/optimizers/lockstep_streams.h>

namespace espalier {

class LockstepExchange {
 public:
  LockstepExchange(std::size_t count, std::size_t dimension) : slots_(count), running_(count) {
    for (Slot& slot : slots_) slot.point.resize(dimension);
  }

  bool ask(std::size_t stream, std::span<const double> point, double& value) noexcept {
    std::unique_lock lock(mutex_);
    if (stopped_) return false;
    Slot& slot = slots_[stream];
    std::copy(point.begin(), point.end(), slot.point.begin());
    settle(slot, State::posted);
    answered_.wait(lock, [&] { return stopped_ || slot.state == State::answered; });
    if (slot.state != State::answered) return false;
    slot.state = State::running;
    value = slot.value;
    return true;
  }

  void finish(std::size_t stream, std::exception_ptr error) noexcept {
    const std::lock_guard lock(mutex_);
    slots_[stream].error = std::move(error);
    settle(slots_[stream], State::finished);
  }

  void stop() noexcept {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    answered_.notify_all();
  }

  /// Waits until every live stream has posted; their points, in stream order. Empty when none lives.
  std::vector<double> collect() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [&] { return running_ == 0; });
    std::vector<double> points;
    for (const Slot& slot : slots_) {
      if (slot.error) std::rethrow_exception(slot.error);
      if (slot.state == State::posted) points.insert(points.end(), slot.point.begin(), slot.point.end());
    }
    return points;
  }

  /// values: those of the points that collect() returned.
  void answer(std::span<const double> values) {
    const std::lock_guard lock(mutex_);
    std::size_t next = 0;
    for (Slot& slot : slots_) {
      if (slot.state != State::posted) continue;
      slot.value = values[next++];
      slot.state = State::answered;
      ++running_;
    }
    answered_.notify_all();
  }

 private:
  enum class State { running, posted, answered, finished };
  struct Slot {
    std::vector<double> point;
    double value = 0;
    State state = State::running;
    std::exception_ptr error;
  };

  /// A running stream asks or ends; the mutex is held.
  void settle(Slot& slot, State state) noexcept {
    const bool was_running = slot.state == State::running || slot.state == State::answered;
    slot.state = state;
    if (was_running && --running_ == 0) settled_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable settled_, answered_;
  std::vector<Slot> slots_;
  std::size_t running_;
  bool stopped_ = false;
};

bool StreamPort::ask(std::span<const double> point, double& value) noexcept {
  return exchange_.ask(stream_, point, value);
}

namespace {

/// The threads of a run; leaving the scope, by whatever way, stops and joins them.
struct StreamThreads {
  LockstepExchange& exchange;
  std::vector<std::jthread> threads;

  ~StreamThreads() {
    exchange.stop();
    threads.clear();
  }
};

void run_stream(LockstepExchange& exchange, std::size_t stream,
                const std::function<void(std::size_t, StreamPort&)>& body) noexcept {
  std::exception_ptr error;
  try {
    StreamPort port(exchange, stream);
    body(stream, port);
  } catch (...) {
    error = std::current_exception();
  }
  exchange.finish(stream, error);
}

}  // namespace

void run_lockstep(Evaluator& evaluator, std::size_t count,
                  const std::function<void(std::size_t, StreamPort&)>& body) {
  LockstepExchange exchange(count, evaluator.dimension());
  StreamThreads streams{exchange, {}};
  for (std::size_t i = 0; i < count; ++i)
    streams.threads.emplace_back([&exchange, &body, i] { run_stream(exchange, i, body); });
  for (std::vector<double> points; !(points = exchange.collect()).empty();)
    exchange.answer(evaluator.evaluate(points));
}

}  // namespace espalier
