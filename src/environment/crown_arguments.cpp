// A crown from the numbers that a text names, see make_crown in crown_envelope.h.
#include <algorithm>
#include <cmath>

#include <espalier/core/error.h>
#include <espalier/environment/crown_envelope.h>

namespace espalier {

namespace {

constexpr std::array<std::string_view, 20> kArguments{
    "top",          "top_x",       "top_y",       "bottom",       "bottom_x",    "bottom_y",  "radius",
    "radius_right", "radius_back", "radius_left", "radius_front", "rim",         "rim_right", "rim_back",
    "rim_left",     "rim_front",   "shape",       "shape_above",  "shape_below", "profile"};
constexpr std::array<std::string_view, 2> kProfiles{"superellipse", "power"};

/// Numbers by name.
class Given {
 public:
  explicit Given(std::span<const float> numbers) : numbers_(numbers) {
    ESPALIER_CHECK_EQ(numbers.size(), kArguments.size());
  }
  float at(std::string_view name, float otherwise) const {
    const auto found = std::find(kArguments.begin(), kArguments.end(), name);
    const float number = numbers_[static_cast<std::size_t>(found - kArguments.begin())];
    return std::isnan(number) ? otherwise : number;
  }
  /// Those that are called `name` and a side.
  std::array<float, 4> sides(const std::string& name, float otherwise) const {
    const float all = at(name, otherwise);
    return {at(name + "_right", all), at(name + "_back", all), at(name + "_left", all),
            at(name + "_front", all)};
  }

 private:
  std::span<const float> numbers_;
};

}  // namespace

std::span<const std::string_view> crown_arguments() { return kArguments; }
std::span<const std::string_view> crown_profiles() { return kProfiles; }

std::unique_ptr<Volume> make_crown(std::span<const float> numbers) {
  const Given given(numbers);
  CrownShape crown;
  crown.top_m = {given.at("top_x", 0), given.at("top_y", 0), given.at("top", NAN)};
  if (std::isnan(crown.top_m.z))
    throw_input_error("crown: got no top, expected one, as in crown(top = 9, radius = 3)");
  crown.bottom_m = {given.at("bottom_x", 0), given.at("bottom_y", 0), given.at("bottom", 0)};
  crown.radius_m = given.sides("radius", NAN);
  for (const float radius_m : crown.radius_m)
    if (std::isnan(radius_m))
      throw_input_error("crown: got no radius of some side, expected 'radius', or one for each side");
  crown.rim_m = given.sides("rim", (crown.top_m.z + crown.bottom_m.z) / 2);
  const float shape = given.at("shape", 2);
  crown.shape_above = given.at("shape_above", shape);
  crown.shape_below = given.at("shape_below", shape);
  crown.profile = given.at("profile", 0) == 1 ? CrownProfile::power : CrownProfile::superellipse;
  return std::make_unique<CrownEnvelope>(crown);
}

}  // namespace espalier
