// Fits a tree to a picture. The run's directory holds best.toml, which the program `espalier` renders,
// exports and fits further, and all that repeats the run (docs/formats.md).
//   fit tree.png runs/tree 300
#include <fmt/core.h>

#include <string>

#include <espalier/espalier.h>

using namespace espalier;

int main(int count, char** arguments) {
  if (count != 4) return fmt::print(stderr, "usage: fit PICTURE DIRECTORY EVALUATIONS\n"), 2;
  try {
    // The record holds everything that the result depends on.
    FitRecord record;
    record.views = {{arguments[1], {}}};
    record.objective = kFitObjective;  // what the program minimises, too
    record.budget.evaluations = std::stol(arguments[3]);
    record.budget.seconds = 0;  // no limit
    record.seed = 1;

    // The options hold what it does not depend on.
    FitExecution options;
    options.on_warning = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
    options.on_progress = [](const FitProgress& progress) {
      fmt::print(stderr, "{} evaluations, fitness {:.3f}\n", progress.evaluations, progress.best_fitness);
    };

    const FitResult result = fit(record, arguments[2], options);
    fmt::print("fitness {:.3f}, IoU {:.3f}, {} evaluations, from {}\n", result.fitness, result.metrics["iou"],
               result.evaluations, result.best_start);
  } catch (const InputError& error) {
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
