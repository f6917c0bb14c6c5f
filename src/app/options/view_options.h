// The options of commands that draw one plant: picture size and the direction it is seen from.
// Shared by mask and render, so that both frame a plant alike.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <espalier/plant/plant.h>
#include <espalier/render/camera.h>

namespace CLI {
class App;
}

namespace espalier {

struct ViewOptions {
  std::string size = "512";  ///< "N" or "WxH", 1..4096 pixels
  std::string view;          ///< "azimuth,elevation" in degrees, or empty
  double azimuth_deg = 0;    ///< 0 = front view, looks along +y
  double elevation_deg = 0;  ///< -90..90, positive looks down
  bool perspective = false;
  double field_of_view_deg = 40;  ///< vertical, 1..150
};

/// Adds --size, --view, --azimuth, --elevation, --perspective and --field-of-view.
void add_view_options(CLI::App& command, ViewOptions& options);

/// Whether a lawn is more than a line from there.
bool sees_ground(const ViewOptions& options);

struct Angles {
  float azimuth_deg = 0, elevation_deg = 0;
};

/// "30,10", or "30" for an elevation of 0; nothing for other texts.
std::optional<Angles> parse_angles(const std::string& text);

struct PictureSize {
  int width_px = 0, height_px = 0;
};

/// Throws InputError naming the option, what it got and what was expected.
PictureSize parse_size(const std::string& text);

/// The camera that frames the plant, or the box, with a margin of 8 %. Throws InputError as parse_size does.
Camera camera_of(const ViewOptions& options, const Plant& plant);
Camera camera_of(const ViewOptions& options, const Bounds& box);

/// Throws InputError unless the options make a camera: to be called before anything costly is done.
void check_view(const ViewOptions& options);

/// Throws InputError unless `path` ends in .png and lies in a directory that can be written.
void check_png_path(const std::string& path);
/// The same for other endings, such as ".gif".
void check_picture_path(const std::string& path, const std::vector<std::string>& extensions);

}  // namespace espalier
