#include <algorithm>
#include <optional>

#include <espalier/core/field_error.h>
#include <espalier/fitting/branches/palm_trunk.h>
#include <espalier/fitting/picture/crown_reading.h>
#include <espalier/fitting/starts/fit_plan.h>
#include <espalier/fitting/starts/measured_start.h>
#include <espalier/fitting/starts/species_range.h>
#include <espalier/fitting/task/record_task.h>
#include <espalier/image/reading/roots.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {

namespace {

/// Where fits of palms start: from what the model has with fronds.
StartNames palm_starts(const Model& model, const StartNames& automatic) {
  StartNames palms{.source = StartSource::named, .presets = model.palm_presets()};
  std::erase_if(palms.presets, [&](const std::string& palm) {
    return std::ranges::find(automatic.left_out, palm) != automatic.left_out.end();
  });
  return palms.presets.empty() ? automatic : palms;
}

/// Makes the parts of a plan in their order: each may look at those before it.
class Planner {
 public:
  Planner(const FitRecord& record, const FitTask& task)
      : record_(record),
        task_(task),
        table_(task.model->table()),
        reading_(task.views.front().reading),
        height_m_(target_height_m(record)),
        start_(parse_start(record.start)) {}

  FitPlan plan() {
    plan_.kind = record_.kind == KindChoice::automatic ? choice_of(reading_.kind) : record_.kind;
    plan_.shares = shares_of(plan_.kind);
    plan_.freedom = record_.freedom == kFreedomOfKind ? usual_freedom(plan_.kind) : record_.freedom;
    plan_.choice = record_.search;
    trunk_ = held_trunk();
    if (record_.search.free.empty()) restrict_choice();
    if (!record_.species.empty()) stay_with_species();
    plan_.starts = starts();
    if (trunk_) plan_.held = lay_palm_trunk(task_, *trunk_, plan_.starts.front().values);
    return std::move(plan_);
  }

 private:
  /// Whether the picture is to say anything.
  bool is_read() const { return record_.kind != KindChoice::any; }
  bool starts_are_ours() const { return is_automatic(start_); }

  /// What the search starts from: what the user names, or what there is.
  StartNames start_names() const {
    if (!starts_are_ours()) return start_;
    if (!record_.species.empty()) return {.source = StartSource::named, .presets = {record_.species}};
    return trunk_ ? palm_starts(*task_.model, start_) : start_;
  }

  /// The trunk that a palm is held to; none where the user says how to search, or the model has no such
  /// trunks.
  std::optional<TrunkLine> held_trunk() const {
    const bool is_left_to_us = starts_are_ours() && record_.search.free.empty() && record_.fit_seeds == 1;
    if (!is_left_to_us || plan_.kind != KindChoice::palm || !can_hold_trunks(*task_.model))
      return std::nullopt;
    return read_trunk_line(without_roots(task_.views.front().target.mask()));
  }

  /// Where the model has the parameter and the user says nothing of it.
  void fix(const std::string& name, double value) {
    if (table_.find(name)) plan_.choice.fixed.insert({name, value});
  }

  void fix(Role role, double value) {
    const auto row = table_.find(role);
    if (row && value >= table_.rows[*row].lower && value <= table_.rows[*row].upper)
      fix(table_.rows[*row].full_name(), value);
  }

  void restrict_choice() {
    if (plan_.kind == KindChoice::leafless) fix(Role::leaf_count, 0);
    if (!is_read()) return;
    if (record_.kind == KindChoice::automatic && reading_.trunks == 1) fix(Role::trunk_count, 1);
    plan_.choice.ranges = measured_ranges(table_, reading_, stated_kind(plan_.kind).value(), height_m_,
                                          record_.any_leaf_size ? LeafSizes::any : LeafSizes::of_species);
    if (!trunk_) return;
    for (const auto& [name, value] : palm_parameters(table_, *trunk_, task_.views.front().metres_per_px))
      fix(name, value);
  }

  /// After the picture's ranges, which give way to the species'.
  void stay_with_species() {
    Preset species = in_field("species", [&] { return load_preset(record_.species); });
    if (!is_same_model(species.model, table_.model))
      throw_field_error("species", "got '{}' of model {}, expected a preset of {}", record_.species,
                        species.model, table_.model);
    prepare_start(*task_.model, record_.growth, height_m_, task_.plant_seeds.front(), species.values);
    std::vector<ParameterValues> all;
    for (const StartPoint& bundled : presets_as_written(table_, StartNames{})) all.push_back(bundled.values);
    if (all.empty())
      throw_field_error("species", "got model '{}', which has no bundled species to tell what one allows",
                        record_.model);
    keep_to_species(table_, species.values, spread_of_species(table_, all), plan_.choice);
  }

  std::vector<StartPoint> starts() const {
    if (!record_.stages.search &&
        (start_.source == StartSource::named || start_.source == StartSource::defaults))
      return presets_as_written(table_, start_);
    std::vector<StartPoint> starts = make_start_points(*task_.model, start_names(), plan_.choice,
                                                       record_.growth, height_m_, task_.plant_seeds.front());
    const bool any_crown = std::ranges::any_of(starts, [&](const auto& start) { return gets_crown(start); });
    const CrownShape seen = any_crown ? crown_of_picture() : CrownShape{};
    for (StartPoint& start : starts) {
      if (is_read() && starts_are_ours()) measure(start.values);
      if (gets_crown(start)) task_.model->set_crown(seen, start.values);
      keep_in_ranges(table_, plan_.choice, start.values);
      if (trunk_) fix_trunk(start.values);
      apply_fixed(table_, plan_.choice, start.values);
    }
    return starts;
  }

  void measure(ParameterValues& values) const {
    const Seed seed = task_.plant_seeds.front();
    take_measures(*task_.model, record_.growth, reading_, height_m_, seed, values);
    prepare_start(*task_.model, record_.growth, height_m_, seed, values);
  }

  /// Whether it is the user who gives this start a crown envelope, which then begins as the picture's. Only
  /// from the front does a picture show its left and its right.
  bool gets_crown(const StartPoint& start) const {
    const bool is_front = record_.views.front().view.azimuth_deg == 0;
    return is_read() && is_front && start_.source != StartSource::random && !start.has_own_crown &&
           task_.model->uses_crown(start.values);
  }
  CrownShape crown_of_picture() const {
    return crown_shape_of(read_crown(task_.views.front().target.mask(), reading_), height_m_);
  }

  /// Fronds stay as long as they are while the trunk gets another length.
  void fix_trunk(ParameterValues& values) const {
    const std::size_t scale = *table_.find(Role::tree_scale);
    const double before_m = values[scale];
    apply_fixed(table_, plan_.choice, values);
    if (const auto frond = table_.find(Role::branch_length, 1))
      set_role(table_, {Role::branch_length, 1}, values[*frond] * before_m / values[scale], values);
  }

  const FitRecord& record_;
  const FitTask& task_;
  const ParameterTable& table_;
  const PictureReading& reading_;
  double height_m_;
  StartNames start_;
  std::optional<TrunkLine> trunk_;
  FitPlan plan_;
};

}  // namespace

StageShares shares_of(KindChoice kind) {
  // A search of 20 % does as well as one of 40 % (experiments/closeness.md). Leafless trees gain most by what
  // follows, where their branches are traced; their share was chosen on the bundled leafless pictures, and
  // was not varied since.
  constexpr double kSearch = 0.4, kSearchOfLeafless = 0.15;
  constexpr double kBeforeFinish = 0.6;  // chosen in experiments/closeness.md
  return {kind == KindChoice::leafless ? kSearchOfLeafless : kSearch, kBeforeFinish};
}

FitPlan plan_of(const FitRecord& record, const FitTask& task) { return Planner(record, task).plan(); }

double usual_freedom(KindChoice kind) {
  return kind == KindChoice::leafless || kind == KindChoice::palm ? kWholeFreedom : 1;
}

void settle_branches(const FitPlan& plan, FitTask& task) {
  task.freedom = freedom_of(plan.freedom);
  if (plan.held.empty()) return;
  task.overrides = plan.held;
  task.changes = std::make_shared<const ChangeGraph>(task.overrides);
  task.growth.changes = task.changes.get();
}

}  // namespace espalier
