#include <algorithm>

#include <espalier/weber_penn/scalar/changed_children.h>

namespace espalier {

namespace {

bool is_removed(const BranchChange* change) { return change && change->removed; }

float along(const Segment& segment, float z) {
  const float t = (z - segment.z_start) / (segment.z_end - segment.z_start);
  return std::clamp(t, 0.f, 1.f);
}

}  // namespace

void ChangedChildren::begin(const GrowingStem& stem, const Segment& segment) {
  stem_ = &stem;
  segments_.push_back(segment);
  placer_.begin(stem, segments_.back());
}

bool ChangedChildren::next(ChildSite& site) {
  if (placer_.in_fan()) return next_of_fan(site);
  for (ChildSlot slot; placer_.next_slot(slot);)
    if (is_wanted(slot.index) && take(slot, site)) return true;
  return false;
}

/// False where the child is gone, or has to wait.
bool ChangedChildren::take(const ChildSlot& slot, ChildSite& site) {
  const float generated_z = placer_.z_of(slot);
  if (!placer_.is_borne(slot, generated_z)) return false;
  const ChangeCursor cursor = stem_->cursor.child(static_cast<std::uint32_t>(slot.index), generated_z);
  const BranchChange* change = cursor.change();
  if (is_removed(change)) return false;
  if (!change || (*change)[Quantity::position].changes_nothing()) {
    site = placer_.place(slot, segments_.back(), slot.t, change);
    site.cursor = cursor;
    return true;
  }
  waiting_.push_back({slot, std::clamp((*change)[Quantity::position].apply(generated_z), 0.f, 1.f), cursor});
  return false;
}

bool ChangedChildren::next_waiting(ChildSite& site) {
  if (waiting_.empty()) return false;
  const Waiting child = waiting_.back();
  waiting_.pop_back();
  const auto holds = [&](const Segment& segment) { return child.z <= segment.z_end; };
  auto segment = std::find_if(segments_.begin(), segments_.end(), holds);
  if (segment == segments_.end()) --segment;
  site = placer_.place(child.slot, *segment, along(*segment, child.z), child.cursor.change());
  site.cursor = child.cursor;
  return true;
}

/// A fan has no places along the stem: angles are changed after the model has set them.
bool ChangedChildren::next_of_fan(ChildSite& site) {
  while (placer_.next(site)) {
    if (!is_wanted(site.index)) continue;
    site.cursor = stem_->cursor.child(static_cast<std::uint32_t>(site.index), 1);
    const BranchChange* change = site.cursor.change();
    if (is_removed(change)) continue;
    site.turtle.roll_right(changed(change, Quantity::rotation, 0));
    site.turtle.pitch_down(changed(change, Quantity::down_angle, 0));
    return true;
  }
  return false;
}

}  // namespace espalier
