// Growth is breadth-first: all stems of a level, their clones queued behind them, then their children.
// A parent therefore always comes before its children in the plant's arrays.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <espalier/environment/leaves_inside.h>
#include <espalier/weber_penn/grow.h>
#include <espalier/weber_penn/scalar/changed_children.h>
#include <espalier/weber_penn/scalar/child_stem.h>
#include <espalier/weber_penn/scalar/children.h>
#include <espalier/weber_penn/scalar/leaf_placement.h>
#include <espalier/weber_penn/scalar/pruning.h>
#include <espalier/weber_penn/scalar/stem_knots.h>
#include <espalier/weber_penn/simd/curve_knots.h>
#include <espalier/weber_penn/simd/leaf_batch.h>
#include <espalier/weber_penn/simd/stem_batch.h>
#include <espalier/weber_penn/simd/twig_batch.h>
#include <espalier/weber_penn/table/shape_ratio.h>
#include <espalier/weber_penn/tree_crown.h>
#include <espalier/weber_penn/trunks.h>

namespace espalier {

namespace {

/// The crown of a branch, which holds all that grows on it.
struct Pad {
  PlacedCrown crown;
  int level;  ///< of the branch
};

/// What a thread keeps from one plant to the next: memory only, nothing of the plant.
struct GrowthMemory {
  std::vector<GrowingStem> level, next_level;  ///< queues
  StemBatch stem_batch;
  ChildBatchMemory leaves, twigs;
  std::vector<Pad> pads;
};

/// Which children a stem bears, and whether vectors place them.
struct Offspring {
  bool leaves = false, stems = false;
  bool are_changed = false;  ///< some by overrides, or all but one are left out
  ChildBatch* batch = nullptr;
};

/// Leaves are cut by the volume once all have grown.
bool cuts_leaves(const GrowthSettings& settings) { return settings.train && settings.prune_to; }

/// The tree's crown is what stems are pruned to or trained along where no other volume is given.
GrowthSettings with_crown(const GrowthSettings& settings, const TreeCrown& crown) {
  GrowthSettings result = settings;
  if (settings.prune_to != nullptr || crown.of_twigs() == nullptr) return result;
  result.prune_to = crown.of_twigs();
  result.train = crown.trains();
  return result;
}

class Growth {
 public:
  Growth(const WeberPennParameters& p, const BranchParameters* of_branches, const GrowthSettings& settings,
         const TreeCrown& crown, Lanes lanes, GrowthMemory& memory, Plant& plant)
      : p_(p),
        of_branches_(of_branches),
        settings_(settings),
        crown_(crown),
        uses_vectors_(lanes == Lanes::many),
        plant_(plant),
        stem_batch_(memory.stem_batch),
        leaf_batch_(p, memory.leaves, plant.leaves, cuts_leaves(settings) ? nullptr : settings.leaf_sink),
        twig_batch_(p, settings, memory.twigs, memory.next_level),
        level_(memory.level),
        next_level_(memory.next_level),
        pads_(memory.pads) {
    pads_.clear();
    level_.clear();
    next_level_.clear();
  }

  GrowthResult run(Seed seed);

 private:
  class StemGrowth;

  std::int32_t last_stem() const { return static_cast<std::int32_t>(plant_.stems.size()) - 1; }
  /// Whether the stem itself is part of what is asked for, not only on the way to it.
  bool is_shown(const GrowingStem& stem) const {
    return !settings_.only_part ||
           static_cast<std::size_t>(stem.path_length) >= settings_.only_part->path.size();
  }
  bool is_wanted(const GrowingStem& stem) const;
  /// The one child to grow where the stem only leads to the part asked for.
  std::optional<std::uint32_t> only_child(const GrowingStem& stem) const {
    if (is_shown(stem)) return std::nullopt;
    return settings_.only_part->path[static_cast<std::size_t>(stem.path_length)];
  }

  Offspring offspring(const GrowingStem& stem);
  bool supports(const GrowingStem& stem);
  std::size_t batch_size(std::size_t index);
  void begin_stem(const GrowingStem& stem);
  void grow_stem(const GrowingStem& stem);
  void grow_stems(std::span<const GrowingStem> stems);
  std::size_t grow_next(std::size_t index);
  bool change_trunk(GrowingStem& trunk) const;
  void grow_child(const GrowingStem& parent, std::int32_t parent_index, const ChildSite& site);
  float child_length_m(const GrowingStem& parent, const ChildSite& site) const;
  float shaped_length_m(const GrowingStem& parent, const ChildSite& site) const;
  const PlacedCrown* length_giver(const GrowingStem& parent) const;
  void place_pad(GrowingStem& stem);
  bool prune(GrowingStem& stem) const;
  bool prune(GrowingStem& stem, const Volume* volume) const;
  double over_budget_factor() const;

  /// Those that the stem and its children grow by.
  const WeberPennParameters& parameters(const GrowingStem& stem) const { return parameters_of(stem, p_); }

  const WeberPennParameters& p_;         ///< the tree's
  const BranchParameters* of_branches_;  ///< where some have their own
  const GrowthSettings& settings_;
  const TreeCrown& crown_;
  bool uses_vectors_;
  Plant& plant_;
  StemBatch& stem_batch_;
  LeafBatch leaf_batch_;
  TwigBatch twig_batch_;
  std::vector<GrowingStem>&level_, &next_level_;
  std::vector<Pad>& pads_;
};

/// Adds the knots of one stem, its leaves and its queued children while the stem is walked.
class Growth::StemGrowth : public StemVisitor {
 public:
  StemGrowth(Growth& growth, const GrowingStem& stem)
      : growth_(growth),
        p_(growth.parameters(stem)),
        is_shown_(growth.is_shown(stem)),
        index_(is_shown_ ? growth.last_stem() : -1),
        offspring_(growth.offspring(stem)) {
    if (offspring_.leaves)
      children_.emplace(stem, ChildPlacer::Bears::leaves, p_);
    else if (offspring_.stems)
      children_.emplace(stem, ChildPlacer::Bears::stems, p_);
    if (offspring_.are_changed) changed_.emplace(*children_, growth.only_child(stem));
    growth.twig_batch_.set_parent(index_);
  }

  bool segment(const GrowingStem& stem, const Segment& segment) override {
    if (is_shown_) append_knots(stem, segment, p_, growth_.plant_.knots);
    if (children_) bear_children(stem, segment);
    return true;
  }

  void split(const GrowingStem& clone) override {
    if (!growth_.is_wanted(clone)) return;
    growth_.level_.push_back(clone);
    growth_.level_.back().origin = index_;
  }

  /// After the last segment.
  void finish(const GrowingStem& stem) {
    if (!changed_) return;
    changed_->end(stem);
    for (ChildSite site; changed_->next_waiting(site);) growth_.grow_child(stem, index_, site);
  }

 private:
  void bear_children(const GrowingStem& stem, const Segment& segment) {
    if (changed_) {
      changed_->begin(stem, segment);
      for (ChildSite site; changed_->next(site);) growth_.grow_child(stem, index_, site);
      return;
    }
    children_->begin(stem, segment);
    if (offspring_.batch) {
      offspring_.batch->add(stem, segment, *children_);
      return;
    }
    for (ChildSite site; children_->next(site);) {
      if (offspring_.leaves)
        place_leaf(stem, site, p_, growth_.plant_.leaves);
      else
        growth_.grow_child(stem, index_, site);
    }
  }

  Growth& growth_;
  const WeberPennParameters& p_;  ///< the stem's
  bool is_shown_;
  std::int32_t index_;  ///< in the plant; -1 where the stem is not shown
  Offspring offspring_;
  std::optional<ChildPlacer> children_;
  std::optional<ChangedChildren> changed_;
};

Offspring Growth::offspring(const GrowingStem& stem) {
  if (stem.level + 1 >= p_.level_count()) {
    if (parameters(stem).leaf_blos_num == 0 || !is_shown(stem)) return {};
    const bool in_batches = uses_vectors_ && !stem.axis && !stem.own && LeafBatch::supports(stem, p_);
    return {.leaves = true, .batch = in_batches ? &leaf_batch_ : nullptr};
  }
  if (settings_.only_part && settings_.only_part->alone && is_shown(stem)) return {};
  const bool are_changed = stem.cursor.changes_below() || !is_shown(stem);
  const bool are_trained = settings_.train && settings_.prune_to;
  const bool in_batches =
      uses_vectors_ && !are_changed && !are_trained && stem.pad < 0 && TwigBatch::supports(stem, p_);
  return {.stems = true, .are_changed = are_changed, .batch = in_batches ? &twig_batch_ : nullptr};
}

/// Enters the stem into the plant's arrays; its knots follow.
void Growth::begin_stem(const GrowingStem& stem) {
  if (!is_shown(stem)) return;
  plant_.stems.parent.push_back(stem.parent);
  plant_.stems.level.push_back(static_cast<std::uint8_t>(stem.level));
  plant_.stems.path_key.push_back(stem.key.value);
  plant_.stems.origin.push_back(stem.origin);
  plant_.stems.child_index.push_back(stem.child_index);
  if (settings_.stem_cursors && settings_.changes) settings_.stem_cursors->push_back(stem.cursor);
}

void Growth::grow_stem(const GrowingStem& stem) {
  begin_stem(stem);
  StemGrowth growth(*this, stem);
  walk_stem(stem, parameters(stem), growth);
  growth.finish(stem);
  if (is_shown(stem)) plant_.stems.first_knot.push_back(static_cast<std::uint32_t>(plant_.knots.size()));
}

/// Stems that a StemBatch takes, on whose level vectors compute everything.
void Growth::grow_stems(std::span<const GrowingStem> stems) {
  stem_batch_.walk(stems, p_);
  const std::int32_t first = last_stem() + 1;
  for (const GrowingStem& stem : stems) begin_stem(stem);
  append_knots(stems, stem_batch_, p_, plant_);
  ChildBatch* const children = offspring(stems[0]).batch;
  if (children == nullptr) return;
  for (std::size_t i = 0; i < stems.size(); ++i) {
    twig_batch_.set_parent(first + static_cast<std::int32_t>(i));
    children->add(stems[i], stem_batch_, i);
  }
}

/// Whether the stem grows in a batch, with all that is on it: not where an override changes it or what it
/// bears.
bool Growth::supports(const GrowingStem& stem) {
  const Offspring of = offspring(stem);
  const bool is_plain = !of.leaves && !of.stems;
  return uses_vectors_ && (is_plain || of.batch != nullptr) && is_shown(stem) &&
         !stem.cursor.changes_below() && stem.extra_curve.is_none() && StemBatch::supports(stem.level, p_) &&
         has_plain_knots(stem.level, p_);
}

/// How many stems from `index` on grow in one batch.
std::size_t Growth::batch_size(std::size_t index) {
  const std::size_t most = std::min<std::size_t>(StemBatch::kMostStems, level_.size() - index);
  std::size_t count = 0;
  while (count < most && supports(level_[index + count])) ++count;
  return count;
}

/// One stem, or as many as a batch holds; how many.
std::size_t Growth::grow_next(std::size_t index) {
  if (const std::size_t count = batch_size(index); count > 0) {
    grow_stems(std::span(level_).subspan(index, count));
    return count;
  }
  const GrowingStem stem = level_[index];  // a copy: clones are queued while it grows
  grow_stem(stem);
  return 1;
}

float Growth::child_length_m(const GrowingStem& parent, const ChildSite& site) const {
  const WeberPennParameters& p = parameters(parent);
  const AlongCurve& along = p.curves.length_along[level_index(parent.level + 1)];
  const float shaped_m = shaped_length_m(parent, site);
  return along.is_neutral ? shaped_m : shaped_m * along.at(place_above_base(parent, site.offset_m, p));
}

/// Level 1 follows the crown's shape, deeper levels their place on the parent [Weber & Penn 95, §4.4].
float Growth::shaped_length_m(const GrowingStem& parent, const ChildSite& site) const {
  const float longest_m = parent.length_m * parent.child_max;
  if (parent.level > 0) return parent.child_max * (parent.length_m - 0.7f * site.offset_m);
  const float ratio = (parent.length_m - site.offset_m) / (parent.length_m - parent.tree.base_length_m);
  return longest_m * crown_shape_ratio(std::clamp(ratio, 0.f, 1.f), parameters(parent));
}

void Growth::grow_child(const GrowingStem& parent, std::int32_t parent_index, const ChildSite& site) {
  if (site.parent_radius_m < thinnest_parent_m(parameters(parent))) return;
  const int level = parent.level + 1;
  const BranchChange* change = site.cursor.change();
  GrowingStem child;
  child.child_index = static_cast<std::uint32_t>(site.index);
  child.key = reseeded(child_key(parent.key, child.child_index), change ? change->seed : 0);
  child.level = level;
  child.parent = child.origin = parent_index;
  child.path_length = parent.path_length + 1;
  child.cursor = site.cursor;
  child.axis = child.cursor.axis();
  child.pad = parent.pad;
  child.tree = parent.tree;
  find_parameters(child);
  const WeberPennParameters& p = parameters(child);
  child.extra_curve = extra_curve(change, level, p);
  child.turtle = site.turtle;
  child.offset_m = site.offset_m;
  child.parent_length_m = parent.length_m;
  child.parent_child_max = parent.child_max;
  const PlacedCrown* crown = length_giver(parent);
  const auto length_m = [&] {
    const float own_m = crown ? length_to_crown_m(child, *crown, p) : child_length_m(parent, site);
    return changed(change, Quantity::length, site.grown_fraction * own_m);
  };
  child.length_m = length_m();
  if (child.length_m < kShortestStemM) return;
  // [CH §3.2.1]: starts as close as is safe to the parent's surface; before pruning, which tests where it is.
  const auto radius_m = [&](float length_m) {
    return child_radius_m(length_m, parent.length_m, parent.radius_m, site.parent_radius_m, level, p);
  };
  const float unpruned_radius_m = radius_m(child.length_m);
  child.turtle.position_m += site.outward * (site.parent_radius_m - unpruned_radius_m);
  if (crown) child.length_m = length_m();  // from where it starts now
  if (!prune(child)) return;
  child.radius_m = changed(change, Quantity::radius, radius_m(child.length_m));
  child.child_max = drawn_child_max(child, p);
  place_pad(child);
  twig_batch_.flush();  // what waits comes before
  next_level_.push_back(child);
}

/// The envelope on which the tips of the stem's children lie; nullptr where there is none. That of a branch
/// holds for the stems on it alone.
const PlacedCrown* Growth::length_giver(const GrowingStem& parent) const {
  if (parent.pad < 0) return crown_.gives_lengths(parent.level + 1);
  const Pad& pad = pads_[static_cast<std::size_t>(parent.pad)];
  return pad.level == parent.level ? &pad.crown : nullptr;
}

/// Where the stem has a crown of its own, that begins here, from its base to its tip [Boudon et al. 2003,
/// §3].
void Growth::place_pad(GrowingStem& stem) {
  const BranchCrown* crown = stem.cursor.crown();
  if (crown == nullptr) return;
  const Vec3 tip = tip_m(stem, parameters(stem));
  if (length(tip - stem.turtle.position_m) < kShortestStemM) return;
  stem.pad = static_cast<std::int32_t>(pads_.size());
  pads_.push_back({PlacedCrown(*crown, stem.turtle, tip), stem.level});
}

/// False where nothing is left of the stem. One that follows an axis stays where that is drawn: it is not
/// trained to grow elsewhere.
bool Growth::prune(GrowingStem& stem) const {
  const bool is_to_crown = settings_.prune_to && settings_.prune_to == crown_.of_twigs();
  if (stem.pad >= 0) {
    const Pad& pad = pads_[static_cast<std::size_t>(stem.pad)];
    if (stem.level > pad.level + 1 && !prune(stem, &pad.crown)) return false;
    return settings_.prune_to == nullptr || is_to_crown || prune(stem, settings_.prune_to);
  }
  const Volume* volume = is_to_crown ? crown_.volume(stem.level) : settings_.prune_to;
  return (volume == nullptr && is_to_crown) || prune(stem, volume);
}

bool Growth::prune(GrowingStem& stem, const Volume* volume) const {
  if (volume && settings_.train && stem.axis) return stem.length_m >= kShortestStemM;
  if (volume && settings_.train)
    train_stem(stem, parameters(stem), *volume);
  else
    stem.length_m = pruned_length_m(stem, parameters(stem), volume);
  return stem.length_m >= kShortestStemM;
}

double Growth::over_budget_factor() const {
  const double stems =
      (static_cast<double>(plant_.stems.size() + next_level_.size()) + twig_batch_.waiting()) /
      settings_.budget.max_stems;
  const double leaves =
      (static_cast<double>(plant_.leaves.size() + leaf_batch_.given()) + leaf_batch_.waiting()) /
      settings_.budget.max_leaves;
  return std::max(stems, leaves);
}

/// Whether the part asked for is on the stem, or the stem on the way to it.
bool Growth::is_wanted(const GrowingStem& stem) const {
  if (!settings_.only_part) return true;
  const BranchPath& path = settings_.only_part->path;
  const auto depth = static_cast<std::size_t>(stem.path_length);
  return depth > path.size() ? !settings_.only_part->alone : path[depth - 1] == stem.child_index;
}

/// Of a trunk that is told which way to bend, or follows an axis, the random roll is taken back. A value is
/// counted from the right of the front view: without a roll a trunk bends away from the viewer.
float trunk_roll_deg(GrowingStem& trunk, const Modification& rotation) {
  const bool is_told = !std::isnan(rotation.replaced_by);
  if (is_told || trunk.axis)
    trunk.turtle.right = normalized(Vec3{1, 0, 0} - trunk.turtle.forward * trunk.turtle.forward.x);
  return rotation.apply(0) - (is_told ? 90 : 0);
}

/// False where overrides remove the trunk.
bool Growth::change_trunk(GrowingStem& trunk) const {
  const BranchChange* change = trunk.cursor.change();
  if (change == nullptr) return true;
  const WeberPennParameters& p = parameters(trunk);
  if (trunk.own) trunk.length_m = trunk_length_m(trunk, p);
  trunk.key = reseeded(trunk.key, change->seed);
  trunk.length_m = (*change)[Quantity::length].apply(trunk.length_m);
  trunk.tree.base_length_m = trunk.length_m * p.base_size[0];
  trunk.axis = trunk.cursor.axis();
  trunk.turtle.roll_right(trunk_roll_deg(trunk, (*change)[Quantity::rotation]));
  trunk.turtle.pitch_down((*change)[Quantity::down_angle].apply(0));
  trunk.extra_curve = extra_curve(change, 0, p);
  return !change->removed;
}

GrowthResult Growth::run(Seed seed) {
  plant_trunks(p_, root_key(seed), level_);
  plant_.tree_scale_m = level_.front().tree.scale_m;
  const ChangeCursor above_trunks(settings_.changes);
  for (GrowingStem& trunk : level_) {
    trunk.child_index = static_cast<std::uint32_t>(&trunk - level_.data());
    trunk.cursor = above_trunks.child(trunk.child_index);
    trunk.tree.of_branches = of_branches_;
    find_parameters(trunk);
    if (!is_wanted(trunk) || !change_trunk(trunk) || !prune(trunk)) trunk.length_m = 0;
    const WeberPennParameters& p = parameters(trunk);
    trunk.radius_m =
        changed(trunk.cursor.change(), Quantity::radius, trunk.length_m * p.ratio * p.radius_mod[0]);
    trunk.child_max = drawn_child_max(trunk, p);
    if (trunk.length_m >= kShortestStemM) place_pad(trunk);
  }
  std::erase_if(level_, [](const GrowingStem& trunk) { return trunk.length_m < kShortestStemM; });
  for (int level = 0; level < p_.level_count() && !level_.empty(); ++level) {
    for (std::size_t index = 0; index < level_.size();) {
      index += grow_next(index);
      if (const double factor = over_budget_factor(); factor > 1) {
        leaf_batch_.flush();
        return {false, factor};
      }
    }
    twig_batch_.flush();
    std::swap(level_, next_level_);
    next_level_.clear();
  }
  leaf_batch_.flush();
  return {};
}

}  // namespace

GrowthResult grow_tree(const WeberPennParameters& parameters, Seed seed, const GrowthSettings& settings,
                       Plant& plant, Lanes lanes, const BranchParameters* of_branches) {
  plant.clear();
  plant.leaf_shape = static_cast<int>(parameters.leaf_shape);
  plant.blossom_shape = static_cast<int>(parameters.blossom_shape);
  plant.stems.first_knot.push_back(0);
  if (settings.stem_cursors) settings.stem_cursors->clear();
  static thread_local GrowthMemory memory;
  const TreeCrown crown(parameters, tree_scale_m(parameters, child_key(root_key(seed), 0)));
  const GrowthSettings in_crown = with_crown(settings, crown);
  const GrowthResult result =
      Growth(parameters, of_branches, in_crown, crown, lanes, memory, plant).run(seed);
  if (cuts_leaves(in_crown)) keep_leaves_inside(*in_crown.prune_to, plant.leaves);
  return result;
}

}  // namespace espalier
