// Any row of the NLopt table as an optimiser: streams in lockstep, each running NLopt, restarted where it
// stops. NLopt's C code cannot be unwound, so its callback never throws: when the run has ended it asks NLopt
// to stop and hands out kWorstValue until it does. NLopt's random state is per thread and seeded before
// each NLopt run. The budget is unknown to NLopt.
#include <algorithm>
#include <memory>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/fitting/optimizers/lockstep_streams.h>
#include <espalier/fitting/optimizers/methods.h>
#include <espalier/fitting/optimizers/nlopt_algorithms.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

struct NloptDeleter {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using NloptHandle = std::unique_ptr<nlopt_opt_s, NloptDeleter>;

/// What NLopt's callback works on; one per NLopt run.
struct NloptCall {
  StreamPort& port;
  nlopt_opt opt;
  const RatedPoint* known;     ///< the start point, where its value is known already; else null
  std::vector<bool> mirrored;  ///< coordinates that NLopt sees as 1 - x
  std::vector<double> point;
  RatedPoint best;
  long stoppable_after;  ///< callbacks before which NLopt must not be asked to stop
  long callbacks = 0;
  long asked = 0;
  bool stopped = false;
};

/// Into the box: some methods step over a bound by rounding.
void read_point(NloptCall& call, const double* x) {
  for (std::size_t i = 0; i < call.point.size(); ++i) {
    const double inside = x[i] > 0 ? std::min(x[i], 1.0) : 0;  // NaN becomes 0
    call.point[i] = call.mirrored[i] ? 1 - inside : inside;
  }
}

/// Once the run has ended: asks NLopt to stop, as soon as that is safe.
double refuse(NloptCall& call) noexcept {
  call.stopped = true;
  if (call.callbacks > call.stoppable_after) nlopt_force_stop(call.opt);
  return kWorstValue;
}

double nlopt_callback(unsigned, const double* x, double*, void* data) noexcept {
  NloptCall& call = *static_cast<NloptCall*>(data);
  ++call.callbacks;
  if (call.stopped) return refuse(call);
  read_point(call, x);
  double value = kWorstValue;
  const bool is_known = call.known && call.asked == 0 && call.point == call.known->point;
  if (is_known)
    value = call.known->value;
  else if (!call.port.ask(call.point, value))
    return refuse(call);
  ++call.asked;
  if (call.asked == 1 || value < call.best.value) call.best = {call.point, value};
  return value;
}

void check_nlopt(const NloptAlgorithm& row, nlopt_result result) {
  if (result == NLOPT_INVALID_ARGS || result == NLOPT_OUT_OF_MEMORY)
    throw InternalError(fmt::format("{}: NLopt returned {}", row.name, nlopt_result_to_string(result)));
}

NloptHandle create(const NloptAlgorithm& row, nlopt_algorithm algorithm, std::size_t dimension) {
  NloptHandle opt(nlopt_create(algorithm, static_cast<unsigned>(dimension)));
  if (!opt) throw InternalError(fmt::format("{}: this NLopt was built without it", row.name));
  check_nlopt(row, nlopt_set_lower_bounds1(opt.get(), 0));
  check_nlopt(row, nlopt_set_upper_bounds1(opt.get(), 1));
  return opt;
}

void set_local_steps(const NloptAlgorithm& row, nlopt_opt opt, const Search& run) {
  check_nlopt(row, nlopt_set_initial_step1(opt, run.setting("initial_step")));
  check_nlopt(row, nlopt_set_xtol_abs1(opt, run.setting("xtol")));
}

NloptHandle configure(const NloptAlgorithm& row, const Search& run) {
  const std::size_t dimension = run.evaluator.dimension();
  NloptHandle opt = create(row, row.algorithm, dimension);
  if (row.kind == NloptKind::local) set_local_steps(row, opt.get(), run);
  if (row.kind == NloptKind::multistart) {
    const NloptHandle local = create(row, row.local, dimension);
    set_local_steps(row, local.get(), run);
    check_nlopt(row, nlopt_set_local_optimizer(opt.get(), local.get()));
  }
  if (row.has_population)
    check_nlopt(row, nlopt_set_population(opt.get(), static_cast<unsigned>(run.count_setting("population"))));
  check_nlopt(row, nlopt_set_maxeval(opt.get(), row.run_limit));
  return opt;
}

/// Sobol's points are the same in every run; mirrored axes tell streams and restarts of MLSL apart.
std::vector<bool> mirrored_axes(const NloptAlgorithm& row, std::size_t dimension, RandomStream& draws) {
  std::vector<bool> mirrored(dimension, false);
  if (row.algorithm == NLOPT_G_MLSL_LDS)
    for (std::size_t i = 0; i < dimension; ++i) mirrored[i] = draws.chance(0.5);
  return mirrored;
}

/// One run of NLopt from `start`; its best point, or nothing where the search has ended.
std::optional<RatedPoint> run_once(const NloptAlgorithm& row, const Search& run, const RatedPoint& start,
                                   bool start_is_known, RandomStream& draws, StreamPort& port) {
  const NloptHandle opt = configure(row, run);
  const std::size_t dimension = start.point.size();
  NloptCall call{port,
                 opt.get(),
                 start_is_known ? &start : nullptr,
                 mirrored_axes(row, dimension, draws),
                 start.point,
                 {start.point},
                 row.stops_in_first_points ? 0 : 2 * static_cast<long>(dimension) + 1};
  check_nlopt(row, nlopt_set_min_objective(opt.get(), nlopt_callback, &call));
  std::vector<double> x = start.point;
  for (std::size_t i = 0; i < dimension; ++i)
    if (call.mirrored[i]) x[i] = 1 - x[i];
  double value = 0;
  nlopt_srand(static_cast<unsigned long>(draws.bits() >> 32));
  check_nlopt(row, nlopt_optimize(opt.get(), x.data(), &value));
  if (call.stopped) return std::nullopt;
  if (call.asked == 0) throw InternalError(fmt::format("{}: NLopt stopped without a step", row.name));
  return call.best;
}

/// Where a stream goes on: at a random point, or near its best one.
std::vector<double> restart_point(const Search& run, const RatedPoint& best, RandomStream& draws) {
  if (draws.chance(run.setting("restart_random"))) return random_point(best.point.size(), draws);
  std::vector<double> point = best.point;
  for (double& x : point) x = reflect_into_unit(x + run.setting("restart_radius") * draws.normal());
  return point;
}

void run_stream(const NloptAlgorithm& row, const Search& run, std::size_t stream, StreamPort& port) {
  RandomStream draws = random_stream_at(run.key, stream, 0);
  const bool given = stream < run.starts.size();
  RatedPoint best = given ? run.starts[stream] : RatedPoint{random_point(run.evaluator.dimension(), draws)};
  RatedPoint start = best;
  for (std::uint64_t round = 1;; ++round) {
    const auto found = run_once(row, run, start, given && round == 1, draws, port);
    if (!found || row.kind == NloptKind::deterministic) return;
    if (found->value < best.value) best = *found;
    draws = random_stream_at(run.key, stream, round);
    start.point = row.kind == NloptKind::local ? restart_point(run, best, draws)
                                               : random_point(best.point.size(), draws);
  }
}

std::vector<OptimizerSetting> local_step_settings() {
  return {{"initial_step", 0.2, 1e-6, 0.5, "first step of the local method, as a share of the box"},
          {"xtol", 1e-6, 1e-12, 0.1, "step at which a local method stops, as a share of the box"}};
}

std::vector<OptimizerSetting> restart_settings() {
  return {
      {"restart_random", 0.5, 0, 1, "chance that a restart begins at a random point, else near the best"},
      {"restart_radius", 0.1, 0, 1, "standard deviation of a start near the best, as a share of the box"}};
}

class NloptOptimizer final : public SearchMethod {
 public:
  explicit NloptOptimizer(const NloptAlgorithm& row) : row_(row) {}

  std::string name() const override { return row_.name; }
  std::string help() const override { return "NLopt: " + row_.help; }
  std::size_t min_dimension() const override { return row_.min_dimension; }
  std::size_t max_dimension() const override { return row_.max_dimension; }
  bool uses_seed() const override { return row_.kind != NloptKind::deterministic; }

  std::vector<OptimizerSetting> settings() const override {
    std::vector<OptimizerSetting> all;
    const auto add = [&](const std::vector<OptimizerSetting>& some) {
      all.insert(all.end(), some.begin(), some.end());
    };
    // A population needs its evaluations: see docs/optimizers.md for CRS2 with 1, 2 and 4 streams.
    const double streams = row_.kind == NloptKind::stochastic ? 2 : 4;
    if (uses_seed())
      add({{"streams", streams, 1, 256, "independent searches, evaluated side by side", true}});
    if (row_.has_population)
      add({{"population", 0, 0, 65536, "points of one search; 0: NLopt's default", true}});
    if (row_.kind == NloptKind::local || row_.kind == NloptKind::multistart) add(local_step_settings());
    if (row_.kind == NloptKind::local) add(restart_settings());
    return all;
  }

 private:
  void search(Search& run) const override {
    const std::size_t streams = uses_seed() ? run.count_setting("streams") : 1;
    run_lockstep(run.evaluator, streams,
                 [&](std::size_t stream, StreamPort& port) { run_stream(row_, run, stream, port); });
  }

  const NloptAlgorithm& row_;
};

}  // namespace

std::vector<std::unique_ptr<Optimizer>> make_nlopt_optimizers() {
  std::vector<std::unique_ptr<Optimizer>> optimizers;
  for (const NloptAlgorithm& row : nlopt_algorithms())
    optimizers.push_back(std::make_unique<NloptOptimizer>(row));
  return optimizers;
}

}  // namespace espalier
