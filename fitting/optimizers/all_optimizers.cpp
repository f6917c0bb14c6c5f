// The optimisers by name.
#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/fitting/optimizers/methods.h>

namespace espalier {

namespace {

std::vector<std::unique_ptr<Optimizer>> make_all() {
  std::vector<std::unique_ptr<Optimizer>> all;
  for (auto* make : kOwnMethods) all.push_back(make());
  for (auto& optimizer : make_nlopt_optimizers()) all.push_back(std::move(optimizer));
  return all;
}

}  // namespace

const std::vector<std::unique_ptr<Optimizer>>& all_optimizers() {
  static const auto all = make_all();
  return all;
}

const Optimizer& optimizer_by_name(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& optimizer : all_optimizers()) {
    if (optimizer->name() == name) return *optimizer;
    names.push_back(optimizer->name());
  }
  throw_input_error("got optimizer '{}', expected a known one: did you mean '{}'?", name,
                    closest_name(name, names));
}

}  // namespace espalier
