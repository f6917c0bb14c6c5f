// The volumes and fields of a file, made for a derivation: their numbers are expressions of constants.
#pragma once
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <espalier/lsystem/derivation/rule.h>

namespace espalier::lsystem {

class SurroundingsMaker {
 public:
  using Evaluate = std::function<double(BlockExpression&)>;

  explicit SurroundingsMaker(RuleContext& shared);

  /// From the next derivation on, `name` stands for `volume` (units) whatever the file says; null: as it
  /// says. Throws InputError where the file has no volume of that name.
  void replace(const std::string& name, VolumePtr volume);
  void clear();
  /// Makes the volumes and fields that come when so many constants have their values.
  void make_after(std::size_t constants, const Evaluate& evaluate);

 private:
  struct VolumeEntry {
    const VolumeDeclaration* declaration;
    std::deque<Expression> texts;
    std::vector<BlockExpression> numbers;  ///< in the order in which make_volume asks for them
    VolumePtr replaced;
  };
  struct FieldEntry {
    const FieldDeclaration* declaration;
    std::vector<BlockExpression> numbers;
  };
  VolumePtr make(VolumeEntry& entry, const Evaluate& evaluate);

  RuleContext& shared_;
  std::deque<VolumeEntry> volumes_;
  std::deque<FieldEntry> fields_;
};

}  // namespace espalier::lsystem
