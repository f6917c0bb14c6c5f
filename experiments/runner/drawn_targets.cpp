#include <fmt/format.h>

#include <espalier/core/error.h>
#include <espalier/experiments/runner/drawn_targets.h>
#include <espalier/experiments/runner/plan.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/embree/embree_renderer.h>
#include <espalier/render/silhouette.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

constexpr int kDrawnTargetPx = 512;
constexpr double kShortestTreeM = 0.01;

Plant grow_target(const TargetDeclaration& target) {
  const Preset preset = load_preset(target.species);
  Plant plant;
  if (!model_by_name(preset.model).generate(preset.values, target.seed, {}, plant).grown)
    throw_input_error("target '{}': got a tree beyond the growth budget, expected a smaller one",
                      target.name);
  if (!(bounds(plant).upper.z > kShortestTreeM))
    throw_input_error("target '{}': got a tree without height, expected one to draw", target.name);
  return plant;
}

/// Draws the silhouettes of a species, unless an earlier execution did. No other target's name has a '+'.
ReadyTarget draw_target(const TargetDeclaration& target, const fs::path& directory) {
  const Plant plant = grow_target(target);
  const Bounds box = bounds(plant);
  ReadyTarget ready{target, target.views, box.upper.z};
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    const std::string number = i == 0 ? "" : fmt::format("+{}", i + 1);
    const fs::path path =
        fs::absolute(directory / "targets" / (directory_name(target.name) + number + ".png"));
    ready.views[i].picture = path;
    if (fs::exists(path)) continue;
    Mask mask;
    make_embree_renderer()->draw(
        plant, frame_bounds(box, target.views[i].view, kDrawnTargetPx, kDrawnTargetPx), mask);
    fs::create_directories(path.parent_path());
    write_mask_png(path, mask);
  }
  return ready;
}

ReadyTarget ready_target(const TargetDeclaration& target, const fs::path& directory) {
  if (target.species.empty()) return {target, target.views, std::nullopt};
  return draw_target(target, directory);
}

}  // namespace

std::vector<ReadyTarget> draw_targets(const FitsDeclaration& fits, const fs::path& directory) {
  std::vector<ReadyTarget> targets;
  targets.reserve(fits.targets.size());
  for (const TargetDeclaration& target : fits.targets) targets.push_back(ready_target(target, directory));
  return targets;
}

}  // namespace espalier
