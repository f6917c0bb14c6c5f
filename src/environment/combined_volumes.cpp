// Volumes made of volumes: unions, intersections, differences, blends, and moved, scaled or turned ones.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <espalier/core/error.h>
#include <espalier/environment/volume.h>

namespace espalier {

namespace {

void check_parts(const std::vector<VolumePtr>& parts) {
  if (parts.empty() || std::find(parts.begin(), parts.end(), nullptr) != parts.end())
    throw InternalError("volumes of a volume: one is missing");
}

/// The size of a volume of these.
VolumeSize size_of(const std::vector<VolumePtr>& parts) {
  VolumeSize size{1, 0};
  for (const VolumePtr& part : parts) {
    size.parts += part->size().parts;
    size.depth = std::max(size.depth, part->size().depth);
  }
  ++size.depth;
  return size;
}

class Union final : public Volume {
 public:
  explicit Union(std::vector<VolumePtr> parts) : parts_(std::move(parts)) {
    check_parts(parts_);
    size_ = size_of(parts_);
  }
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override {
    return std::any_of(parts_.begin(), parts_.end(),
                       [&](const VolumePtr& part) { return part->contains(p); });
  }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return std::any_of(parts_.begin(), parts_.end(),
                       [&](const VolumePtr& part) { return part->surely_contains_ball(center_m, radius_m); });
  }
  float signed_distance_m(Vec3 p) const override {
    float nearest_m = parts_.front()->signed_distance_m(p);
    for (const VolumePtr& part : parts_) nearest_m = std::min(nearest_m, part->signed_distance_m(p));
    return nearest_m;
  }

 private:
  std::vector<VolumePtr> parts_;
  VolumeSize size_;
};

class Intersection final : public Volume {
 public:
  explicit Intersection(std::vector<VolumePtr> parts) : parts_(std::move(parts)) {
    check_parts(parts_);
    size_ = size_of(parts_);
  }
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override {
    return std::all_of(parts_.begin(), parts_.end(),
                       [&](const VolumePtr& part) { return part->contains(p); });
  }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return std::all_of(parts_.begin(), parts_.end(),
                       [&](const VolumePtr& part) { return part->surely_contains_ball(center_m, radius_m); });
  }
  float signed_distance_m(Vec3 p) const override {
    float farthest_m = parts_.front()->signed_distance_m(p);
    for (const VolumePtr& part : parts_) farthest_m = std::max(farthest_m, part->signed_distance_m(p));
    return farthest_m;
  }

 private:
  std::vector<VolumePtr> parts_;
  VolumeSize size_;
};

class Difference final : public Volume {
 public:
  explicit Difference(std::vector<VolumePtr> parts) : parts_(std::move(parts)) {
    check_parts(parts_);
    size_ = size_of(parts_);
  }
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override {
    return parts_.front()->contains(p) &&
           std::none_of(parts_.begin() + 1, parts_.end(),
                        [&](const VolumePtr& part) { return part->contains(p); });
  }
  float signed_distance_m(Vec3 p) const override {
    float distance_m = parts_.front()->signed_distance_m(p);
    for (std::size_t i = 1; i < parts_.size(); ++i)
      distance_m = std::max(distance_m, -parts_[i]->signed_distance_m(p));
    return distance_m;
  }

 private:
  std::vector<VolumePtr> parts_;
  VolumeSize size_;
};

/// The field of a soft object at distance r of its radius of influence [Wyvill, McPheeters, Wyvill 1986,
/// Eq. 1]: 1 at 0, 1/2 at 1/2, 0 at 1, level at both ends.
double soft_field(double r) {
  const double s = r * r;
  return 1 + s * (-22.0 / 9 + s * (17.0 / 9 - s * 4.0 / 9));
}

/// Where soft_field has this value, which lies in [0, 1].
double soft_radius(double field) {
  double lower = 0, upper = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (lower + upper) / 2;
    (soft_field(middle) > field ? lower : upper) = middle;
  }
  return (lower + upper) / 2;
}

class Blend final : public Volume {
 public:
  Blend(float width_m, std::vector<VolumePtr> parts) : width_m_(width_m), parts_(std::move(parts)) {
    check_parts(parts_);
    size_ = size_of(parts_);
  }
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override { return signed_distance_m(p) <= 0; }
  /// Where the fields' sum is what one part would have alone; beyond the reach of fields, the nearest part.
  float signed_distance_m(Vec3 p) const override {
    double field = 0;
    float nearest_m = INFINITY;
    for (const VolumePtr& part : parts_) {
      const float distance_m = part->signed_distance_m(p);
      nearest_m = std::min(nearest_m, distance_m);
      field += soft_field(std::clamp((distance_m / width_m_ + 1.0) / 2, 0.0, 1.0));
    }
    if (field <= 0) return nearest_m;
    const double joined_m = width_m_ * (2 * soft_radius(std::min(field, 1.0)) - 1);
    return std::min(nearest_m, static_cast<float>(joined_m));
  }

 private:
  float width_m_;
  std::vector<VolumePtr> parts_;
  VolumeSize size_;
};

class Moved final : public Volume {
 public:
  Moved(Vec3 by_m, VolumePtr part) : by_m_(by_m), part_(std::move(part)), size_(size_of({part_})) {}
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override { return part_->contains(p - by_m_); }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return part_->surely_contains_ball(center_m - by_m_, radius_m);
  }
  float signed_distance_m(Vec3 p) const override { return part_->signed_distance_m(p - by_m_); }

 private:
  Vec3 by_m_;
  VolumePtr part_;
  VolumeSize size_;
};

class Scaled final : public Volume {
 public:
  Scaled(float factor, VolumePtr part) : factor_(factor), part_(std::move(part)), size_(size_of({part_})) {}
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override { return part_->contains(p * (1 / factor_)); }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return part_->surely_contains_ball(center_m * (1 / factor_), radius_m / factor_);
  }
  float signed_distance_m(Vec3 p) const override {
    return factor_ * part_->signed_distance_m(p * (1 / factor_));
  }

 private:
  float factor_;
  VolumePtr part_;
  VolumeSize size_;
};

class Turned final : public Volume {
 public:
  Turned(double angle_rad, VolumePtr part)
      : cosine_(static_cast<float>(std::cos(angle_rad))),
        sine_(static_cast<float>(std::sin(angle_rad))),
        part_(std::move(part)),
        size_(size_of({part_})) {}
  VolumeSize size() const override { return size_; }
  bool contains(Vec3 p) const override { return part_->contains(turned_back(p)); }
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override {
    return part_->surely_contains_ball(turned_back(center_m), radius_m);
  }
  float signed_distance_m(Vec3 p) const override { return part_->signed_distance_m(turned_back(p)); }

 private:
  Vec3 turned_back(Vec3 p) const { return {cosine_ * p.x + sine_ * p.y, cosine_ * p.y - sine_ * p.x, p.z}; }

  float cosine_, sine_;
  VolumePtr part_;
  VolumeSize size_;
};

void check_positive(const char* what, float number) {
  if (!std::isfinite(number) || number <= 0)
    throw_input_error("{} is {}, expected a positive number", what, number);
}

}  // namespace

std::unique_ptr<Volume> make_union(std::vector<VolumePtr> parts) {
  return std::make_unique<Union>(std::move(parts));
}

std::unique_ptr<Volume> make_intersection(std::vector<VolumePtr> parts) {
  return std::make_unique<Intersection>(std::move(parts));
}

std::unique_ptr<Volume> make_difference(std::vector<VolumePtr> parts) {
  return std::make_unique<Difference>(std::move(parts));
}

std::unique_ptr<Volume> make_blend(float width_m, std::vector<VolumePtr> parts) {
  check_positive("blend: width", width_m);
  return std::make_unique<Blend>(width_m, std::move(parts));
}

std::unique_ptr<Volume> make_moved(Vec3 by_m, VolumePtr part) {
  if (!std::isfinite(by_m.x) || !std::isfinite(by_m.y) || !std::isfinite(by_m.z))
    throw_input_error("moved: got {}, {}, {}, expected finite numbers", by_m.x, by_m.y, by_m.z);
  check_parts({part});
  return std::make_unique<Moved>(by_m, std::move(part));
}

std::unique_ptr<Volume> make_scaled(float factor, VolumePtr part) {
  check_positive("scaled: factor", factor);
  check_parts({part});
  return std::make_unique<Scaled>(factor, std::move(part));
}

std::unique_ptr<Volume> make_turned(float angle_deg, VolumePtr part) {
  if (!std::isfinite(angle_deg))
    throw_input_error("turned: angle is {}, expected a finite number", angle_deg);
  check_parts({part});
  return std::make_unique<Turned>(double{angle_deg} * std::numbers::pi / 180, std::move(part));
}

}  // namespace espalier
