#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include <espalier/core/field_error.h>
#include <espalier/fitting/record/start_names.h>

namespace espalier {

namespace {

constexpr int kMostDraws = 1000;
constexpr std::string_view kRandom = "random";

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/// Of "random" or "random:K".
int parse_draws(const std::string& text) {
  if (text == kRandom) return 1;
  const std::string_view number = std::string_view(text).substr(kRandom.size() + 1);
  int draws = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), draws);
  if (error != std::errc() || end != number.data() + number.size() || draws < 1 || draws > kMostDraws)
    throw_field_error("start", "got '{}', expected random:K with K a whole number 1..{}", text, kMostDraws);
  return draws;
}

StartNames parse_bundled(const std::vector<std::string>& parts) {
  StartNames start{.source = StartSource::bundled};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].front() != '-' || parts[i].size() < 2)
      throw_field_error("start", "got '{}' after auto, expected -NAME, a preset to leave out", parts[i]);
    start.left_out.push_back(parts[i].substr(1));
  }
  return start;
}

}  // namespace

StartNames parse_start(const std::string& text) {
  const std::vector<std::string> parts = split_at_commas(text);
  if (parts.empty())
    throw_field_error("start", "got '{}', expected auto, defaults, random:K, or presets", text);
  if (parts.front() == "auto") return parse_bundled(parts);
  if (text == "defaults") return {.source = StartSource::defaults};
  if (text == kRandom || text.starts_with(std::string(kRandom) + ":"))
    return {.source = StartSource::random, .draws = parse_draws(text)};
  return {.source = StartSource::named, .presets = parts};
}

bool is_automatic(const StartNames& start) { return start.source == StartSource::bundled; }

std::string start_with(const std::string& text,
                       const std::function<std::string(const std::string&)>& change) {
  StartNames start = parse_start(text);
  if (start.source != StartSource::named) return text;
  for (std::string& name : start.presets) name = change(name);
  return fmt::format("{}", fmt::join(start.presets, ","));
}

std::string start_without(const std::string& text, const std::string& preset) {
  StartNames start = parse_start(text);
  if (start.source == StartSource::bundled) return fmt::format("{},-{}", text, preset);
  if (start.source != StartSource::named) return text;
  std::erase(start.presets, preset);
  return fmt::format("{}", fmt::join(start.presets, ","));
}

}  // namespace espalier
