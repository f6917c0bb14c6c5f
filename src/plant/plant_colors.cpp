#include <fmt/core.h>

#include <charconv>

#include <espalier/plant/plant_colors.h>

namespace espalier {

std::optional<PartColor> parse_color(const std::string& text) {
  constexpr std::size_t kLength = 7;
  std::uint32_t rgb = 0;
  if (text.size() != kLength || text[0] != '#') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + kLength, rgb, 16);
  if (error != std::errc() || end != text.data() + kLength) return std::nullopt;
  const auto channel = [rgb](int shift) { return static_cast<std::uint8_t>(rgb >> shift & 0xffu); };
  return PartColor{channel(16), channel(8), channel(0), true};
}

std::string color_text(PartColor color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

}  // namespace espalier
