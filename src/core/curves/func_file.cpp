#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include <espalier/core/curves/de_boor.h>
#include <espalier/core/curves/func_file.h>
#include <espalier/core/error.h>

namespace espalier {

/// For de_boor(), which finds it by its argument: not in the unnamed namespace.
static PlanePoint between(const PlanePoint& a, const PlanePoint& b, double share) {
  return {between(a.x, b.x, share), between(a.y, b.y, share)};
}

namespace {

constexpr std::size_t kLeastPoints = 4, kMostPoints = 1000;
constexpr double kAlmost = 1e-6;      // files have six decimals
constexpr std::size_t kPlaces = 401;  // at which functions are compared

double place_of(std::size_t i) { return static_cast<double>(i) / (kPlaces - 1); }

/// Lines with their numbers, empty ones left out.
class Lines {
 public:
  Lines(const std::string& text, const std::string& label) : stream_(text), label_(label) {}

  /// The words of the next line, none at the end of the text.
  std::vector<std::string> next() {
    std::string line;
    while (std::getline(stream_, line)) {
      ++number_;
      std::istringstream words(line);
      std::vector<std::string> found;
      for (std::string word; words >> word;) found.push_back(word);
      if (found.empty()) continue;
      text_ = line;
      return found;
    }
    text_.clear();
    return {};
  }
  [[noreturn]] void fail(std::string_view expected) const {
    throw_input_error("{}:{}: got {}, expected {}", label_, std::max(number_, 1),
                      text_.empty() ? "the end of the file" : fmt::format("'{}'", printable()), expected);
  }

 private:
  std::string printable() const {
    std::string shown = text_.substr(0, 60);
    for (char& c : shown)
      if (!std::isprint(static_cast<unsigned char>(c))) c = ' ';
    while (shown.ends_with(' ')) shown.pop_back();
    return shown;
  }

  std::istringstream stream_;
  const std::string& label_;
  int number_ = 0;
  std::string text_;
};

std::optional<double> finite_number(const std::string& word) {
  char* stop = nullptr;
  const double value = std::strtod(word.c_str(), &stop);
  if (*stop != 0 || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_version(const std::vector<std::string>& words) {
  return words == std::vector<std::string>{"fver", "1", "1"};
}

bool is_range(const std::vector<std::string>& words) {
  if (words.size() != 3 || words[0] != "range:") return false;
  const auto from = finite_number(words[1]), to = finite_number(words[2]);
  return from && to && std::fabs(*from) < kAlmost && std::fabs(*to - 1) < kAlmost;
}

/// The header up to the count of the points.
std::size_t read_count(Lines& lines) {
  const std::vector<std::string> first = lines.next();
  if (!is_version(first) && !is_range(first))
    lines.fail("'fver 1 1' or 'range: 0 1' of a function file of vlab");
  std::vector<std::string> words = lines.next();
  for (; !words.empty() && words[0] != "points:"; words = lines.next())
    if (!words[0].ends_with(':')) break;
  const auto count = words.size() == 2 && words[0] == "points:" ? finite_number(words[1]) : std::nullopt;
  if (!count || *count != std::floor(*count) || *count < kLeastPoints || *count > kMostPoints)
    lines.fail("'points:' and a whole number 4..1000");
  return static_cast<std::size_t>(*count);
}

void read_point(Lines& lines, std::vector<PlanePoint>& points) {
  const std::vector<std::string> words = lines.next();
  const auto number = [&](std::size_t i) {
    return i < words.size() ? finite_number(words[i]) : std::nullopt;
  };
  const auto x = number(0), y = number(1), times = words.size() == 3 ? number(2) : std::optional<double>(1);
  if (!x || !y || !times || words.size() > 3)
    lines.fail("a point: finite numbers x and y, and how often it counts");
  if (*times != std::floor(*times) || *times < 1 || *times > 10)
    lines.fail("a point that counts 1 to 10 times");
  const double least = points.empty() ? 0 : points.back().x;
  if (!(*x >= least - (points.empty() ? kAlmost : 0) && *x <= (points.empty() ? kAlmost : 1 + kAlmost)))
    lines.fail(points.empty() ? "a first point at x = 0"
                              : fmt::format("a point with x from {} (that of the one before) to 1", least));
  points.insert(points.end(), static_cast<std::size_t>(*times), {*x, *y});
}

/// The spline at its own parameter, from 0 to 1, with the knots 0,0,0,0,1,2,…,n,n,n,n.
PlanePoint on_spline(const std::vector<PlanePoint>& points, double parameter) {
  const auto pieces = static_cast<double>(points.size() - 3);
  const double u = parameter * pieces;
  const auto piece = static_cast<std::size_t>(std::min(std::floor(u), pieces - 1));
  const auto knot = [&](std::size_t i) { return std::clamp(static_cast<double>(i) - 3, 0.0, pieces); };
  return de_boor(std::span<const PlanePoint>(points), knot, 3, piece, u);
}

std::vector<double> sampled_values(const std::vector<PlanePoint>& points) {
  std::vector<double> values;
  values.reserve(kPlaces);
  for (std::size_t i = 0; i < kPlaces; ++i) values.push_back(func_value(points, place_of(i)));
  return values;
}

}  // namespace

std::vector<PlanePoint> read_func_points(const std::string& text, const std::string& label) {
  Lines lines(text, label);
  const std::size_t count = read_count(lines);
  std::vector<PlanePoint> points;
  for (std::size_t i = 0; i < count; ++i) read_point(lines, points);
  if (std::fabs(points.back().x - 1) > kAlmost) lines.fail("a last point at x = 1");
  if (!lines.next().empty()) lines.fail(fmt::format("the end of the file after {} points", count));
  return points;
}

double func_value(const std::vector<PlanePoint>& points, double x) {
  if (std::isnan(x)) return x;
  if (x <= 0) return points.front().y;
  if (x >= 1) return points.back().y;
  double lower = 0, upper = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (lower + upper) / 2;
    (on_spline(points, middle).x < x ? lower : upper) = middle;
  }
  return on_spline(points, (lower + upper) / 2).y;
}

ValueRange func_range(const std::vector<PlanePoint>& points) {
  const std::vector<double> values = sampled_values(points);
  const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
  return {*lower, *upper};
}

NearestCurve nearest_curve(const std::vector<PlanePoint>& points, ValueRange bounds) {
  const std::vector<double> values = sampled_values(points);
  NearestCurve nearest{fit_curve(values), 0};
  for (double& number : nearest.curve.numbers) number = std::clamp(number, bounds.lower, bounds.upper);
  for (std::size_t i = 0; i < values.size(); ++i)
    nearest.error = std::max(nearest.error, std::fabs(curve_value(nearest.curve, place_of(i)) - values[i]));
  return nearest;
}

}  // namespace espalier
