#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/image/masks/distance_field.h>
#include <espalier/image/separation/hints.h>
#include <espalier/image/separation/labels.h>
#include <espalier/image/separation/mask_parts.h>

namespace espalier {

namespace {

using Code = std::uint32_t;  ///< a grey value, or red, green and blue as one number

constexpr std::size_t kMostLabels = 256, kMostListed = 12;
constexpr Code kSmallNumber = 64;  ///< labels that are small numbers are at most this
constexpr Code kVoid8 = 255, kVoid16 = 65535,
               kVoidColor = 0xe0e0c0;  ///< "not looked at", of Pascal VOC and others
constexpr double kLeastShare = 1e-4;   ///< of the picture, of a label that counts
constexpr double kSolidShare = 0.1;    ///< of a label's pixels, surrounded by their like
constexpr double kSolidLabels = 0.9;   ///< of the labels
constexpr std::uint8_t kLight = 230;   ///< drawings are on paper, labels on black

struct Label {
  std::size_t count = 0, solid = 0, on_border = 0;
};

struct LabelPicture {
  int width_px = 0, height_px = 0;
  bool is_grey = false;
  std::vector<Code> codes;
  std::map<Code, Label> labels;
  Code ground = 0;  ///< what most of the border has
  std::vector<std::array<std::uint8_t, 3>> palette;

  Code at(int x, int y) const { return codes[static_cast<std::size_t>(y) * width_px + x]; }
};

Code whole(float value, int bits) {
  return static_cast<Code>(std::lround(std::clamp(value, 0.0f, 1.0f) * (bits == 16 ? 65535.0f : 255.0f)));
}

Code code_of(const Rgba& rgba, bool is_grey, int bits) {
  if (is_grey) return whole(rgba[0], bits);
  return whole(rgba[0], 8) << 16 | whole(rgba[1], 8) << 8 | whole(rgba[2], 8);
}

/// Whether at least six of eight neighbours are of the same label.
bool is_solid(const LabelPicture& picture, int x, int y) {
  if (x == 0 || y == 0 || x + 1 == picture.width_px || y + 1 == picture.height_px) return false;
  int same = -1;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) same += picture.at(x + i, y + j) == picture.at(x, y);
  return same >= 6;
}

/// Nothing where the picture has too many values to be of labels, or none that are whole.
std::optional<LabelPicture> read_codes(const DecodedPicture& picture) {
  if (picture.bits == 0 || picture.width_px != picture.source_width_px) return std::nullopt;
  LabelPicture read{.width_px = picture.width_px,
                    .height_px = picture.height_px,
                    .is_grey = picture.is_grey,
                    .palette = picture.palette};
  read.codes.reserve(picture.pixels.size());
  for (const Rgba& rgba : picture.pixels) {
    read.codes.push_back(code_of(rgba, picture.is_grey, picture.bits));
    const bool is_run = read.codes.size() > 1 && read.codes.back() == read.codes[read.codes.size() - 2];
    if (is_run) continue;
    read.labels[read.codes.back()];
    if (read.labels.size() > kMostLabels) return std::nullopt;
  }
  for (int y = 0; y < read.height_px; ++y)
    for (int x = 0; x < read.width_px; ++x) {
      Label& label = read.labels[read.at(x, y)];
      label.count += 1;
      label.solid += is_solid(read, x, y);
    }
  visit_border(read.width_px, read.height_px, [&](int x, int y) { ++read.labels[read.at(x, y)].on_border; });
  read.ground = std::max_element(read.labels.begin(), read.labels.end(), [](const auto& a, const auto& b) {
                  return a.second.on_border < b.second.on_border;
                })->first;
  return read;
}

/// The label of what nobody looked at, such as a ring around things.
std::optional<Code> void_of(const LabelPicture& picture) {
  Code most_other = 0;
  for (const Code code : {kVoid8, kVoid16, kVoidColor}) {
    if (picture.is_grey != (code != kVoidColor) || !picture.labels.contains(code) || code == picture.ground)
      continue;
    if (code == kVoidColor) return code;
    for (const auto& [other, label] : picture.labels)
      if (other != code) most_other = std::max(most_other, other);
    if (most_other <= kSmallNumber || (code == kVoid16 && most_other < kVoid16 / 2)) return code;
  }
  return std::nullopt;
}

bool has_solid_labels(const LabelPicture& picture, std::optional<Code> ignored) {
  double all = 0, solid = 0;
  for (const auto& [code, label] : picture.labels) {
    if (code == ignored) continue;
    all += 1;
    solid += static_cast<double>(label.solid) >= kSolidShare * static_cast<double>(label.count);
  }
  return solid >= kSolidLabels * all;
}

/// Red, green and blue of Pascal VOC's colours are made of the bits of a number (their VOClabelcolormap).
bool is_of_color_map(Code code) { return (code & 0x3f3f3f) == 0 || code == kVoidColor; }

/// Two tones are a mask; a drawing has few colours too, but on paper.
bool holds_labels(const LabelPicture& picture, std::optional<Code> ignored) {
  const std::size_t count = picture.labels.size() - (ignored ? 1 : 0);
  if (count < 2 || !has_solid_labels(picture, ignored)) return false;
  if (picture.is_grey) {
    const Code most = [&] {
      Code largest = 0;
      for (const auto& [code, label] : picture.labels)
        if (code != ignored) largest = std::max(largest, code);
      return largest;
    }();
    return most <= kSmallNumber || (count > 2 && picture.ground == 0);
  }
  if (count < 3 && !ignored) return false;
  const bool is_map = std::all_of(picture.labels.begin(), picture.labels.end(),
                                  [](const auto& label) { return is_of_color_map(label.first); });
  const bool on_paper = (picture.ground >> 16) > kLight && (picture.ground >> 8 & 0xff) > kLight &&
                        (picture.ground & 0xff) > kLight;
  return !on_paper && (is_map || !picture.palette.empty());
}

/// The number that a palette gives a colour; nothing where it has none.
std::optional<std::size_t> number_of(const LabelPicture& picture, Code code) {
  const std::array<std::uint8_t, 3> color = {static_cast<std::uint8_t>(code >> 16),
                                             static_cast<std::uint8_t>(code >> 8),
                                             static_cast<std::uint8_t>(code)};
  const auto found = std::find(picture.palette.begin(), picture.palette.end(), color);
  if (found == picture.palette.end()) return std::nullopt;
  return static_cast<std::size_t>(found - picture.palette.begin());
}

std::string name_of_code(const LabelPicture& picture, Code code) {
  if (picture.is_grey) return fmt::format("{}", code);
  const auto number = number_of(picture, code);
  return number ? fmt::format("{} ({:06x})", *number, code) : fmt::format("{:06x}", code);
}

double share_of(const LabelPicture& picture, Code code) {
  return static_cast<double>(picture.labels.at(code).count) / static_cast<double>(picture.codes.size());
}

/// "1 (24 %), 2 (#008000) (7 %)", the largest first.
std::string list_of(const LabelPicture& picture, std::vector<Code> codes) {
  std::stable_sort(codes.begin(), codes.end(),
                   [&](Code a, Code b) { return share_of(picture, a) > share_of(picture, b); });
  std::vector<std::string> names;
  for (const Code code : codes) {
    if (names.size() == kMostListed) {
      names.push_back(fmt::format("and {} more", codes.size() - kMostListed));
      break;
    }
    names.push_back(fmt::format("{} ({:.1f} %)", name_of_code(picture, code), 100 * share_of(picture, code)));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<Code> all_codes(const LabelPicture& picture) {
  std::vector<Code> codes;
  for (const auto& [code, label] : picture.labels) codes.push_back(code);
  return codes;
}

std::optional<Code> code_of_color(const LabelPicture& picture, Code color) {
  if (!picture.is_grey) return color;
  return color >> 16 == (color & 0xff) ? std::optional<Code>(color & 0xff) : std::nullopt;
}

/// Of "7", "008000" or "#008000".
std::optional<Code> code_named(const LabelPicture& picture, std::string_view word) {
  if (const auto color = parse_hex_color(word)) return code_of_color(picture, *color);
  Code value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  if (picture.is_grey) return value;
  if (value >= picture.palette.size()) return std::nullopt;
  const auto& [red, green, blue] = picture.palette[value];
  const auto code = static_cast<Code>(red << 16 | green << 8 | blue);
  // Palettes are filled up with black: such a number is none of the picture's.
  return number_of(picture, code) == value ? std::optional(code) : std::nullopt;
}

std::vector<Code> codes_named(const LabelPicture& picture, const std::string& label,
                              const std::string& name) {
  std::vector<Code> codes;
  for (std::string_view rest = label; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    const auto code = code_named(picture, word);
    if (!code || !picture.labels.contains(*code))
      throw_input_error("{}: got label '{}', expected one that it holds: {}", name, word,
                        list_of(picture, all_codes(picture)));
    codes.push_back(*code);
  }
  return codes;
}

/// The one label that is neither the ground nor void.
std::vector<Code> only_label(const LabelPicture& picture, std::optional<Code> ignored,
                             const std::string& name) {
  std::vector<Code> codes;
  for (const Code code : all_codes(picture))
    if (code != picture.ground && code != ignored && share_of(picture, code) >= kLeastShare)
      codes.push_back(code);
  if (codes.empty())
    throw_input_error("{}: shows no tree: all of it has the label {}", name,
                      name_of_code(picture, picture.ground));
  if (codes.size() > 1)
    throw_input_error(
        "{}: holds several labels on {}, and cannot tell which is the tree: {}: choose by --label", name,
        name_of_code(picture, picture.ground), list_of(picture, codes));
  return codes;
}

Mask mask_of(const LabelPicture& picture, auto is_set) {
  Mask mask(picture.width_px, picture.height_px);
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) mask.set(x, y, is_set(picture.at(x, y)));
  return mask;
}

/// What nobody looked at belongs to what is nearest.
void divide_void(const LabelPicture& picture, Code ignored, Mask& tree) {
  const std::vector<float> to_tree = distances_to_set_px(tree),
                           to_others = distances_to_set_px(
                               mask_of(picture, [&](Code code) { return code != ignored; }));
  const Mask others = mask_of(picture, [&](Code code) { return code == ignored; });
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * picture.width_px + x;
      if (others.get(x, y) && to_tree[at] <= to_others[at]) tree.set(x, y);
    }
}

}  // namespace

std::optional<Separation> separate_by_label(const DecodedPicture& picture, const std::string& label,
                                            const std::string& name) {
  const std::optional<LabelPicture> read = read_codes(picture);
  if (!read) {
    if (label.empty()) return std::nullopt;
    throw_input_error(
        "{}: got label '{}', expected none: it holds no labels, but more than {} colours or such as "
        "are no whole numbers",
        name, label, kMostLabels);
  }
  const std::optional<Code> ignored = void_of(*read);
  if (label.empty() && !holds_labels(*read, ignored)) return std::nullopt;
  const std::vector<Code> codes =
      label.empty() ? only_label(*read, ignored, name) : codes_named(*read, label, name);
  Separation separation;
  separation.mask =
      mask_of(*read, [&](Code code) { return std::find(codes.begin(), codes.end(), code) != codes.end(); });
  const bool takes_void = ignored && std::find(codes.begin(), codes.end(), *ignored) != codes.end();
  if (ignored && !takes_void) divide_void(*read, *ignored, separation.mask);
  separation.how = fmt::format(
      "label {}{}", list_of(*read, codes),
      ignored && !takes_void ? fmt::format(", and what of {} is nearest to it", name_of_code(*read, *ignored))
                             : "");
  return separation;
}

}  // namespace espalier
