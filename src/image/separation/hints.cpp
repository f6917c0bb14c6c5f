#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/image/separation/color_field.h>
#include <espalier/image/separation/hints.h>

namespace espalier {

namespace {

/// Whole numbers between commas; nothing where the text is anything else.
std::optional<std::vector<int>> parse_numbers(std::string_view text) {
  std::vector<int> numbers;
  while (true) {
    const std::string_view word = text.substr(0, text.find(','));
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
    if (word.size() == text.size()) return numbers;
    text.remove_prefix(word.size() + 1);
  }
}

[[noreturn]] void refuse_color(const std::string& text) {
  throw_input_error("got '{}', expected a colour: RRGGBB, or R,G,B of 0 to 255", text);
}

bool is_inside(const PixelPlace& place, const PixelBox& box) {
  return place.x >= box.left && place.y >= box.top && place.x < box.left + box.width &&
         place.y < box.top + box.height;
}

void check_places(const std::vector<PixelPlace>& places, const PixelBox& box, const char* what,
                  const std::string& name) {
  for (const PixelPlace& place : places)
    if (!is_inside(place, box))
      throw_input_error("{}: got {} {},{}, expected a place within x {} to {} and y {} to {}", name, what,
                        place.x, place.y, box.left, box.left + box.width - 1, box.top,
                        box.top + box.height - 1);
}

bool has_seeds_or_colors(const SeparationOptions& options) {
  return options.ground_color || options.tree_color || !options.tree_seeds.empty() ||
         !options.ground_seeds.empty();
}

void check_contradictions(const SeparationOptions& options, const std::string& name) {
  using enum SeparationMethod;
  if (!options.label.empty() && (options.method != automatic || has_seeds_or_colors(options)))
    throw_input_error("{}: got a label with {}, expected one of them", name,
                      options.method != automatic ? "a separation" : "colours or seeds");
  if ((options.method == alpha || options.method == luminance) && has_seeds_or_colors(options))
    throw_input_error("{}: got colours or seeds with the separation '{}', expected 'auto' or 'background'",
                      name, name_of(options.method));
  if (options.ground_color && options.tree_color &&
      color_distance(*options.ground_color, *options.tree_color) < 0.02f)
    throw_input_error("{}: got the same colour for ground and tree, expected two", name);
  for (const PixelPlace& tree : options.tree_seeds)
    for (const PixelPlace& ground : options.ground_seeds)
      if (tree.x == ground.x && tree.y == ground.y)
        throw_input_error("{}: got {},{} as a seed of tree and ground, expected one of them", name, tree.x,
                          tree.y);
}

void scale_place(double scale, int end_x, int end_y, PixelPlace& place) {
  place.x = std::clamp(static_cast<int>(place.x * scale), 0, end_x - 1);
  place.y = std::clamp(static_cast<int>(place.y * scale), 0, end_y - 1);
}

}  // namespace

std::optional<std::uint32_t> parse_hex_color(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 6 || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

ColorValue parse_hinted_color(const std::string& text) {
  if (const auto value = parse_hex_color(text))
    return {static_cast<float>(*value >> 16) / 255, static_cast<float>(*value >> 8 & 255) / 255,
            static_cast<float>(*value & 255) / 255};
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 3 ||
      std::any_of(numbers->begin(), numbers->end(), [](int number) { return number < 0 || number > 255; }))
    refuse_color(text);
  return {static_cast<float>((*numbers)[0]) / 255, static_cast<float>((*numbers)[1]) / 255,
          static_cast<float>((*numbers)[2]) / 255};
}

PixelBox parse_region(const std::string& text) {
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 4 || (*numbers)[0] < 0 || (*numbers)[1] < 0 || (*numbers)[2] < 8 ||
      (*numbers)[3] < 8)
    throw_input_error("got '{}', expected LEFT,TOP,WIDTH,HEIGHT in pixels, at least 8 wide and high", text);
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

std::vector<PixelPlace> parse_places(const std::string& text) {
  std::vector<PixelPlace> places;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    const auto numbers = parse_numbers(word);
    if (!numbers || numbers->size() != 2)
      throw_input_error("got '{}', expected a place X,Y in pixels of the picture, or several: X,Y;X,Y", text);
    places.push_back({(*numbers)[0], (*numbers)[1]});
  }
  return places;
}

SeparationOptions fitted_to(const SeparationOptions& options, const DecodedPicture& picture,
                            const std::string& name) {
  check_contradictions(options, name);
  const PixelBox whole{0, 0, picture.source_width_px, picture.source_height_px};
  if (options.region) {
    const PixelBox& box = *options.region;
    const std::int64_t right = std::int64_t{box.left} + box.width,
                       bottom = std::int64_t{box.top} + box.height;
    if (right > whole.width || bottom > whole.height)
      throw_input_error("{}: got a region to x {} and y {}, expected one within {}×{} pixels", name, right,
                        bottom, whole.width, whole.height);
  }
  const PixelBox box = options.region.value_or(whole);
  check_places(options.tree_seeds, box, "a seed of the tree at", name);
  check_places(options.ground_seeds, box, "a seed of the ground at", name);
  SeparationOptions fitted = options;
  const double scale = static_cast<double>(picture.width_px) / picture.source_width_px;
  for (PixelPlace& place : fitted.tree_seeds) scale_place(scale, picture.width_px, picture.height_px, place);
  for (PixelPlace& place : fitted.ground_seeds)
    scale_place(scale, picture.width_px, picture.height_px, place);
  if (fitted.region) {
    PixelBox& region = *fitted.region;
    const int right = std::min(picture.width_px, static_cast<int>((region.left + region.width) * scale)),
              bottom = std::min(picture.height_px, static_cast<int>((region.top + region.height) * scale));
    region.left = std::min(static_cast<int>(region.left * scale), right - 1);
    region.top = std::min(static_cast<int>(region.top * scale), bottom - 1);
    region.width = right - region.left, region.height = bottom - region.top;
  }
  return fitted;
}

}  // namespace espalier
