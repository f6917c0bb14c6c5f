#include <fmt/format.h>

#include <espalier/core/error.h>
#include <espalier/core/files.h>
#include <espalier/experiments/declaration/target_files.h>
#include <espalier/experiments/runner/kept_targets.h>
#include <espalier/fitting/run/run_pictures.h>
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

/// Draws the silhouettes of a species, unless an earlier execution did.
ReadyTarget draw_target(const TargetDeclaration& target, const fs::path& directory) {
  const Plant plant = grow_target(target);
  const Bounds box = bounds(plant);
  ReadyTarget ready{target, target.views, box.upper.z};
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    const fs::path path = fs::absolute(directory / target_file(target.name, i, ".png"));
    ready.views[i].picture = ready.views[i].copy = path;
    if (fs::exists(path)) continue;
    Mask mask;
    make_embree_renderer()->draw(
        plant, frame_bounds(box, target.views[i].view, kDrawnTargetPx, kDrawnTargetPx), mask);
    fs::create_directories(path.parent_path());
    write_mask_png(path, mask);
  }
  return ready;
}

/// Copies the picture, unless an earlier execution did.
void keep_picture(const fs::path& picture, const fs::path& kept) {
  std::error_code error;
  if (fs::equivalent(picture, kept, error)) return;
  if (!fs::exists(kept)) {
    fs::create_directories(kept.parent_path());
    write_file_atomically(kept, read_file(picture));
  } else if (content_of(picture) != content_of(kept)) {
    throw_input_error("{}: got another picture than {}, of which the directory's runs are, expected that one",
                      picture.string(), kept.string());
  }
}

ReadyTarget keep_target(const TargetDeclaration& target, const fs::path& directory) {
  if (!target.species.empty()) return draw_target(target, directory);
  ReadyTarget ready{target, target.views, std::nullopt};
  for (std::size_t i = 0; i < ready.views.size(); ++i) {
    ViewRecord& view = ready.views[i];
    const fs::path kept = fs::absolute(directory / target_file(target.name, i, view.picture.extension()));
    keep_picture(view.file(), kept);
    view.copy = kept;
  }
  return ready;
}

}  // namespace

std::vector<ReadyTarget> keep_targets(const FitsDeclaration& fits, const fs::path& directory) {
  std::vector<ReadyTarget> targets;
  targets.reserve(fits.targets.size());
  for (const TargetDeclaration& target : fits.targets) targets.push_back(keep_target(target, directory));
  return targets;
}

}  // namespace espalier
