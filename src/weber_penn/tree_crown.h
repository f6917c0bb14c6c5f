// The crown envelope of a tree: what the crown_… rows of its parameters do to its growth (docs/crowns.md).
// Metres. Source: Boudon et al. 2003, Interactive design of bonsai tree models, §3.
#pragma once
#include <optional>

#include <espalier/weber_penn/placed_crown.h>

namespace espalier {

/// The values of crown_use.
enum class CrownUse { off, cut, length, train };

/// The envelope of a tree of this scale. All values of the rows make one.
CrownShape crown_shape(const WeberPennParameters& parameters, float tree_scale_m);

/// Its inverse: sets the rows so that a tree of its mean scale has this envelope, or the nearest that they
/// can say.
void set_crown_rows(const CrownShape& crown, ParameterValues& values);

/// The length of a stem at which its tip is on the envelope: as its shape does not depend on its length, that
/// is how far the envelope reaches from its base in the direction of its tip, over how far its tip is away
/// per length. Where it splits, the first tip that meets the envelope counts. 0 where the envelope is not
/// reached; at most four times as long as the envelope reaches, however much it curls.
float length_to_crown_m(const GrowingStem& stem, const PlacedCrown& crown,
                        const WeberPennParameters& parameters);

/// Where the tip of the stem is, but for its clones.
Vec3 tip_m(const GrowingStem& stem, const WeberPennParameters& parameters);

/// Nothing where crown_use is off, or the tree has no size.
class TreeCrown {
 public:
  TreeCrown(const WeberPennParameters& parameters, float tree_scale_m);

  /// What stems are to stay in; nullptr where there is none. That of trunks goes on below the crown, where
  /// they come from.
  const Volume* volume(int level) const;
  /// That of all deeper levels.
  const Volume* of_twigs() const { return volume(2); }
  /// The envelope that gives stems of this level their lengths; nullptr where none does.
  const PlacedCrown* gives_lengths(int level) const;
  bool trains() const { return use_ == CrownUse::train; }

 private:
  /// All that is not above the crown.
  class TrunkRoom final : public Volume {
   public:
    explicit TrunkRoom(const CrownEnvelope& crown) : crown_(crown) {}
    bool contains(Vec3 point_m) const override;
    float signed_distance_m(Vec3 point_m) const override;

   private:
    CrownEnvelope crown_;
  };

  CrownUse use_ = CrownUse::off;
  std::optional<PlacedCrown> crown_;
  std::optional<TrunkRoom> trunk_room_;
};

}  // namespace espalier
