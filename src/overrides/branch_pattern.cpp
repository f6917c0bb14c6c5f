#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include <espalier/core/error.h>
#include <espalier/overrides/branch_pattern.h>

namespace espalier {

namespace {

constexpr std::string_view kRange = "..";

/// A part of a pattern being read, and what messages say of it.
struct PartText {
  std::string_view part, pattern;
  const std::string& where;

  [[noreturn]] void fail(const char* expected) const {
    throw_input_error("{}: got '{}', expected {}", where, pattern, expected);
  }
  [[noreturn]] void fail_as_empty(const char* expected) const {
    throw_input_error("{}: got '{}', whose range '{}' holds nothing, expected {}", where, pattern, part,
                      expected);
  }
};

constexpr const char* kForms =
    "a path of branches like '0/12/3' or '0/split4.1/7', or one of ranges like '0/3..7', '0/@0.25..0.5' or "
    "'0/*'";

std::optional<float> parse_position(std::string_view text) {
  float number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !(number >= 0 && number <= 1))
    return std::nullopt;
  return number + 0.f;  // never -0
}

PatternPart parse_positions(const PartText& text, bool is_trunk) {
  const std::string_view range = text.part.substr(1);
  const std::size_t dots = range.find(kRange);
  if (dots == std::string_view::npos) text.fail("a range of positions like '@0.25..0.5'");
  const auto lower = parse_position(range.substr(0, dots)),
             upper = parse_position(range.substr(dots + kRange.size()));
  if (!lower || !upper) text.fail("a range of positions from 0 to 1 like '@0.25..0.5'");
  if (is_trunk) text.fail("positions of branches that have a parent");
  if (!(*lower < *upper)) text.fail_as_empty("a lower end below the upper one");
  return {.kind = PatternPart::Kind::positions, .lower = *lower, .upper = *upper};
}

PatternPart parse_indices(const PartText& text, std::size_t dots) {
  const auto first = parse_path_part(text.part.substr(0, dots)),
             last = parse_path_part(text.part.substr(dots + kRange.size()));
  if (!first || !last || *first >= kFirstSplit || *last >= kFirstSplit) text.fail(kForms);
  if (*first > *last) text.fail_as_empty("a first child no later than the last");
  return {.kind = PatternPart::Kind::indices, .first = *first, .last = *last};
}

PatternPart parse_pattern_part(const PartText& text, bool is_trunk) {
  if (text.part == "*") return {.kind = PatternPart::Kind::all};
  if (text.part.starts_with('@')) return parse_positions(text, is_trunk);
  if (const std::size_t dots = text.part.find(kRange); dots != std::string_view::npos)
    return parse_indices(text, dots);
  const auto one = parse_path_part(text.part);
  if (!one) text.fail(kForms);
  return {.first = *one, .last = *one};
}

std::string text_of(const PatternPart& part) {
  switch (part.kind) {
    case PatternPart::Kind::all:
      return "*";
    case PatternPart::Kind::positions:
      return fmt::format("@{}..{}", part.lower, part.upper);
    case PatternPart::Kind::indices:
      return fmt::format("{}..{}", part.first, part.last);
    case PatternPart::Kind::one:
      return to_string(BranchPath{part.first});
  }
  throw InternalError("unknown part of a path");
}

}  // namespace

bool PatternPart::means(std::uint32_t index, float position) const {
  if (kind == Kind::one) return index == first;
  if (index >= kFirstSplit) return false;
  if (kind == Kind::indices) return index >= first && index <= last;
  return kind == Kind::all || (position >= lower && (position < upper || upper == 1));
}

std::string to_string(const BranchPattern& pattern) {
  std::string text;
  for (const PatternPart& part : pattern) {
    if (!text.empty()) text += '/';
    text += text_of(part);
  }
  return text;
}

BranchPattern parse_branch_pattern(std::string_view text, const std::string& where) {
  BranchPattern pattern;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t end = std::min(text.find('/', first), text.size());
    pattern.push_back(parse_pattern_part({text.substr(first, end - first), text, where}, pattern.empty()));
    first = end + 1;
  }
  return pattern;
}

std::optional<BranchPath> as_path(const BranchPattern& pattern) {
  BranchPath path;
  path.reserve(pattern.size());
  for (const PatternPart& part : pattern) {
    if (part.kind != PatternPart::Kind::one) return std::nullopt;
    path.push_back(part.first);
  }
  return path;
}

BranchPattern as_pattern(const BranchPath& path) {
  BranchPattern pattern;
  pattern.reserve(path.size());
  for (const std::uint32_t part : path) pattern.push_back({.first = part, .last = part});
  return pattern;
}

bool is_weaker(const BranchPattern& a, const BranchPattern& b) {
  return std::lexicographical_compare(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const PatternPart& one, const PatternPart& other) { return one.kind < other.kind; });
}

int level_of(const BranchPattern& pattern) {
  const auto is_child = [](const PatternPart& part) { return part.first < kFirstSplit; };
  return static_cast<int>(std::count_if(pattern.begin(), pattern.end(), is_child)) - 1;
}

}  // namespace espalier
