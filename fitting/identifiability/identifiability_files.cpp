#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <espalier/core/files.h>
#include <espalier/fitting/identifiability/identifiability_files.h>

namespace espalier {

namespace {

std::string cell(const std::optional<double>& number) { return number ? fmt::format("{:.6g}", *number) : ""; }

/// Rows as the chart shows them: by identifiability, then by what the cheaper step costs, then by spread.
std::vector<std::size_t> best_identified_first(const IdentifiabilityReport& report) {
  std::vector<std::size_t> order(report.parameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto before = [&](std::size_t i, std::size_t j) {
    const ParameterIdentifiability &a = report.parameters[i], &b = report.parameters[j];
    if (a.identifiability != b.identifiability) return a.identifiability < b.identifiability;
    if (a.least_rise() != b.least_rise()) return a.least_rise() > b.least_rise();
    return a.spread < b.spread;
  };
  std::stable_sort(order.begin(), order.end(), before);
  return order;
}

std::vector<std::string> names_of(const IdentifiabilityReport& report, Identifiability identifiability) {
  std::vector<std::string> names;
  for (const std::size_t i : best_identified_first(report))
    if (report.parameters[i].identifiability == identifiability)
      names.push_back(report.parameters[i].parameter.name);
  return names;
}

/// The first few, and how many more.
std::string some(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i)
    text.append(i == 0 ? "" : ", ").append(names[i]);
  return names.size() > kShown ? text.append(", …") : text;
}

// The chart.

constexpr float kRowPx = 20, kTopPx = 74, kBottomPx = 46, kGapPx = 28, kRangePx = 420, kRisePx = 220;
constexpr float kRightPx = 130;
constexpr Rgb kTrack{225, 225, 225}, kSpread{158, 202, 225}, kDot{0, 114, 178}, kBest{20, 20, 20},
    kRise{213, 94, 0}, kLimit{150, 150, 150};

float widest_name_px(const IdentifiabilityReport& report) {
  float widest = 0;
  for (const ParameterIdentifiability& row : report.parameters)
    widest = std::max(widest, text_width_px(row.parameter.name));
  return widest;
}

struct Columns {
  float range_px, rise_px, words_px, right_px;  ///< left ends of the columns; end of all
  double most_rise;                             ///< at the right end of its column

  float in_range(double unit) const { return range_px + kRangePx * static_cast<float>(unit); }
  /// The length is the square root of a rise, which grows about as the square of a step.
  float in_rise(double rise) const {
    return rise_px + kRisePx * static_cast<float>(std::sqrt(std::clamp(rise / most_rise, 0.0, 1.0)));
  }
};

Columns columns_of(const IdentifiabilityReport& report) {
  double most = report.tolerance;
  for (const ParameterIdentifiability& row : report.parameters)
    most = std::max({most, row.rise_below.value_or(0), row.rise_above.value_or(0)});
  const float range = 20 + widest_name_px(report) + 14, rise = range + kRangePx + kGapPx;
  const float words = rise + kRisePx + kGapPx;
  return {range, rise, words, words + kRightPx, std::max(most, 1e-9)};
}

void add_line(ChartPoint from, ChartPoint to, Rgb color, float width_px, ChartLayout& layout) {
  layout.strokes.push_back({{from, to}, color, width_px});
}

void add_range(const Columns& columns, const SolutionArchive& archive, std::size_t index, float y,
               ChartLayout& layout) {
  add_line({columns.in_range(0), y}, {columns.in_range(1), y}, kTrack, 4, layout);
  float least = columns.in_range(1), most = columns.in_range(0);
  for (const ArchivedSolution& solution : archive.solutions()) {
    least = std::min(least, columns.in_range(solution.unit[index]));
    most = std::max(most, columns.in_range(solution.unit[index]));
  }
  if (most > least) add_line({least, y}, {most, y}, kSpread, 8, layout);
  for (const ArchivedSolution& solution : archive.solutions())
    layout.strokes.push_back({{{columns.in_range(solution.unit[index]), y}}, kDot, 5});
  layout.strokes.push_back({{{columns.in_range(archive.solutions().front().unit[index]), y}}, kBest, 10});
}

/// A step up above the line, one down below it.
void add_rises(const Columns& columns, const ParameterIdentifiability& row, float y, ChartLayout& layout) {
  const auto add = [&](const std::optional<double>& rise, float offset_px) {
    if (rise && *rise > 0)
      add_line({columns.rise_px, y + offset_px}, {columns.in_rise(*rise), y + offset_px}, kRise, 5, layout);
  };
  add(row.rise_above, -3.5f), add(row.rise_below, 3.5f);
}

void add_heads(const IdentifiabilityReport& report, const Columns& columns, float bottom_px,
               ChartLayout& layout) {
  layout.labels.push_back({{20, 18},
                           "Which parameters the picture determines (black: the best, blue: others as good)",
                           TextAnchor::start});
  layout.labels.push_back({{columns.in_range(0.5), 50}, "range that was searched"});
  layout.labels.push_back({{columns.rise_px, 50},
                           fmt::format("cost of a step of {:g} %", 100 * kSensitivityStep),
                           TextAnchor::start});
  const float limit = columns.in_rise(report.tolerance);
  add_line({limit, kTopPx - 8}, {limit, bottom_px}, kLimit, 1, layout);
  layout.labels.push_back({{columns.rise_px, bottom_px + 14},
                           fmt::format("line: {:.3f}, still as good", report.tolerance),
                           TextAnchor::start});
  layout.labels.push_back({{columns.in_range(0), bottom_px + 14}, "lower bound", TextAnchor::start});
  layout.labels.push_back({{columns.in_range(1), bottom_px + 14}, "upper", TextAnchor::end});
}

}  // namespace

std::string identifiability_to_csv(const IdentifiabilityReport& report) {
  std::string csv =
      "parameter,lower,upper,best,archive_lowest,archive_highest,spread,rise_of_step_down,rise_of_step_up,"
      "identifiability\n";
  for (const ParameterIdentifiability& row : report.parameters)
    csv +=
        fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4f},{},{},{}\n", row.parameter.name,
                    row.parameter.lower, row.parameter.upper, row.best, row.lowest, row.highest, row.spread,
                    cell(row.rise_below), cell(row.rise_above), identifiability_name(row.identifiability));
  return csv;
}

IdentifiabilityChart draw_identifiability(const IdentifiabilityReport& report,
                                          const SolutionArchive& archive) {
  const Columns columns = columns_of(report);
  const float bottom_px = kTopPx + kRowPx * static_cast<float>(report.parameters.size());
  IdentifiabilityChart chart{{}, static_cast<int>(columns.right_px), static_cast<int>(bottom_px + kBottomPx)};
  add_heads(report, columns, bottom_px, chart.layout);
  float y = kTopPx + kRowPx / 2;
  for (const std::size_t i : best_identified_first(report)) {
    const ParameterIdentifiability& row = report.parameters[i];
    chart.layout.labels.push_back({{columns.range_px - 14, y}, row.parameter.name, TextAnchor::end});
    add_range(columns, archive, i, y, chart.layout);
    add_rises(columns, row, y, chart.layout);
    chart.layout.labels.push_back(
        {{columns.words_px, y}, identifiability_name(row.identifiability), TextAnchor::start});
    y += kRowPx;
  }
  return chart;
}

void write_identifiability(const std::filesystem::path& directory, const IdentifiabilityReport& report,
                           const SolutionArchive& archive) {
  if (report.parameters.empty()) return;
  const IdentifiabilityChart chart = draw_identifiability(report, archive);
  write_file_atomically(directory / "parameters.csv", identifiability_to_csv(report));
  write_file_atomically(directory / "parameters.svg",
                        layout_to_svg(chart.layout, chart.width_px, chart.height_px));
  write_png(directory / "parameters.png", layout_to_picture(chart.layout, chart.width_px, chart.height_px));
}

std::string identifiability_in_words(const IdentifiabilityReport& report, const SolutionArchive& archive) {
  if (report.parameters.empty()) return "";
  const auto determined = names_of(report, Identifiability::determined),
             open = names_of(report, Identifiability::open),
             idle = names_of(report, Identifiability::no_effect);
  std::string text =
      fmt::format("the picture determines {} of {} parameters", determined.size(), report.parameters.size());
  if (!determined.empty()) text += fmt::format(" ({})", some(determined));
  text += fmt::format(" and leaves {} open", open.size() + idle.size());
  if (!open.empty()) text += fmt::format(" ({})", some({open.rbegin(), open.rend()}));
  return text + fmt::format("; {} different solutions within {:.3f} of the best: archive/, parameters.svg",
                            archive.solutions().size(), report.tolerance);
}

}  // namespace espalier
