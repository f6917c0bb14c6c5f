#include <espalier/core/error.h>
#include <espalier/image/marks/marks.h>
#include <espalier/image/pictures/decode.h>
#include <espalier/image/reading/clean.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/image/separation/separate_tree.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

/// A tree has at least this share of the picture's pixels.
constexpr double kSmallestTreeShare = 1e-4;
/// And leaves at least this share to the background.
constexpr double kSmallestBackgroundShare = 1e-3;

void check_shows_a_tree(const Mask& mask, const std::string& name, const std::string& how) {
  const double all = static_cast<double>(mask.width_px()) * mask.height_px();
  const double share = static_cast<double>(area_px(mask)) / all;
  if (share == 0)
    throw_input_error("{}: shows no tree: nothing stands out from the background ({})", name, how);
  if (share < kSmallestTreeShare)
    throw_input_error("{}: shows no tree: {} of {} pixels are set ({})", name, area_px(mask), all, how);
  if (share > 1 - kSmallestBackgroundShare)
    throw_input_error("{}: shows no tree: it has no background ({})", name, how);
}

/// Cleans the separated mask and says so in its `how`.
void clean(Separation& separation, const TargetOptions& options) {
  Mask& mask = separation.mask;
  const std::size_t speck_px = options.speck_px >= 0 ? static_cast<std::size_t>(options.speck_px)
                                                     : default_speck_px(mask.width_px(), mask.height_px());
  const std::size_t before = area_px(mask);
  mask = remove_specks(mask, speck_px);
  separation.how += fmt::format("; specks under {} px removed ({} px)", speck_px, before - area_px(mask));
  if (!options.fill_pinholes) return;
  const std::size_t cleaned = area_px(mask);
  mask = fill_pinholes(mask, speck_px);
  separation.how += fmt::format("; pinholes under {} px filled ({} px)", speck_px, area_px(mask) - cleaned);
}

/// The picture's tree alone: separated, in the picture's own size and place.
Separation separate(const DecodedPicture& picture, const TargetOptions& options, const std::string& name) {
  Separation separation = separate_tree(picture, with_hints(options.separation, options.hints), name);
  check_shows_a_tree(separation.mask, name, separation.how);
  return separation;
}

void check_hints(const TargetOptions& options, const std::string& name) {
  if (options.hints.tree > 0 && !options.one_tree)
    throw_input_error("{}: got tree {} and all trees as one, expected one of them", name, options.hints.tree);
}

void leave_out_marks(const TargetOptions& options, Separation& separation) {
  MarkedMask marked = without_marks(separation.mask, marks_to_leave_out(options.hints.keep_marks));
  separation.mask = std::move(marked.tree);
  for (std::string& line : describe(marked.marks)) separation.left_out.push_back(std::move(line));
}

/// The one that was asked for, or the largest.
void choose_tree(const TargetOptions& options, const PictureFaults& faults, const std::string& name,
                 Separation& separation) {
  const int chosen = options.hints.tree;
  if (chosen > 0) {
    std::vector<Mask> trees = trees_as_read(separation.mask);
    if (chosen > static_cast<int>(trees.size()))
      throw_input_error("{}: got tree {}, expected {}", name, chosen,
                        trees.size() == 1 ? "1: it shows no other" : fmt::format("1 to {}", trees.size()));
    separation.mask = std::move(trees[static_cast<std::size_t>(chosen) - 1]);
    separation.how += fmt::format("; tree {} of {}", chosen, trees.size());
  } else if (options.one_tree && faults.trees > 1) {
    separation.mask = largest_tree(separation.mask);
    separation.how += fmt::format("; the largest of {} trees", faults.trees);
  }
}

PictureFaults without_others(PictureFaults faults) {
  faults.trees = faults.rows = 1;
  return faults;
}

void tell_height(const TargetOptions& options, TargetPicture& target) {
  const double m_per_px = parse_scale_bar(options.hints.scale_bar);
  if (m_per_px > 0)
    target.height_m = m_per_px * static_cast<double>(target.tree_height_px) / target.frame_px_per_source_px;
}

/// Of an animation, or pages.
std::string frame_in_words(const DecodedPicture& picture) {
  if (picture.frame == 1) return "";
  return fmt::format(
      "frame {}{}; ", picture.frame,
      picture.blank_frames > 0 ? fmt::format(", {} before it blank", picture.blank_frames) : "");
}

/// What a target says of the picture that it was made of.
void tell_source(const DecodedPicture& picture, TargetPicture& target) {
  target.source_width_px = picture.source_width_px;
  target.source_height_px = picture.source_height_px;
  target.frame_px_per_source_px *=
      static_cast<float>(picture.width_px) / static_cast<float>(picture.source_width_px);
}

/// Labels the tree where it stands in the picture, and places the labels where the target shows it.
PlantLabels framed_labels(const DecodedPicture& picture, const Mask& tree, const Mask& target) {
  PlantLabels labels = label_plant(picture, tree);
  if (!labels.are_known()) return labels;
  const Framing framing = framing_of(tree, target.width_px());
  labels.leaf = both(place(labels.leaf, framing, labels.px_per_label), target);
  labels.wood = both(place(labels.wood, framing, labels.px_per_label), target);
  return labels;
}

}  // namespace

TargetPicture read_mask(const fs::path& path, const TargetOptions& options) {
  const DecodedPicture picture = decode_picture(path, options.hints.frame);
  Separation separation = separate(picture, options, path.string());
  TargetPicture target;
  target.mask = std::move(separation.mask);
  target.how = std::move(separation.how);
  tell_source(picture, target);
  return target;
}

TargetPicture read_target(const fs::path& path, const TargetOptions& options) {
  check_frame_size(options.size_px);
  check_hints(options, path.string());
  const DecodedPicture picture = decode_picture(path, options.hints.frame);
  Separation separation = separate(picture, options, path.string());
  const Mask separated = separation.mask;
  clean(separation, options);
  leave_out_marks(options, separation);
  check_shows_a_tree(separation.mask, path.string(), separation.how);
  const PictureFaults faults = picture_faults(separation.mask);
  choose_tree(options, faults, path.string(), separation);
  TargetPicture target = frame_mask(separation.mask, options.size_px, path.string());
  tell_source(picture, target);
  tell_height(options, target);
  target.how = fmt::format("{}{}; {}", frame_in_words(picture), separation.how, target.how);
  target.faults = options.hints.tree > 0 ? without_others(faults) : faults;
  target.confidence = separation.confidence;
  target.warnings = std::move(separation.warnings);
  target.left_out = std::move(separation.left_out);
  if (options.labels == LabelChoice::automatic)
    target.labels = framed_labels(picture, separation.mask, target.mask);
  target.source_marks = without(separated, separation.mask);
  target.source_tree = std::move(separation.mask);
  return target;
}

}  // namespace espalier
