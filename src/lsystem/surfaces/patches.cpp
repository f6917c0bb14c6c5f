#include <cctype>
#include <cmath>
#include <cstdlib>

#include <espalier/core/error.h>
#include <espalier/lsystem/surfaces/patches.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostPatches = 100;
constexpr double kMost = 1e6;

using Patch = std::array<Vec3, 16>;

/// Words with the lines they are in.
class Words {
 public:
  Words(const std::string& text, const std::string& label) : text_(text), label_(label) {}

  /// The next word, empty at the end.
  std::string next() {
    while (at_ < text_.size() && (is_space() || text_[at_] == '#')) skip();
    std::string word;
    while (at_ < text_.size() && !is_space() && text_[at_] != '#') word += text_[at_++];
    return word;
  }
  [[noreturn]] void fail(const std::string& got, std::string_view expected) const {
    throw_input_error("{}:{}: got {}, expected {}", label_, line_,
                      got.empty() ? "the end of the file" : fmt::format("'{}'", printable(got)), expected);
  }

 private:
  bool is_space() const { return std::isspace(static_cast<unsigned char>(text_[at_])) != 0; }
  void skip() {
    if (text_[at_] == '#')
      while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
    line_ += text_[at_++] == '\n';
  }
  static std::string printable(std::string word) {
    for (char& c : word)
      if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return word.substr(0, 40);
  }

  const std::string& text_;
  const std::string& label_;
  std::size_t at_ = 0;
  int line_ = 1;
};

float read_number(Words& words) {
  const std::string word = words.next();
  char* stop = nullptr;
  const double value = std::strtod(word.c_str(), &stop);
  if (word.empty() || *stop != 0 || !(std::fabs(value) <= kMost))
    words.fail(word, "48 numbers after 'patch', each within 10^6");
  return static_cast<float>(value);
}

/// Bernstein polynomials of degree 3.
Vec3 on_curve(const Vec3* p, float t) {
  const float s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

Vec3 on_patch(const Patch& patch, float u, float v) {
  Vec3 column[4];
  for (std::size_t row = 0; row < 4; ++row) column[row] = on_curve(patch.data() + 4 * row, u);
  return on_curve(column, v);
}

void append_triangles(const Patch& patch, std::vector<Triangle>& triangles) {
  const auto at = [&](int i, int j) {
    return on_patch(patch, static_cast<float>(i) / kPatchSteps, static_cast<float>(j) / kPatchSteps);
  };
  for (int j = 0; j < kPatchSteps; ++j)
    for (int i = 0; i < kPatchSteps; ++i) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

}  // namespace

std::vector<Triangle> read_patches(const std::string& text, const std::string& label) {
  std::vector<Triangle> triangles;
  Words words(text, label);
  std::size_t count = 0;
  for (std::string word = words.next(); !word.empty(); word = words.next()) {
    if (word != "patch" || ++count > kMostPatches) words.fail(word, "'patch', at most 100 of them");
    Patch patch;
    for (Vec3& point : patch) {
      point.x = read_number(words);
      point.y = read_number(words);
      point.z = read_number(words);
    }
    append_triangles(patch, triangles);
  }
  if (count == 0) words.fail("", "'patch'");
  return triangles;
}

}  // namespace espalier::lsystem
