#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <optional>

#include <espalier/app/growth_frames.h>
#include <espalier/app/options/long_work.h>
#include <espalier/app/options/messages.h>
#include <espalier/core/error.h>
#include <espalier/image/pictures/animation.h>
#include <espalier/image/pictures/picture.h>
#include <espalier/lsystem/drawing/plant_builder.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

bool is_gif(const std::string& path) { return fs::path(path).extension() == ".gif"; }

/// "growth.png" becomes "growth_003.png".
std::string frame_path(const std::string& path, int frame) {
  const fs::path file = path;
  return (file.parent_path() /
          fmt::format("{}_{:03}{}", file.stem().string(), frame, file.extension().string()))
      .string();
}

/// The steps that a frame shows, with the share of the step after them.
double time_of(int frame, int frames, int steps) {
  return frames == 1 ? steps : static_cast<double>(frame) * steps / (frames - 1);
}

/// The derivation ends with the last of its `steps`, and not with a picture before.
void grow_to(double time, int steps, lsystem::Derivation& derivation, Plant& plant) {
  const double step = std::floor(time);
  if (time < steps)
    derivation.advance(static_cast<int>(step));
  else
    derivation.run(steps);
  derivation.work().restart();  // what is asked for is a picture more
  const lsystem::ModuleString& drawn = derivation.interpreted(time - step);
  lsystem::build_plant(drawn, derivation.alphabet(), derivation.settings(), plant, derivation.work());
}

}  // namespace

void check_growth_frames(const GrowthFrames& options) {
  if (options.frames < 1 || options.frames > 1000)
    throw_input_error("--frames {}: expected 1 to 1000", options.frames);
  if (!(options.seconds >= 0.02 && options.seconds <= 10))
    throw_input_error("--frame-seconds {}: expected 0.02 to 10", options.seconds);
  check_picture_path(options.output, {".png", ".gif"});
}

void write_growth_frames(lsystem::Derivation& derivation, const ParameterValues& values, Seed seed, int steps,
                         const ViewOptions& view, const ShadedSettings& shading,
                         const GrowthFrames& options) {
  watch_for_interrupt();
  ProgressLine progress(false, 10);
  Plant plant;
  derivation.start(values, seed);
  grow_to(steps, steps, derivation, plant);  // first of all, because the camera is that of the last plant
  const Camera camera = camera_of(view, plant);
  std::optional<Animation> animation;
  if (is_gif(options.output))
    animation.emplace(camera.width_px, camera.height_px, options.frames, options.seconds);
  derivation.start(values, seed);
  for (int frame = 0; frame < options.frames; ++frame) {
    progress.show([&] { return fmt::format("frame {} of {}", frame + 1, options.frames); });
    grow_to(time_of(frame, options.frames, steps), steps, derivation, plant);
    const Picture picture = render_shaded(plant, camera, shading);
    if (is_interrupted()) {
      progress.end();
      print_message(fmt::format("interrupted at frame {} of {}", frame + 1, options.frames));
      throw CLI::RuntimeError(130);
    }
    if (animation)
      animation->add(picture);
    else
      write_png(frame_path(options.output, frame), picture);
  }
  progress.end();
  if (animation) animation->write(options.output);
  fmt::print("{}: {} frames of {}×{} px, {} stems and {} leaves at the end\n",
             animation ? options.output : frame_path(options.output, options.frames - 1), options.frames,
             camera.width_px, camera.height_px, plant.stems.size(), plant.leaves.size());
}

}  // namespace espalier
