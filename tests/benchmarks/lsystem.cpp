// How fast L-systems are derived, on one thread: modules written a second by all steps, memory per module of
// the final string, and for the query case the turtle's run after each step. docs/lsystem.md has the table.
//   build/bin/bench_lsystem
#include <benchmark/benchmark.h>

#include <string>

#include <espalier/lsystem/derivation/derivation.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {
namespace {

constexpr const char* kGrowth = R"(
axiom: A(1)
productions:
  A(n) --> F[+A(n+1)][-A(n+1)]A(n+1)
)";

constexpr const char* kRewritten = R"(
axiom: S
productions:
  S --> lua
    for i = 1, 100000 do produce("I", i) end
  I(x) --> I(x+1)
)";

constexpr const char* kContext = R"(
axiom: S
productions:
  S --> lua
    for i = 1, 100000 do produce("I", i % 7) end
  I(a) < I(b) > I(c) --> I((a+b+c)/3)
)";

// [Topiary, L-system 6] in a box of 30 units
constexpr const char* kTopiary = R"(
const L = 30, phi = 90, alpha = 32, beta = 20, a = 0, b = 1, c = -5
let prune(x, y, z) = abs(x) > L/2 or abs(y) > L/2 or z < 0 or z > L
let p(k) = min(1, (2*k+1)/k^2)
ignore: + - /
branches: follow
axiom: FA(1)?P(x,y,z)
productions:
  p1: A(k) > ?P(x,y,z) : not prune(x,y,z) --> /(phi)[+(alpha)FA(k+1)?P(x,y,z)]-(beta)FA(k+1) : p(k)
  p2: A(k) > ?P(x,y,z) : not prune(x,y,z) --> /(phi)B(k+1,k+1)-(beta)FA(k+1) : 1-p(k)
  p3: A(k) > ?P(x,y,z) : prune(x,y,z) --> T%
  p4: F > T --> S
  p5: F > S --> SF
  p6: S --> *
  p7: B(m,n) > S --> [+(alpha)FA(max(1,a*m+b*n+c))?P(x,y,z)]
  p8: B(m,n) > F --> B(m+1,n)
  p9: T --> *
)";

/// Derives `steps` steps again and again; the first `unmeasured` ones only prepare the string.
void derive(benchmark::State& state, const char* text, int steps, int unmeasured) {
  const Grammar grammar = parse_grammar(text, "benchmark.lsys");
  Derivation derivation(grammar);
  double written = 0;
  for (auto _ : state) {
    state.PauseTiming();
    derivation.start(1);
    derivation.run(unmeasured);
    const std::size_t before = derivation.modules_written();
    state.ResumeTiming();
    derivation.run(unmeasured + steps);
    written += static_cast<double>(derivation.modules_written() - before);
  }
  const auto modules = static_cast<double>(derivation.string().size());
  state.counters["modules/s"] = benchmark::Counter(written, benchmark::Counter::kIsRate);
  state.counters["modules"] = modules;
  state.counters["bytes/module"] = static_cast<double>(derivation.string().memory_bytes()) / modules;
  state.counters["bytes/module, both strings"] = static_cast<double>(derivation.memory_bytes()) / modules;
}

bool add(const char* name, const char* text, int steps, int unmeasured) {
  benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
    derive(state, text, steps, unmeasured);
  })->Unit(benchmark::kMillisecond);
  return true;
}

const bool kAdded = add("growth", kGrowth, 12, 0) && add("every_module_rewritten", kRewritten, 50, 1) &&
                    add("context", kContext, 50, 1) && add("query_modules", kTopiary, 60, 0);

}  // namespace
}  // namespace espalier::lsystem
