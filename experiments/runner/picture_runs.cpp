#include <fmt/format.h>

#include <memory>

#include <espalier/core/error.h>
#include <espalier/environment/scene_object.h>
#include <espalier/environment/volume.h>
#include <espalier/experiments/declaration/picture_changes.h>
#include <espalier/experiments/runner/picture_runs.h>
#include <espalier/fitting/species_space/blend.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/models/grow_preset.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>
#include <espalier/render/shading/seasons.h>

namespace espalier {

namespace fs = std::filesystem;

namespace {

/// Towards another species, in the encoding in which what lies between means something.
void blend_into(const Model& model, const Preset& other, double t, ParameterValues& values) {
  values = blend(model, *make_encoding("monotone", model.table()), values, other.values, t);
}

Plant grow(const PicturesDeclaration& pictures, const PictureChange& change) {
  Preset preset = grown_in(pictures, change);
  const Model& model = model_by_name(preset.model);
  if (!change.blend_with.empty()) blend_into(model, load_preset(change.blend_with), change.t, preset.values);
  for (const auto& [name, value] : change.set) preset.values[model.table().index_of(name)] = value;
  const auto volume = change.prune_to.empty() ? nullptr : parse_volume(change.prune_to);
  return grow_preset(preset, preset.name, {.seed = pictures.seed, .prune_to = volume.get()});
}

SceneObjects objects_in(const PicturesDeclaration& pictures, const PictureChange& change) {
  SceneObjects objects;
  for (const std::string& text : pictures.objects) add_object(text, objects);
  for (const std::string& text : change.objects) add_object(text, objects);
  return objects;
}

/// The whole scene, or a frame of a fixed size whose foot is a twentieth above the bottom edge.
Camera camera_for(const PicturesDeclaration& pictures, const View& view, const Bounds& scene) {
  const int size = pictures.size_px;
  if (pictures.frame_m == 0) return frame_bounds(scene, view, size, size);
  return frame_base({}, view, static_cast<float>(pictures.frame_m / size), size, size,
                    0.95f * static_cast<float>(size));
}

Measured draw(const PicturesDeclaration& pictures, const PictureChange& change, const fs::path& directory) {
  Plant plant = grow(pictures, change);
  const SceneObjects objects = objects_in(pictures, change);
  ShadedSettings shading;
  shading.ground = pictures.ground;
  if (!change.season.empty()) apply_season(change.season, plant, shading);
  const Camera camera = camera_for(pictures, change.view.value_or(pictures.view), bounds(plant, objects));
  fs::create_directories(directory);
  write_png(directory / "picture.png", render_shaded(plant, camera, shading, objects));
  return {
      {{"stems", fmt::format("{}", plant.stems.size())}, {"leaves", fmt::format("{}", plant.leaves.size())}},
      {}};
}

}  // namespace

Plan plan_pictures(const PicturesDeclaration& pictures) {
  Plan plan{.label_columns = {"row", "column"}, .result_columns = {"stems", "leaves"}};
  const auto shared = std::make_shared<const PicturesDeclaration>(pictures);
  for (std::size_t row = 0; row < pictures.rows.size(); ++row)
    for (std::size_t column = 0; column < pictures.columns.size(); ++column) {
      const PictureChange change = merged(pictures.rows[row], pictures.columns[column]);
      plan.runs.push_back({fmt::format("row{}-column{}", row + 1, column + 1),
                           {{"row", pictures.rows[row].label}, {"column", pictures.columns[column].label}},
                           [shared, change](const fs::path& run, const RunContext&) {
                             return std::optional(draw(*shared, change, run));
                           }});
    }
  return plan;
}

}  // namespace espalier
