// The asymmetric crown envelope of 16 numbers: a top and a bottom, the line of the crown's widest points
// between them (the rim), and how the crown bulges above and below it. Metres; x to the right, y to the back,
// z up. Sources: Horn 1971, Koop 1989, Cescatti 1997 (Modelling the radiative transfer in discontinuous
// canopies of asymmetric crowns); control points as in Boudon, Prusinkiewicz, Federl, Godin, Karwowski 2003
// (Interactive design of bonsai tree models, §2.4).
//   rim:    L(θ) = (rᵢ cos θ, rⱼ sin θ, hᵢ cos² θ + hⱼ sin² θ), i and j the sides of θ's quarter
//   above:  P = T + ρ (L − T) in plan, z = z_L + (z_T − z_L) (1 − ρ^C)^(1/C), ρ from 0 (top) to 1 (rim)
//   below:  the same with the bottom and its C
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include <espalier/environment/volume.h>

namespace espalier {

/// How height falls from the axis to the rim: by a superellipse (C = 1 a cone, 2 an ellipsoid, large a
/// cylinder, under 1 hollow), or by z = z_T − (z_T − z_L) ρ^C (2 a paraboloid), as PlantGL draws its
/// asymmetric hulls.
enum class CrownProfile { superellipse, power };

/// Sides in the order of numbers: to the right (x > 0), back (y > 0), left, front (of who looks along +y).
struct CrownShape {
  Vec3 top_m{0, 0, 1}, bottom_m{0, 0, 0};
  std::array<float, 4> radius_m{0.5f, 0.5f, 0.5f, 0.5f};  ///< of the rim on each side
  std::array<float, 4> rim_m{0.5f, 0.5f, 0.5f, 0.5f};     ///< its height there
  float shape_above = 2, shape_below = 2;                 ///< C above and below the rim
  CrownProfile profile = CrownProfile::superellipse;
};

class CrownEnvelope final : public Volume {
 public:
  /// Throws InputError unless all is finite, radii are positive, the rim lies between bottom and top, both of
  /// these within the rim as seen from above, and shapes in 0.1 … 100.
  explicit CrownEnvelope(const CrownShape& shape);

  bool contains(Vec3 point_m) const override { return outside(point_m.x, point_m.y, point_m.z) <= 0; }
  float signed_distance_m(Vec3 point_m) const override;
  bool surely_contains_ball(Vec3 center_m, float radius_m) const override;
  VolumeSize size() const override { return {10, 1}; }

  /// From a point along a unit vector to where the envelope is left for the first time; 0 for a ray that is
  /// nowhere inside. A ray from outside that passes through less than an eighth of its way may be taken for
  /// one.
  float reach_m(Vec3 from_m, Vec3 direction) const;

  /// Whether the point is within the rim as seen from above, and not above the crown.
  bool is_under_top(Vec3 point_m) const { return level(top_, point_m.x, point_m.y, point_m.z) <= 1; }

  struct Heights {
    double lower_m, upper_m;
  };
  /// Where the vertical at (x, y) enters and leaves the envelope; nothing outside of the rim.
  std::optional<Heights> heights_m(double x_m, double y_m) const;

  const CrownShape& shape() const { return shape_; }

 private:
  /// The top or the bottom, with its bulge.
  struct Apex {
    double x, y, z, exponent;
    double clearance_m = 0;  ///< to the rim, as seen from above; not more than it is
  };
  /// A quarter of the rim: part of an ellipse about the origin.
  struct Quarter {
    double sign_x, sign_y, inverse_rx2, inverse_ry2, height_x, height_y;
  };
  struct RimHit {
    double steps, height_m;  ///< how many times the vector from the point to the rim
  };

  static Apex apex(Vec3 point_m, float exponent);
  void set_quarters();
  void check_is_within_rim(const char* what, Vec3 point_m) const;
  double clearance_m(const Apex& apex) const;
  RimHit rim_hit(double x, double y, double dx, double dy) const;
  RimHit rim_beyond(const Apex& apex, double x, double y) const;
  double fall(double rho, double exponent) const;
  double level(const Apex& apex, double x, double y, double z) const;
  double height_m(const Apex& apex, const RimHit& rim) const;
  double outside(double x, double y, double z) const;
  struct Bracket;
  template <typename Function>
  std::optional<Bracket> first_exit(const Function& value_at, double end) const;
  template <typename Function>
  static double root(const Function& value_at, Bracket bracket);

  CrownShape shape_;
  std::array<Quarter, 4> quarters_;
  Apex top_, bottom_;
};

/// The names of the numbers of "crown(top = 9, radius = 3)"; "profile" is the name of one.
std::span<const std::string_view> crown_arguments();
std::span<const std::string_view> crown_profiles();

/// The crown of numbers in the order of crown_arguments(), NaN for those not given: `radius`, `rim` and
/// `shape` stand for those of all sides; without a rim it lies in the middle, without a bottom on the ground.
/// Throws InputError where top or radius is missing, and as CrownEnvelope does.
std::unique_ptr<Volume> make_crown(std::span<const float> numbers);

}  // namespace espalier
