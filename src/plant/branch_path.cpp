#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include <espalier/plant/branch_path.h>

namespace espalier {

namespace {

constexpr std::string_view kSplit = "split";

std::string part_to_string(std::uint32_t part) {
  if (part < kFirstSplit) return fmt::format("{}", part);
  const std::uint32_t split = part - kFirstSplit;
  return fmt::format("{}{}.{}", kSplit, split / kStemsPerSplit, split % kStemsPerSplit);
}

std::optional<std::uint32_t> parse_number(std::string_view text, std::uint32_t most) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number > most) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::uint32_t> parse_path_part(std::string_view text) {
  if (!text.starts_with(kSplit)) return parse_number(text, kFirstSplit - 1);
  const std::string_view place = text.substr(kSplit.size());
  const std::size_t dot = place.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const auto at = parse_number(place.substr(0, dot), 1000);
  const auto number = parse_number(place.substr(dot + 1), kStemsPerSplit - 1);
  if (!at || !number) return std::nullopt;
  return kFirstSplit + kStemsPerSplit * *at + *number;
}

std::string to_string(const BranchPath& path) {
  std::string text;
  for (const std::uint32_t part : path) {
    if (!text.empty()) text += '/';
    text += part_to_string(part);
  }
  return text;
}

BranchPath path_of(const Plant& plant, std::size_t stem) {
  BranchPath path;
  for (auto at = static_cast<std::int32_t>(stem); at >= 0;
       at = plant.stems.origin[static_cast<std::size_t>(at)])
    path.push_back(plant.stems.child_index[static_cast<std::size_t>(at)]);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace espalier
