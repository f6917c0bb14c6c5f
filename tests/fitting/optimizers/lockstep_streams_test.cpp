// Streams in lockstep: batches in stream order, the same whatever the threads do; ends by every way out.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include <espalier/fitting/optimizers/lockstep_streams.h>

#include "support/test_functions.h"

namespace espalier {
namespace {

using namespace test;

/// A stream that asks for `steps` points of its own, sleeping at random in between.
void walk(std::size_t stream, StreamPort& port, int steps, bool jitter) {
  std::minstd_rand random(std::random_device{}());
  double value = 0;
  for (int step = 0; step < steps; ++step) {
    if (jitter) std::this_thread::sleep_for(std::chrono::microseconds(random() % 300));
    const double point[] = {0.1 * static_cast<double>(stream), 0.01 * step};
    if (!port.ask(point, value)) return;
    EXPECT_EQ(value, Sphere(2).value(point));
  }
}

TEST(LockstepStreams, BatchesAreInStreamOrderWhateverTheTiming) {
  Trace calm, jittered;
  for (Trace* trace : {&calm, &jittered}) {
    const Sphere sphere(2);
    const Budget budget;
    Evaluator evaluator(sphere, budget, *trace);
    run_lockstep(evaluator, 3, [&](std::size_t stream, StreamPort& port) {
      walk(stream, port, 5 + 4 * static_cast<int>(stream), trace == &jittered);
    });
  }
  EXPECT_EQ(calm.points, jittered.points);
  // Streams that have ended leave the batch: 5 batches of three, 4 of two, 4 of one.
  EXPECT_EQ(calm.batch_sizes, (std::vector<std::size_t>{3, 3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1}));
  EXPECT_EQ(jittered.batch_sizes, calm.batch_sizes);
  EXPECT_EQ(std::vector<double>(calm.points.begin(), calm.points.begin() + 6),
            (std::vector<double>{0, 0, 0.1, 0, 0.2, 0}));
}

TEST(LockstepStreams, AllBodiesHaveReturnedWhenTheRunIsStopped) {
  const Sphere sphere(2);
  const Budget budget{10};
  Observer silent;
  Evaluator evaluator(sphere, budget, silent);
  std::atomic<int> returned = 0;
  EXPECT_THROW(run_lockstep(evaluator, 4,
                            [&](std::size_t stream, StreamPort& port) {
                              walk(stream, port, 1000, false);
                              ++returned;
                            }),
               StopSearch);
  EXPECT_EQ(returned, 4);
  EXPECT_EQ(sphere.count(), 10);  // the third batch was cut to two
}

TEST(LockstepStreams, AskingAfterTheEndIsRefusedAtOnce) {
  const Sphere sphere(2);
  const Budget budget{3};
  Observer silent;
  Evaluator evaluator(sphere, budget, silent);
  std::atomic<int> refused = 0;
  EXPECT_THROW(run_lockstep(evaluator, 2,
                            [&](std::size_t, StreamPort& port) {
                              const double point[] = {0.5, 0.5};
                              double value = 0;
                              while (port.ask(point, value)) continue;
                              for (int i = 0; i < 5; ++i) refused += !port.ask(point, value);
                            }),
               StopSearch);
  EXPECT_EQ(refused, 10);
}

TEST(LockstepStreams, ABodysErrorEndsTheOtherStreams) {
  const Sphere sphere(2);
  const Budget budget;
  Observer silent;
  Evaluator evaluator(sphere, budget, silent);
  EXPECT_THROW(run_lockstep(evaluator, 3,
                            [&](std::size_t stream, StreamPort& port) {
                              walk(stream, port, stream == 1 ? 2 : 1000000, false);
                              if (stream == 1) throw std::runtime_error("stream 1 failed");
                            }),
               std::runtime_error);
  EXPECT_LE(sphere.count(), 9);
}

TEST(LockstepStreams, AnObjectivesErrorArrivesAtTheCaller) {
  const Failing failing(2, 7);
  const Budget budget;
  Observer silent;
  Evaluator evaluator(failing, budget, silent);
  EXPECT_THROW(run_lockstep(evaluator, 3,
                            [](std::size_t, StreamPort& port) {
                              const double point[] = {0.5, 0.5};
                              double value = 0;
                              while (port.ask(point, value)) continue;
                            }),
               std::runtime_error);
}

}  // namespace
}  // namespace espalier
