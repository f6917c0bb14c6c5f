// A model: a parameter table and a pure function from (values, seed) to a plant (docs/architecture.md).
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <espalier/core/parameter_table.h>
#include <espalier/core/random.h>
#include <espalier/plant/branch_path.h>
#include <espalier/plant/leaf_sink.h>
#include <espalier/plant/plant.h>

namespace espalier {

class ChangeCursor;                  // overrides/change_graph.h
class ChangeGraph;                   // the same
enum class Quantity : std::uint8_t;  // overrides/branch_change.h
class Volume;                        // environment/volume.h
struct CrownShape;                   // environment/crown_envelope.h

/// How large a plant may get. A candidate beyond it is refused before it is grown.
struct GrowthBudget {
  double max_stems = 500'000;
  double max_leaves = 3'000'000;
};

/// One branch of a plant, with all it bears or alone.
struct PlantPart {
  BranchPath path;
  bool alone = false;
};

/// As many steps as the model has.
inline constexpr int kAllSteps = -1;

struct GrowthSettings {
  GrowthBudget budget;
  const Volume* prune_to = nullptr;      ///< replaces the parametric pruning envelope; not owned
  bool train = false;                    ///< bend stems along prune_to's border before they are cut
  const ChangeGraph* changes = nullptr;  ///< overrides of single branches; not owned
  const PlantPart* only_part =
      nullptr;  ///< grow this branch, in its place, and leave out the rest; not owned
  /// Gets the place in `changes` of each stem that is grown; nothing where there are none. Not owned.
  std::vector<ChangeCursor>* stem_cursors = nullptr;
  LeafSink* leaf_sink = nullptr;  ///< gets leaves that the plant then lacks: all, some or none; not owned
  int steps = kAllSteps;          ///< of a model that grows in steps: how many
};

/// How large the plant of these values is expected to get, without growing it.
struct GrowthEstimate {
  double stems = 0, leaves = 0;
  bool is_known = true;  ///< false where only growing the plant tells
};

/// Grown, or refused with the factor by which the worst of stems and leaves exceeds its budget.
struct GrowthResult {
  bool grown = true;
  double over_budget_factor = 0;  ///< > 1 where refused
};

/// Which paths branches of a plant can have at all.
struct BranchLimits {
  int levels = 100;
  std::uint32_t trunks = 1'000'000;
};

class Model {
 public:
  virtual ~Model() = default;
  virtual const ParameterTable& table() const = 0;
  /// Those of the user's that it was read from: the model's own first, the others in the same folder.
  virtual std::vector<std::filesystem::path> files() const { return {}; }
  /// Values that grow nearly the same silhouettes with `levels` levels of branching, which are at least as
  /// many as `values` have: what two plants of different depth are blended by. A model without levels has
  /// none to add.
  virtual ParameterValues deepened(std::span<const double> values, int levels) const {
    (void)levels;
    return {values.begin(), values.end()};
  }
  /// Whether the model follows `changes` and `only_part` of GrowthSettings, and numbers its stems.
  virtual bool has_branch_paths() const { return false; }
  /// Whether a change of this quantity has an effect: some models change branches only after they have grown.
  virtual bool can_change(Quantity) const { return has_branch_paths(); }
  /// Whether crowns of single branches give the stems on them their lengths.
  virtual bool has_branch_crowns() const { return false; }
  /// Whether a plant of these values has a crown envelope that does something.
  virtual bool uses_crown(std::span<const double> values) const {
    (void)values;
    return false;
  }
  /// Gives a plant this crown envelope, as nearly as its rows can say it. Whether it is used stays as it is.
  virtual void set_crown(const CrownShape& crown, ParameterValues& values) const {
    (void)crown, (void)values;
  }
  /// Whether the model follows `train`: it can grow into a volume.
  virtual bool can_train() const { return false; }
  virtual BranchLimits branch_limits(std::span<const double> values) const {
    (void)values;
    return {};
  }
  /// Whether the model follows `steps`.
  virtual bool grows_in_steps() const { return false; }
  /// Names of bundled presets that are trees of one trunk with fronds, the most typical one first.
  virtual std::vector<std::string> palm_presets() const { return {}; }
  virtual GrowthEstimate estimate(std::span<const double> values) const = 0;
  /// Grows into `plant`, whose memory is reused. `values` follow table(); they must be valid.
  virtual GrowthResult generate(std::span<const double> values, Seed seed, const GrowthSettings& settings,
                                Plant& plant) const = 0;
};

}  // namespace espalier
