#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include <espalier/environment/crown_envelope.h>
#include <espalier/environment/picture_envelope.h>
#include <espalier/environment/volume_tree.h>

namespace espalier {

namespace {

using Numbers = std::vector<float>;
using Parts = std::vector<VolumePtr>;
constexpr std::size_t kMany = 1000;
constexpr int kMaxDepth = 100;
constexpr double kMostParts = 100'000;  // of a volume of volumes that are volumes of volumes
constexpr int kDeepest = 500;

struct Kind {
  std::string_view name, form;
  bool has_file;
  std::size_t numbers, min_parts, max_parts;
  VolumePtr (*make)(const Numbers&, Parts&&);
  std::span<const std::string_view> (*names)() =
      nullptr;  ///< of numbers that are given by name, in any order
};

constexpr std::array<Kind, 16> kKinds{{
    {"box", "box(x,y,z, sx,sy,sz)", false, 6, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_box({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
     }},
    {"ball", "ball(x,y,z, r)", false, 4, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_ball({n[0], n[1], n[2]}, n[3]);
     }},
    {"cylinder", "cylinder(x,y,z, r,h)", false, 5, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_cylinder({n[0], n[1], n[2]}, n[3], n[4]);
     }},
    {"ellipsoid", "ellipsoid(x,y,z, rx,ry,rz)", false, 6, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_ellipsoid({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
     }},
    {"line", "line(x,y,z, x,y,z, r,r)", false, 8, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_line({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], n[7]);
     }},
    {"spiral", "spiral(x,y,z, height,turns, r,tube, shrink)", false, 8, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr {
       return make_spiral({{n[0], n[1], n[2]}, n[3], n[4], n[5], n[6], n[7]});
     }},
    {"crown", "crown(top = z, bottom = z, radius = r, …)", false, 0, 0, 0,
     [](const Numbers& n, Parts&&) -> VolumePtr { return make_crown(n); }, crown_arguments},
    {"mesh", "mesh(\"file.obj\")", true, 0, 0, 0,
     [](const Numbers&, Parts&& parts) -> VolumePtr { return parts[0]; }},
    {"picture", "picture(\"file.png\", height)", true, 1, 0, 0,
     [](const Numbers& n, Parts&& parts) -> VolumePtr { return make_scaled(n[0], parts[0]); }},
    {"union", "union(volume, …)", false, 0, 1, kMany,
     [](const Numbers&, Parts&& parts) -> VolumePtr { return make_union(std::move(parts)); }},
    {"intersection", "intersection(volume, …)", false, 0, 1, kMany,
     [](const Numbers&, Parts&& parts) -> VolumePtr { return make_intersection(std::move(parts)); }},
    {"difference", "difference(volume, taken_away, …)", false, 0, 2, kMany,
     [](const Numbers&, Parts&& parts) -> VolumePtr { return make_difference(std::move(parts)); }},
    {"blend", "blend(width, volume, volume, …)", false, 1, 1, kMany,
     [](const Numbers& n, Parts&& parts) -> VolumePtr { return make_blend(n[0], std::move(parts)); }},
    {"moved", "moved(x,y,z, volume)", false, 3, 1, 1,
     [](const Numbers& n, Parts&& parts) -> VolumePtr {
       return make_moved({n[0], n[1], n[2]}, parts[0]);
     }},
    {"scaled", "scaled(factor, volume)", false, 1, 1, 1,
     [](const Numbers& n, Parts&& parts) -> VolumePtr { return make_scaled(n[0], parts[0]); }},
    {"turned", "turned(degrees, volume)", false, 1, 1, 1,
     [](const Numbers& n, Parts&& parts) -> VolumePtr { return make_turned(n[0], parts[0]); }},
}};

const Kind* find_kind(std::string_view name) {
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(), [&](auto& k) { return k.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

std::string all_kinds() {
  std::string text;
  for (const Kind& kind : kKinds)
    fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : ", ", kind.name);
  return text;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

class Reader {
 public:
  Reader(std::string_view text, const IsName& is_name, const FindFile& find_file)
      : text_(text), is_name_(is_name), find_file_(find_file) {}

  VolumeTree whole() {
    VolumeTree tree = volume();
    if (skip_space() < text_.size()) fail("the end of the volume");
    return tree;
  }

 private:
  std::size_t skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_;
  }
  bool take(char c) {
    if (skip_space() >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    const std::string found = at_ < text_.size() ? fmt::format("'{}'", text_[at_]) : "the end";
    throw VolumeError(at_, fmt::format("got {}, expected {}", found, expected));
  }

  VolumeTree volume() {
    if (++depth_ > kMaxDepth) fail("volumes in fewer volumes");
    VolumeTree tree;
    tree.offset = skip_space();
    tree.kind = word();
    if (tree.kind.empty()) fail("a volume");
    const Kind* kind = find_kind(tree.kind);
    const bool has_arguments = take('(');
    if (!has_arguments && is_name_(tree.kind)) return --depth_, tree;
    if (!kind)
      throw VolumeError(tree.offset,
                        fmt::format("got the unknown volume '{}', expected one declared before, or one of {}",
                                    tree.kind, all_kinds()));
    if (!has_arguments) fail(fmt::format("'(': {}", kind->form));
    arguments(*kind, tree);
    --depth_;
    return tree;
  }

  void arguments(const Kind& kind, VolumeTree& tree) {
    if (kind.has_file) read_file(kind, tree);
    if (kind.names != nullptr) named_numbers(kind, tree);
    for (std::size_t i = 0; i < kind.numbers; ++i) {
      if (i > 0 || kind.has_file) comma(kind);
      tree.numbers.push_back(number(kind));
    }
    for (bool first = kind.numbers == 0; tree.parts.size() < kind.max_parts; first = false) {
      if (!first && tree.parts.size() >= kind.min_parts &&
          !(skip_space() < text_.size() && text_[at_] == ','))
        break;
      if (!first) comma(kind);
      tree.parts.push_back(volume());
    }
    if (!take(')')) fail(fmt::format("')': {}", kind.form));
  }

  /// "top = 9, radius = 3", each once.
  void named_numbers(const Kind& kind, VolumeTree& tree) {
    do {
      const std::size_t begin = skip_space();
      const std::string name = word();
      const auto names = kind.names();
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        throw VolumeError(begin, fmt::format("got '{}', expected one of {}", name, fmt::join(names, ", ")));
      const auto slot = static_cast<std::size_t>(found - names.begin());
      if (std::find(tree.slots.begin(), tree.slots.end(), slot) != tree.slots.end())
        throw VolumeError(begin, fmt::format("got a second '{}', expected one", name));
      if (!take('=')) fail(fmt::format("'=' after '{}': {}", name, kind.form));
      tree.slots.push_back(slot);
      tree.numbers.push_back(name == "profile" ? profile() : number(kind));
    } while (take(','));
  }

  /// The number that stands for the name of a crown's profile.
  VolumeTree::Number profile() {
    const std::size_t begin = skip_space();
    const std::string name = word();
    const auto profiles = crown_profiles();
    const auto found = std::find(profiles.begin(), profiles.end(), name);
    if (found == profiles.end())
      throw VolumeError(begin,
                        fmt::format("got profile '{}', expected one of {}", name, fmt::join(profiles, ", ")));
    return {std::to_string(found - profiles.begin()), begin};
  }

  std::string word() {
    std::string word;
    while (at_ < text_.size() && is_word(text_[at_])) word += text_[at_++];
    return word;
  }

  void comma(const Kind& kind) {
    if (!take(',')) fail(fmt::format("',': {}", kind.form));
  }

  /// Up to the next comma or bracket outside of brackets; empty ones are errors.
  VolumeTree::Number number(const Kind& kind) {
    VolumeTree::Number number;
    number.offset = skip_space();
    int depth = 0;
    while (at_ < text_.size() && (depth > 0 || (text_[at_] != ',' && text_[at_] != ')'))) {
      depth += text_[at_] == '(' ? 1 : text_[at_] == ')' ? -1 : 0;
      number.text += text_[at_++];
    }
    while (!number.text.empty() && std::isspace(static_cast<unsigned char>(number.text.back())))
      number.text.pop_back();
    if (number.text.empty()) fail(fmt::format("a number: {}", kind.form));
    return number;
  }

  void read_file(const Kind& kind, VolumeTree& tree) {
    if (!take('"')) fail(fmt::format("'\"': {}", kind.form));
    const std::size_t begin = at_, end = text_.find('"', at_);
    if (end == text_.npos) fail("'\"' after the file's name");
    tree.file = text_.substr(begin, end - begin);
    at_ = end + 1;
    try {
      const std::filesystem::path path = find_file_(tree.file);
      tree.from_file = kind.name == "mesh" ? make_mesh_volume(path) : make_picture_volume(path);
    } catch (const InputError& error) {
      throw VolumeError(begin, error.what());
    }
  }

  std::string_view text_;
  const IsName& is_name_;
  const FindFile& find_file_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

VolumeTree parse_volume_tree(std::string_view text, const IsName& is_name, const FindFile& find_file) {
  return Reader(text, is_name, find_file).whole();
}

namespace {

/// NaN for those that are not given.
Numbers named_numbers(const VolumeTree& tree, std::size_t slots, const NumberOf& number) {
  Numbers numbers(slots, NAN);
  for (std::size_t i = 0; i < tree.slots.size(); ++i) {
    const double value = number(tree.numbers[i]);
    if (!std::isfinite(value))
      throw VolumeError(tree.numbers[i].offset, fmt::format("got {}, expected a finite number", value));
    numbers[tree.slots[i]] = static_cast<float>(value);
  }
  return numbers;
}

/// Names stand for whole volumes, so that few lines make many.
VolumePtr checked(VolumePtr volume) {
  const VolumeSize size = volume->size();
  if (size.parts > kMostParts)
    throw_input_error("got a volume of {:.3g} volumes, expected at most {}", size.parts, kMostParts);
  if (size.depth > kDeepest)
    throw_input_error("got volumes in {} volumes, expected in at most {}", size.depth, kDeepest);
  return volume;
}

}  // namespace

VolumePtr make_volume(const VolumeTree& tree, const NumberOf& number, const NamedVolume& named) {
  const Kind* kind = find_kind(tree.kind);
  if (!kind || (tree.numbers.empty() && tree.parts.empty() && !tree.from_file)) return named(tree.kind);
  Numbers numbers = kind->names ? named_numbers(tree, kind->names().size(), number) : Numbers();
  if (!kind->names)
    for (const VolumeTree::Number& n : tree.numbers) numbers.push_back(static_cast<float>(number(n)));
  Parts parts;
  if (tree.from_file) parts.push_back(tree.from_file);
  for (const VolumeTree& part : tree.parts) parts.push_back(make_volume(part, number, named));
  try {
    return checked(kind->make(numbers, std::move(parts)));
  } catch (const InputError& error) {
    throw VolumeError(tree.offset, error.what());
  }
}

}  // namespace espalier
