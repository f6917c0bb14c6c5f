// Overrides by path: a sparse decomposition graph over a plant. A node names a branch by its path and
// overrides what the model would give it: absolute values, or factors and offsets of what it inherits. What a
// node overrides holds for everything below it too, unless it is private; nodes may share one set of
// overrides by name. A node whose branch does not grow is dormant: it is kept, and acts again when the branch
// returns, which paths that count from the base make likely [Boudon et al. 2003, §2.1, §4, Fig. 10].
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <espalier/overrides/branch_change.h>
#include <espalier/overrides/branch_crown.h>
#include <espalier/overrides/branch_pattern.h>
#include <espalier/overrides/drawn_axis.h>
#include <espalier/overrides/parameter_override.h>
#include <espalier/plant/branch_path.h>

namespace espalier {

struct Override {
  Quantity quantity = Quantity::length;
  Relation relation = Relation::value;
  double number = 0;
  bool is_private = false;  ///< not inherited by the branches below
};

/// What one node says, or several that share it.
struct OverrideSet {
  std::string shares;                         ///< name of a shared set that comes first; empty: none
  std::vector<Override> overrides;            ///< by quantity, each once (set_override)
  std::vector<ParameterOverride> parameters;  ///< of the model, by key, each once (set_parameter)
  std::optional<DrawnAxis> axis;
  std::optional<BranchCrown> crown;
  std::optional<bool> is_locked;  ///< whether fits leave the branch, and all on it, as it is

  bool empty() const {
    return shares.empty() && overrides.empty() && parameters.empty() && !axis && !crown && !is_locked;
  }
};

struct OverrideNode {
  BranchPath path;
  OverrideSet set;
};

/// A node of several branches.
struct RangeNode {
  BranchPattern pattern;
  OverrideSet set;
};

struct Overrides {
  std::vector<OverrideNode> nodes;            ///< by path, each once
  std::vector<RangeNode> ranges;              ///< in the order of files, each pattern once
  std::map<std::string, OverrideSet> shared;  ///< by name

  bool empty() const { return nodes.empty() && ranges.empty(); }
  /// The set of this pattern, made where there is none.
  OverrideSet& set_of(const BranchPattern& pattern);
  /// The node of this path, made where there is none.
  OverrideNode& at(const BranchPath& path);
  const OverrideNode* find(const BranchPath& path) const;
};

/// "length", "down_angle", ….
const char* quantity_name(Quantity quantity);
std::vector<std::string> quantity_names();

/// Throws InputError, opening with `where`, where a number is no valid one for its quantity, or a quantity
/// cannot be overridden that way: a factor of a seed, a trunk's position.
void check_override(const Override& entry, const BranchPattern& pattern, const std::string& where);

/// Sets what `set` says of this quantity, replacing what it said before.
void set_override(OverrideSet& set, const Override& entry);
/// The same of a key of the model's.
void set_parameter(OverrideSet& set, const ParameterOverride& entry);

}  // namespace espalier
