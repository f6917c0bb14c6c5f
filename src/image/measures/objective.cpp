#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/core/near_name.h>
#include <espalier/core/parameter_table.h>
#include <espalier/image/measures/compare.h>
#include <espalier/image/measures/objective.h>

namespace espalier {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

double parse_weight(std::string_view text, std::string_view objective) {
  double weight = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), weight);
  if (error != std::errc() || end != text.data() + text.size() || !(weight > 0) || !std::isfinite(weight))
    throw_input_error("objective '{}': the weight '{}' is not a positive number", objective, text);
  return weight;
}

bool is_called(const Metric& metric, std::string_view name) {
  return metric.name == name || (metric.also_called && metric.also_called == name);
}

const Metric* find_metric(std::string_view name) {
  for (const Metric& metric : kMetrics)
    if (is_called(metric, name)) return &metric;
  return nullptr;
}

void check_name(const std::string& name, std::string_view objective) {
  const Metric* metric = find_metric(name);
  const std::vector<std::string> known = objective_names();
  if (metric && metric->in_objective) return;
  if (metric)
    throw_input_error("objective '{}': got '{}', which is only reported, expected one of {}", objective, name,
                      fmt::join(known, ", "));
  throw_input_error("objective '{}': got '{}', expected a measure, the closest is '{}'", objective, name,
                    closest_name(name, known));
}

/// "name" or "weight*name"
ObjectiveTerm parse_term(std::string_view text, std::string_view objective) {
  const auto star = text.find('*');
  ObjectiveTerm term;
  if (star != std::string_view::npos) term.weight = parse_weight(trimmed(text.substr(0, star)), objective);
  term.name = trimmed(star == std::string_view::npos ? text : text.substr(star + 1));
  check_name(term.name, objective);
  return term;
}

/// Where the next term ends: a '+' that is not the sign of an exponent, as in 1e+2*iou.
std::size_t end_of_term(std::string_view text, std::size_t first) {
  for (std::size_t i = first; i < text.size(); ++i) {
    const bool exponent =
        i > first + 1 && text[i - 1] == 'e' && (std::isdigit(text[i - 2]) || text[i - 2] == '.');
    if (text[i] == '+' && !exponent) return i;
  }
  return text.size();
}

}  // namespace

std::vector<std::string> objective_names() {
  std::vector<std::string> names;
  for (const Metric& metric : kMetrics) {
    if (!metric.in_objective) continue;
    names.emplace_back(metric.name);
    if (metric.also_called) names.emplace_back(metric.also_called);
  }
  return names;
}

MaskObjective parse_objective(std::string_view text) {
  MaskObjective objective;
  double sum = 0;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = end_of_term(text, first);
    objective.terms.push_back(parse_term(trimmed(text.substr(first, end - first)), text));
    sum += objective.terms.back().weight;
    first = end + 1;
  }
  if (!std::isfinite(sum)) throw_input_error("objective '{}': the weights sum to infinity", text);
  if (std::fabs(sum - 1) < 1e-12) return objective;  // so that to_string's text gives the same bits back
  for (ObjectiveTerm& term : objective.terms) term.weight /= sum;
  return objective;
}

std::string to_string(const MaskObjective& objective) {
  if (objective.terms.size() == 1) return objective.terms[0].name;
  std::string text;
  for (const ObjectiveTerm& term : objective.terms)
    text += fmt::format("{}{}*{}", text.empty() ? "" : "+", term.weight, term.name);
  return text;
}

double dissimilarity(const MaskObjective& objective, const Mask& candidate, const PreparedTarget& target) {
  const Comparison pair = make_comparison(candidate, target);
  double sum = 0;
  for (const ObjectiveTerm& term : objective.terms) {
    const Metric* metric = find_metric(term.name);
    if (!metric) throw InternalError("no objective is named " + term.name);
    sum += term.weight * dissimilarity_of(*metric, metric->evaluate(pair));
  }
  return std::clamp(sum, 0.0, 1.0);  // weights that sum to 1 + 1e-16 must not leave [0, 1]
}

double dissimilarity(const MaskObjective& objective, const Mask& candidate, const Mask& target) {
  return dissimilarity(objective, candidate, PreparedTarget(target));
}

}  // namespace espalier
