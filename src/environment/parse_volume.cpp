// Volumes from their command-line forms: a kind, a colon, and numbers in metres or a path; or an expression.
// One row of kKinds a kind: its name, how many numbers it takes, its form for messages, its maker.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/environment/volume_tree.h>

namespace espalier {

namespace {

using Numbers = std::span<const float>;

struct VolumeKind {
  std::string_view name, form;
  std::size_t number_count;
  std::unique_ptr<Volume> (*make)(Numbers);
};

constexpr std::array<VolumeKind, 3> kKinds{{
    {"box", "box:cx,cy,cz,sx,sy,sz", 6,
     [](Numbers n) {
       return make_box({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
     }},
    {"ball", "ball:cx,cy,cz,r", 4,
     [](Numbers n) {
       return make_ball({n[0], n[1], n[2]}, n[3]);
     }},
    {"cylinder", "cylinder:cx,cy,cz,r,h", 5,
     [](Numbers n) {
       return make_cylinder({n[0], n[1], n[2]}, n[3], n[4]);
     }},
}};

constexpr std::string_view kForms =
    "box:cx,cy,cz,sx,sy,sz, ball:cx,cy,cz,r, cylinder:cx,cy,cz,r,h, mesh:FILE or an expression such as "
    "union(ball(0,0,4, 2), box(0,0,1, 1,1,2))";

float parse_number(std::string_view number, const std::string& text, const VolumeKind& kind) {
  float value = 0;
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    throw_input_error("volume '{}': '{}' is not a finite number (expected {})", text, number, kind.form);
  return value;
}

std::vector<float> parse_numbers(std::string_view list, const std::string& text, const VolumeKind& kind) {
  std::vector<float> numbers;
  for (std::size_t start = 0; start <= list.size();) {
    const std::size_t comma = std::min(list.find(',', start), list.size());
    numbers.push_back(parse_number(list.substr(start, comma - start), text, kind));
    start = comma + 1;
  }
  if (numbers.size() != kind.number_count)
    throw_input_error("volume '{}': {} numbers, expected {} ({})", text, numbers.size(), kind.number_count,
                      kind.form);
  return numbers;
}

/// "union(ball(0,0,4,3), mesh(\"rock.obj\"))".
VolumePtr parse_expression(const std::string& text) {
  try {
    const VolumeTree tree = parse_volume_tree(
        text, [](std::string_view) { return false; }, [](const std::string& file) { return file; });
    const auto number = [](const VolumeTree::Number& n) {
      double value = 0;
      const char* end = n.text.data() + n.text.size();
      const auto [stop, error] = std::from_chars(n.text.data(), end, value);
      if (error != std::errc() || stop != end || !std::isfinite(value))
        throw VolumeError(n.offset, fmt::format("'{}' is not a finite number", n.text));
      return value;
    };
    return make_volume(tree, number, [](const std::string&) { return nullptr; });
  } catch (const VolumeError& error) {
    throw_input_error("volume '{}', column {}: {}", text, error.offset + 1, error.what());
  }
}

}  // namespace

std::unique_ptr<Volume> parse_volume(const std::string& text) {
  const std::size_t bracket = text.find('(');
  if (bracket != std::string::npos && bracket < text.find(':'))
    return make_moved({0, 0, 0}, parse_expression(text));
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw_input_error("volume '{}': no colon (expected {})", text, kForms);
  const std::string name = text.substr(0, colon), rest = text.substr(colon + 1);
  if (name == "mesh") return make_mesh_volume(rest);
  const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), [&](auto& k) { return k.name == name; });
  if (kind == kKinds.end())
    throw_input_error("volume '{}': unknown kind '{}' (expected {})", text, name, kForms);
  return kind->make(parse_numbers(rest, text, *kind));
}

}  // namespace espalier
