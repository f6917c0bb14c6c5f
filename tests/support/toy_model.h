// A second model: Weber and Penn's trees under other names, in another order, each parameter without a level.
// What bears roles is the same, so whoever asks a table for roles must treat both alike.
#pragma once
#include <string>
#include <vector>

#include <espalier/models/models.h>
#include <espalier/plant/model.h>

namespace espalier {

class ToyModel : public Model {
 public:
  ToyModel() : table_{"toy", {original().table().rows.rbegin(), original().table().rows.rend()}} {
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      ParameterInfo& row = table_.rows[i];
      row.name = "knob_" + std::to_string(i);
      row.level = row.point = -1;
      row.needs.clear();
      row.mixed_with = row.mixed_by = "";
    }
  }

  static const Model& original() { return model_by_name("weber_penn"); }
  /// The same tree in the order of the other model.
  static ParameterValues translated(std::span<const double> values) {
    return {values.rbegin(), values.rend()};
  }
  /// What the toy calls a parameter of the original.
  std::string name_of(const std::string& original_name) const {
    return table_.rows[table_.rows.size() - 1 - original().table().index_of(original_name)].full_name();
  }

  const ParameterTable& table() const override { return table_; }
  bool has_branch_paths() const override { return true; }
  GrowthEstimate estimate(std::span<const double> values) const override {
    return original().estimate(translated(values));
  }
  GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                        Plant& plant) const override {
    return original().generate(translated(values), seed, settings, plant);
  }

 private:
  ParameterTable table_;
};

/// The same without roles: a model that fits know nothing of.
class ToyWithoutRoles : public ToyModel {
 public:
  ToyWithoutRoles() : table_(ToyModel::table()) {
    for (ParameterInfo& row : table_.rows) row.role = {};
  }
  const ParameterTable& table() const override { return table_; }

 private:
  ParameterTable table_;
};

}  // namespace espalier
