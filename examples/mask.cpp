// Draws the silhouette of a tree, from the front and from the side, and says how alike the two are.
//   mask quaking_aspen front.png side.png
#include <fmt/core.h>

#include <espalier/espalier.h>

using namespace espalier;

int main(int count, char** arguments) {
  if (count != 4) return fmt::print(stderr, "usage: mask SPECIES FRONT.png SIDE.png\n"), 2;
  try {
    const Preset preset = load_preset(arguments[1]);
    Plant plant;
    model_by_name(preset.model).generate(preset.values, 1, {}, plant);

    // Two renderers follow one rule: a pixel is set where the ray through its centre meets the plant. This
    // one is fast and serves searches; make_embree_renderer() traces every ray and is the reference.
    const auto renderer = make_scanline_renderer();
    Mask front, side;
    renderer->draw(plant, frame_bounds(bounds(plant), {.azimuth_deg = 0}, 256, 256), front);
    renderer->draw(plant, frame_bounds(bounds(plant), {.azimuth_deg = 90}, 256, 256), side);
    write_mask_png(arguments[2], front);
    write_mask_png(arguments[3], side);

    fmt::print("{} pixels in front, {} from the side, IoU {:.3f}\n", area_px(front), area_px(side),
               iou(front, side));
  } catch (const InputError& error) {
    return fmt::print(stderr, "{}\n", error.what()), 2;
  }
}
