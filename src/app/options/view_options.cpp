// Options of commands that draw one plant: size in pixels, view in degrees.
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include <espalier/app/options/view_options.h>
#include <espalier/core/error.h>

namespace espalier {

namespace {

constexpr int kLargestSizePx = 4096;

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
    return std::nullopt;
  return value;
}

void check_range(const char* option, double value, double lower, double upper) {
  if (!(value >= lower && value <= upper))
    throw_input_error("{} {}: expected a number from {} to {}", option, value, lower, upper);
}

View parse_view(const ViewOptions& options) {
  View view;
  view.azimuth_deg = static_cast<float>(options.azimuth_deg);
  view.elevation_deg = static_cast<float>(options.elevation_deg);
  view.projection = options.perspective ? Projection::perspective : Projection::orthographic;
  view.field_of_view_deg = static_cast<float>(options.field_of_view_deg);
  if (options.view.empty()) return view;
  const auto angles = parse_angles(options.view);
  if (!angles)
    throw_input_error("--view {}: expected azimuth,elevation in degrees, such as 30,10", options.view);
  view.azimuth_deg = angles->azimuth_deg;
  view.elevation_deg = angles->elevation_deg;
  return view;
}

View checked_view(const ViewOptions& options) {
  const View view = parse_view(options);
  check_range("azimuth", view.azimuth_deg, -3600, 3600);
  check_range("elevation", view.elevation_deg, -90, 90);
  check_range("--field-of-view", view.field_of_view_deg, 1, 150);
  return view;
}

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& options) {
  command.option_defaults()->group("The view");
  command.add_option("--size", options.size, "pixels: N or WxH, up to 4096")->capture_default_str();
  CLI::Option* azimuth = command.add_option("--azimuth", options.azimuth_deg,
                                            "degrees about the vertical; 0 is the front, looking along +y");
  CLI::Option* elevation =
      command.add_option("--elevation", options.elevation_deg, "degrees above the horizon, looking down");
  command.add_option("--view", options.view, "azimuth,elevation in one")
      ->excludes(azimuth)
      ->excludes(elevation);
  command.add_flag("--perspective", options.perspective, "a perspective instead of an orthographic camera");
  command.add_option("--field-of-view", options.field_of_view_deg, "vertical, degrees; with --perspective")
      ->capture_default_str();
  command.option_defaults()->group("Options");
}

std::optional<Angles> parse_angles(const std::string& text) {
  const std::string_view all = text;
  const std::size_t comma = all.find(',');
  const auto azimuth = parse_number<float>(all.substr(0, comma));
  const auto elevation = comma == all.npos ? std::optional(0.0f) : parse_number<float>(all.substr(comma + 1));
  if (!azimuth || !elevation) return std::nullopt;
  return Angles{*azimuth, *elevation};
}

bool sees_ground(const ViewOptions& options) {
  const View view = parse_view(options);
  return view.projection == Projection::perspective || view.elevation_deg > 0;
}

PictureSize parse_size(const std::string& text) {
  const std::string_view all = text;
  const std::size_t cross = all.find_first_of("xX");
  const auto width = parse_number<int>(all.substr(0, cross));
  const auto height = cross == all.npos ? width : parse_number<int>(all.substr(cross + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > kLargestSizePx || *height > kLargestSizePx)
    throw_input_error("--size {}: expected N or WxH with 1 to {} pixels each", text, kLargestSizePx);
  return {*width, *height};
}

Camera camera_of(const ViewOptions& options, const Plant& plant) { return camera_of(options, bounds(plant)); }

Camera camera_of(const ViewOptions& options, const Bounds& box) {
  const PictureSize size = parse_size(options.size);
  return frame_bounds(box, checked_view(options), size.width_px, size.height_px);
}

void check_view(const ViewOptions& options) {
  parse_size(options.size);
  checked_view(options);
}

void check_png_path(const std::string& path) { check_picture_path(path, {".png"}); }

void check_picture_path(const std::string& path, const std::vector<std::string>& extensions) {
  const std::filesystem::path file = path;
  if (std::find(extensions.begin(), extensions.end(), file.extension()) == extensions.end())
    throw_input_error("--output {}: expected a name that ends in {}", path, fmt::join(extensions, " or "));
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error))
    throw_input_error("--output {}: {} is no directory", path, directory.string());
  if (std::filesystem::is_directory(file, error)) throw_input_error("--output {}: is a directory", path);
  if (access(directory.c_str(), W_OK) != 0)
    throw_input_error("--output {}: {} cannot be written", path, directory.string());
}

}  // namespace espalier
