#include <espalier/core/error.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/overrides_tree.h>

namespace espalier {

Seed seed_of(const Preset& preset) { return preset.seed.value_or(1); }

namespace {

Plant grow(const Preset& preset, const std::string& name, const PresetGrowth& growth,
           const ChangeGraph& changes, std::vector<ChangeCursor>* stem_cursors) {
  if (growth.steps && !model_by_name(preset.model).grows_in_steps())
    throw_input_error(
        "{}: got {} steps, expected none: a plant of {} is not grown in steps, those of L-systems are", name,
        *growth.steps, preset.model);
  const std::unique_ptr<Volume> outlines = growth.prune_to ? nullptr : envelope_of(preset.grown_into);
  GrowthSettings settings;
  settings.prune_to = growth.prune_to ? growth.prune_to : outlines.get();
  settings.train = growth.prune_to == nullptr;
  settings.changes = &changes;
  settings.stem_cursors = stem_cursors;
  settings.steps = growth.steps.value_or(kAllSteps);
  Plant plant;
  const Seed seed = growth.seed.value_or(seed_of(preset));
  const GrowthResult result = model_by_name(preset.model).generate(preset.values, seed, settings, plant);
  if (!result.grown)
    throw_input_error("{}: would have {:.3g} times as many stems or leaves as allowed ({:g} and {:g})", name,
                      result.over_budget_factor, settings.budget.max_stems, settings.budget.max_leaves);
  return plant;
}

}  // namespace

Plant grow_preset(const Preset& preset, const std::string& name, const PresetGrowth& growth) {
  return grow(preset, name, growth, ChangeGraph(preset.overrides), nullptr);
}

std::vector<std::size_t> count_overridden(const Preset& preset, const std::string& name) {
  const ChangeGraph changes(preset.overrides);
  std::vector<ChangeCursor> stem_cursors;
  grow(preset, name, {}, changes, &stem_cursors);
  return count_branches(preset.overrides, stem_cursors);
}

}  // namespace espalier
