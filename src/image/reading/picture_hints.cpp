#include <charconv>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/image/reading/picture_hints.h>
#include <espalier/image/separation/hints.h>

namespace espalier {

namespace {

/// The marks that stay, of which strips are the separation's.
struct KeptMarks {
  bool strips = false, lines = false, captions = false, figures = false;
};

KeptMarks parse_kept(const std::string& text) {
  KeptMarks kept;
  if (text == "none") return kept;
  if (text == "all") return {true, true, true, true};
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    bool* const mark = word == "strips"     ? &kept.strips
                       : word == "lines"    ? &kept.lines
                       : word == "captions" ? &kept.captions
                       : word == "figures"  ? &kept.figures
                                            : nullptr;
    if (!mark)
      throw_input_error("got '{}', expected none, all, or some of strips, lines, captions, figures", text);
    *mark = true;
  }
  return kept;
}

}  // namespace

SeparationOptions with_hints(SeparationOptions options, const PictureHints& hints) {
  options.threshold = static_cast<float>(hints.threshold);
  if (!hints.ground_color.empty()) options.ground_color = parse_hinted_color(hints.ground_color);
  if (!hints.tree_color.empty()) options.tree_color = parse_hinted_color(hints.tree_color);
  if (!hints.region.empty()) options.region = parse_region(hints.region);
  options.tree_seeds = parse_places(hints.tree_seeds);
  options.ground_seeds = parse_places(hints.ground_seeds);
  options.label = hints.label;
  options.keep_strips = parse_kept(hints.keep_marks).strips;
  return options;
}

MarkChoice marks_to_leave_out(const std::string& keep_marks) {
  const KeptMarks kept = parse_kept(keep_marks);
  return {.lines = !kept.lines, .captions = !kept.captions, .figures = !kept.figures};
}

double parse_scale_bar(const std::string& text) {
  if (text.empty()) return 0;
  const auto equals = text.find('=');
  double px = 0, metres = 0;
  const auto parse = [](std::string_view word, double& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && std::isfinite(value) && value > 0;
  };
  const std::string_view words = text;
  if (equals == std::string::npos || !parse(words.substr(0, equals), px) ||
      !parse(words.substr(equals + 1), metres))
    throw_input_error("got '{}', expected PIXELS=METRES, both above 0: how long a scale bar is", text);
  return metres / px;
}

}  // namespace espalier
