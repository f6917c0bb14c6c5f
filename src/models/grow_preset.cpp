#include <espalier/core/error.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

Seed seed_of(const Preset& preset) { return preset.seed.value_or(1); }

Plant grow_preset(const Preset& preset, const std::string& name, const PresetGrowth& growth) {
  if (growth.steps && !model_by_name(preset.model).grows_in_steps())
    throw_input_error(
        "{}: got {} steps, expected none: a plant of {} is not grown in steps, those of L-systems are", name,
        *growth.steps, preset.model);
  const std::unique_ptr<Volume> outlines = growth.prune_to ? nullptr : envelope_of(preset.grown_into);
  const ChangeGraph changes(preset.overrides);
  GrowthSettings settings;
  settings.prune_to = growth.prune_to ? growth.prune_to : outlines.get();
  settings.train = growth.prune_to == nullptr;
  settings.changes = &changes;
  settings.steps = growth.steps.value_or(kAllSteps);
  Plant plant;
  const Seed seed = growth.seed.value_or(seed_of(preset));
  const GrowthResult result = model_by_name(preset.model).generate(preset.values, seed, settings, plant);
  if (!result.grown)
    throw_input_error("{}: would have {:.3g} times as many stems or leaves as allowed ({:g} and {:g})", name,
                      result.over_budget_factor, settings.budget.max_stems, settings.budget.max_leaves);
  return plant;
}

}  // namespace espalier
