// What the asymmetric crown envelope costs: a ray from inside to its surface, and whether a point is inside.
//   build/bin/bench_crown_envelope
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include <espalier/environment/crown_envelope.h>

namespace espalier {
namespace {

CrownEnvelope crown(float shape_above, float shape_below) {
  return CrownEnvelope({.top_m = {0.3f, 0, 10},
                        .bottom_m = {0, 0, 2},
                        .radius_m = {4, 3, 2.5f, 3.5f},
                        .rim_m = {4.5f, 5, 6, 4},
                        .shape_above = shape_above,
                        .shape_below = shape_below});
}

struct Ray {
  Vec3 from_m, direction;
};

/// From the axis, in all directions.
std::vector<Ray> rays() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<Ray> rays(1024);
  for (Ray& ray : rays)
    ray = {{0, 0, 4 + std::fabs(normal(random))},
           normalized({normal(random), normal(random), normal(random)})};
  return rays;
}

/// One question after the other: `ask` gets the envelope and a ray.
template <typename Ask>
void ask_all(benchmark::State& state, float shape_above, float shape_below, const Ask& ask) {
  const CrownEnvelope envelope = crown(shape_above, shape_below);
  const std::vector<Ray> all = rays();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(envelope, all[i++ % all.size()]));
}

void reach(benchmark::State& state, float shape_above, float shape_below) {
  ask_all(state, shape_above, shape_below, [](const CrownEnvelope& envelope, const Ray& ray) {
    return envelope.reach_m(ray.from_m, ray.direction);
  });
}

void contains(benchmark::State& state, float shape_above, float shape_below) {
  ask_all(state, shape_above, shape_below, [](const CrownEnvelope& envelope, const Ray& ray) {
    return envelope.contains(ray.from_m + 3 * ray.direction);
  });
}

void build(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(crown(2, 1.3f).shape());
}

BENCHMARK_CAPTURE(reach, ellipsoid, 2, 2);
BENCHMARK_CAPTURE(reach, any_shape, 2.4f, 1.3f);
BENCHMARK_CAPTURE(contains, ellipsoid, 2, 2);
BENCHMARK_CAPTURE(contains, any_shape, 2.4f, 1.3f);
BENCHMARK(build);

}  // namespace
}  // namespace espalier
