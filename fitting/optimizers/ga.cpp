// A modern genetic algorithm: tournament selection, SBX or uniform crossover, polynomial mutation whose
// rates evolve with the individuals, elitism, niching by clearing (off by default), restarts on stagnation.
#include <algorithm>

#include <espalier/fitting/optimizers/ga_operators.h>
#include <espalier/fitting/optimizers/methods.h>
#include <espalier/fitting/optimizers/search_method.h>

namespace espalier {

namespace {

using Population = std::vector<Individual>;

void evaluate_from(Search& run, Population& population, std::size_t first) {
  std::vector<double> points;
  for (std::size_t i = first; i < population.size(); ++i)
    points.insert(points.end(), population[i].point.begin(), population[i].point.end());
  const auto values = run.evaluator.evaluate(points);
  for (std::size_t i = first; i < population.size(); ++i) population[i].value = values[i - first];
}

/// The given start points (`starts` of them at most), and random points.
Population first_population(Search& run, std::size_t starts, std::uint64_t generation) {
  const std::size_t dimension = run.evaluator.dimension();
  Population population(run.count_setting("population"));
  starts = std::min({starts, run.starts.size(), population.size()});
  for (std::size_t i = 0; i < population.size(); ++i) {
    RandomStream draws = random_stream_at(run.key, generation, i);
    population[i].rates.chance = std::min(0.5, 1 / static_cast<double>(dimension));
    population[i].point = i < starts ? run.starts[i].point : random_point(dimension, draws);
    if (i < starts) population[i].value = run.starts[i].value;
  }
  if (starts < population.size()) evaluate_from(run, population, starts);
  return population;
}

enum class Crossover { sbx, uniform, either };

void cross(Search& run, RandomStream& draws, Individual& a, Individual& b) {
  if (!draws.chance(run.setting("crossover_chance"))) return;
  const auto kind = static_cast<Crossover>(run.count_setting("crossover"));
  const bool sbx = kind == Crossover::sbx || (kind == Crossover::either && draws.chance(0.5));
  if (sbx)
    sbx_crossover(run.setting("crossover_eta"), draws, a.point, b.point);
  else
    uniform_crossover(draws, a.point, b.point);
}

void add_children(Search& run, const Population& parents, std::span<const std::size_t> rank,
                  RandomStream& draws, Population& next) {
  const std::size_t size = run.count_setting("tournament");
  Individual a = parents[tournament(rank, size, draws)];
  Individual b = parents[tournament(rank, size, draws)];
  const MutationRates rates_of_parents[] = {a.rates, b.rates};
  cross(run, draws, a, b);
  for (Individual* child : {&a, &b}) {
    child->rates = inherit_rates(rates_of_parents[0], rates_of_parents[1], child->point.size(), draws);
    polynomial_mutation(child->rates, draws, child->point);
    if (next.size() < parents.size()) next.push_back(std::move(*child));
  }
}

Population next_generation(Search& run, const Population& parents, std::uint64_t generation) {
  const auto rank = ranks_with_clearing(parents, run.setting("niche_radius"));
  const std::size_t elites = std::min(run.count_setting("elites"), parents.size() - 1);
  Population next(elites);
  for (std::size_t i = 0; i < parents.size(); ++i)
    if (rank[i] < elites) next[rank[i]] = parents[i];
  while (next.size() < parents.size()) {
    RandomStream draws = random_stream_at(run.key, generation, next.size());
    add_children(run, parents, rank, draws, next);
  }
  evaluate_from(run, next, elites);
  return next;
}

double best_value(const Population& population) {
  double best = kWorstValue;
  for (const Individual& individual : population) best = std::min(best, individual.value);
  return best;
}

class Ga final : public SearchMethod {
 public:
  std::string name() const override { return "ga"; }
  std::string help() const override {
    return "genetic algorithm: tournament, SBX or uniform crossover, self-adapted polynomial mutation";
  }
  std::vector<OptimizerSetting> settings() const override {
    return {
        {"population", 30, 2, 65536, "individuals", true},
        {"tournament", 3, 1, 1000, "individuals a parent has to beat, itself counted", true},
        {"crossover", 2, 0, 2, "0: SBX, 1: uniform, 2: either by a coin", true},
        {"crossover_chance", 0.9, 0, 1, "chance that a pair of parents is crossed"},
        {"crossover_eta", 10, 0, 200, "distribution index of SBX: larger means nearer to the parents"},
        {"elites", 2, 0, 65535, "best individuals kept unchanged", true},
        {"niche_radius", 0, 0, 1, "distance inside which only the best one counts as good; 0: no niching"},
        {"stagnation", 50, 1, 1e6, "generations without a better value before a restart", true},
    };
  }

 private:
  void search(Search& run) const override {
    std::uint64_t generation = 0;
    for (std::size_t starts = run.starts.size();; starts = 0) evolve(run, starts, generation);
  }

  /// One population from its beginning to its stagnation.
  static void evolve(Search& run, std::size_t starts, std::uint64_t& generation) {
    Population population = first_population(run, starts, generation++);
    double best = best_value(population);
    for (double idle = 0; idle < run.setting("stagnation"); ++idle) {
      population = next_generation(run, population, generation++);
      if (best_value(population) < best) {
        best = best_value(population);
        idle = -1;
      }
    }
  }
};

}  // namespace

std::unique_ptr<Optimizer> make_ga() { return std::make_unique<Ga>(); }

}  // namespace espalier
