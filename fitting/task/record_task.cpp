#include <fmt/ranges.h>

#include <cmath>

#include <espalier/core/field_error.h>
#include <espalier/core/text/text_hash.h>
#include <espalier/environment/picture_envelope.h>
#include <espalier/fitting/picture/crown.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/fitting/task/trunk_room.h>
#include <espalier/image/reading/read_target.h>
#include <espalier/image/reading/room_to_grow.h>
#include <espalier/models/models.h>

namespace espalier {

namespace {

/// Over the bits of a mask and its labels, and the height of its tree.
std::uint64_t hash_target(const TargetPicture& target, std::uint64_t hash) {
  const auto add = [&hash](std::uint64_t word) {
    hash = hash_on(hash, {reinterpret_cast<const char*>(&word), sizeof word});
  };
  for (const Mask* mask : {&target.mask, &target.labels.leaf, &target.labels.wood})
    for (const std::uint64_t word : mask->words()) add(word);
  add(static_cast<std::uint64_t>(target.tree_height_px * 256));
  return hash;
}

/// Of a tree that is leafy, as the record says or the first picture shows.
void expect_leaves(const FitRecord& record, TreeKind seen, TargetView& view) {
  const KindChoice kind = record.kind == KindChoice::automatic ? choice_of(seen) : record.kind;
  if (kind == KindChoice::leafy) view.crown = crown_of(view.target.mask(), view.reading, view.labels);
}

/// What a scale bar tells of the tree's height goes into the record; a height that was given stays.
void take_height(const TargetPicture& target, FitRecord& record) {
  constexpr double kSame = 1e-6, kLeastHeight = 0.01, kMostHeight = 200;
  if (!target.height_m) return;
  const double height_m = *target.height_m;
  if (record.height_m && std::abs(*record.height_m - height_m) > kSame * height_m)
    throw_field_error("target.scale_bar",
                      "got a tree of {:.3f} m with a height of {} m, expected one of them", height_m,
                      *record.height_m);
  if (!(height_m >= kLeastHeight && height_m <= kMostHeight))
    throw_field_error("target.scale_bar", "got a tree of {:.3f} m, expected {} to {} m", height_m,
                      kLeastHeight, kMostHeight);
  record.height_m = height_m;
}

/// What is wrong with a picture, and what of it was left out.
std::vector<std::string> remarks_on(const TargetPicture& target, bool took_largest) {
  std::vector<std::string> remarks = describe(target.faults, took_largest);
  remarks.insert(remarks.end(), target.warnings.begin(), target.warnings.end());
  if (!target.left_out.empty())
    remarks.push_back(
        fmt::format("left out: {} (--keep-marks keeps them)", fmt::join(target.left_out, "; ")));
  return remarks;
}

/// Reads the pictures into the task and their hash into the record.
void read_views(FitRecord& record, FitTask& task) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const ViewRecord& view : record.views) {
    const TargetPicture target = read_target(view.file(), record.target);
    hash = hash_target(target, hash);
    for (const std::string& remark : remarks_on(target, record.target.one_tree))
      task.warnings.push_back(fmt::format("{}: {}", view.picture.string(), remark));
    if (&view == &record.views.front()) take_height(target, record);
    task.views.push_back(
        make_target_view(target.mask, target.tree_height_px, view.view, target_height_m(record)));
    TargetView& made = task.views.back();
    made.reading.kind = kind_with_labels(made.reading.kind, target.labels);
    made.labels = target.labels;
    made.confidence = target.confidence;
    expect_leaves(record, task.views.front().reading.kind, made);
  }
  const std::string hash_text = fmt::format("{:016x}", hash);
  if (!record.target_hash.empty() && record.target_hash != hash_text)
    throw_input_error(
        "{}: got {} than the run was begun with (hash {}, expected {})", record.views.front().file().string(),
        record.views.front().content ? "the same picture, read by this version of the program as another mask"
                                     : "another picture",
        hash_text, record.target_hash);
  record.target_hash = hash_text;
}

std::string look_of(TreeKind kind) { return kind == TreeKind::palm ? "like a palm" : name_of(kind); }

/// The kind that the caller states holds, also where the picture looks like another.
void warn_of_kind(const FitRecord& record, FitTask& task) {
  const std::optional<TreeKind> stated = stated_kind(record.kind);
  const TreeKind seen = task.views.front().reading.kind;
  if (stated && *stated != seen)
    task.warnings.push_back(fmt::format("{}: its tree looks {}, and is fitted as {}, as told",
                                        record.views.front().picture.string(), look_of(seen),
                                        name_of(*stated)));
}

/// Of a leafy tree that no second view shows from another side.
bool expects_depth(const FitTask& task) {
  return task.views.size() == 1 && area_px(task.views.front().crown) > 0;
}

/// Keeps the tree inside of the targets' outlines, with room beside their thin parts; where these leave no
/// room for its trunk, it grows without them.
void grow_into_pictures(const FitRecord& record, FitTask& task) {
  std::vector<PictureOutline> outlines;
  for (const TargetView& view : task.views)
    outlines.push_back({view.camera, room_to_grow(view.target.outline(), view.target.mask())});
  task.envelope = make_picture_envelope(outlines);
  if (!leaves_room_for_trunk(*task.envelope, target_height_m(record))) {
    task.envelope.reset();
    task.warnings.push_back(
        fmt::format("{}: its outline leaves no room for a trunk above the middle of the foot: fitted without "
                    "growing into it",
                    record.views.front().picture.string()));
    return;
  }
  task.growth.prune_to = task.envelope.get();
  task.growth.train = true;
}

}  // namespace

double target_height_m(const FitRecord& record) { return record.height_m.value_or(kNominalHeightM); }

FitTask make_task(FitRecord& record, const Model* model) {
  FitTask task;
  task.model = model ? model : &model_by_name(record.model);
  task.growth.budget = record.growth;
  task.objective = parse_objective(record.objective);
  for (int i = 0; i < record.fit_seeds; ++i) task.plant_seeds.push_back(record.seed + static_cast<Seed>(i));
  task.bare_wood_price = record.bare_wood_price;
  read_views(record, task);
  if (expects_depth(task)) task.depth_price = record.depth_price;
  warn_of_kind(record, task);
  if (record.train_to_target && !task.model->can_train())
    throw_field_error("train_to_target",
                      "got model '{}', which cannot grow into a picture, expected weber_penn", record.model);
  if (record.train_to_target) grow_into_pictures(record, task);
  return task;
}

FitTask make_task_at(const FitRecord& record, int size_px, const Model* model) {
  FitRecord resized = record;
  resized.target.size_px = size_px;
  resized.target_hash.clear();
  return make_task(resized, model);
}

}  // namespace espalier
