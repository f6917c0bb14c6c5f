#include <espalier/overrides/branch_crown.h>

namespace espalier {

std::vector<BranchCrownNumber> numbers_of(BranchCrown& crown) {
  constexpr std::array kSides{"right", "up", "left", "down"};
  std::vector<BranchCrownNumber> numbers;
  numbers.reserve(2 * kSides.size() + 2);
  for (std::size_t side = 0; side < kSides.size(); ++side)
    numbers.push_back({std::string("radius_") + kSides[side], &crown.radius[side], 0.001f, 10});
  for (std::size_t side = 0; side < kSides.size(); ++side)
    numbers.push_back({std::string("rim_") + kSides[side], &crown.rim[side], 0, 1});
  numbers.push_back({"shape_tip", &crown.shape_tip, 0.1f, 100});
  numbers.push_back({"shape_base", &crown.shape_base, 0.1f, 100});
  return numbers;
}

std::vector<std::string> names_of_several() { return {"radius", "rim", "shape"}; }

}  // namespace espalier
