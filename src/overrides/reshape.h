// Overrides of branches for models that grow without looking at them: the plant is grown once, then single
// stems are turned, moved, bent, lengthened, thickened or taken away, and all they bear rides along
// [Boudon et al. 2003, §2.2: a change of a component acts on the geometry of all components above it].
// What a quantity is, where the model did not say, is measured:
//   length          of the stem's curve, m
//   position        of its base along its origin's curve, 0 to 1
//   down_angle      between its first direction and its origin's there (of trunks: the vertical), degrees
//   rotation        about its origin's direction, from the right of the front view where that direction is
//                   upright, else from its upper side, degrees
//   curvature       between its first and last direction, away from its origin; curvature_back: from its
//                   middle on, degrees
//   radius          at the base, or the largest where that is 0, m
//   child_count     of the stems, and of the leaves, on it: the first ones stay, none are added
//   axis            of the stem's own frame as defined above: z along its first direction, y away from its
//   origin;
//                   of trunks, and of the world's axes, that of the front view. The stem keeps its knots.
// A seed changes nothing: the plant is not grown anew.
#pragma once
#include <optional>

#include <espalier/overrides/change_graph.h>
#include <espalier/overrides/groups.h>
#include <espalier/overrides/stem_measures.h>
#include <espalier/overrides/turn.h>
#include <espalier/plant/joints.h>
#include <espalier/plant/model.h>

namespace espalier {

/// Gives one plant many shapes. A stem's origin comes before it in the plant, and child indices count from 0.
/// Not for several threads at a time: it keeps memory from one shape to the next.
class Reshaper {
 public:
  explicit Reshaper(JointedPlant plant);

  /// The plant with these changes (null: none), or the part of it alone, in its place, into `shaped`, whose
  /// memory is reused. Stems keep their order, leaves of a whole plant too; what neither changes itself nor
  /// stands on what does keeps its bits. Leaves that hang on no stem go with trunk 0 where a part is asked
  /// for. Throws InputError where the changes make the plant too large for floats. `stem_cursors` gets the
  /// place in the graph of each stem that is left; null: nobody asks.
  void reshape(const ChangeGraph* changes, const PlantPart* only_part, Plant& shaped,
               std::vector<ChangeCursor>* stem_cursors = nullptr);

 private:
  /// What becomes of a stem.
  struct Shape {
    ChangeCursor cursor;
    bool is_gone = false, moves = false;
    std::uint32_t most_stems = kAll, most_organs = kAll;  ///< it keeps
    float radius_factor = 1;
    Turn turn;  ///< of its base
    Vec3 bend_axis;
    float bend_deg = 0, bend_back_deg = 0;

    const StemAxis* axis = nullptr;  ///< it follows
    std::optional<AxisArcs> axis_arcs;
    Turn axis_frame;  ///< from what is drawn to the world

    bool bends() const { return bend_deg != 0 || bend_back_deg != 0; }
    Turn turn_at(float fraction) const;
  };
  static constexpr std::uint32_t kAll = 0xffffffff;

  /// Where a stem stands on its origin and how it is turned there, before its own change.
  struct Stand {
    Vec3 base_m, direction;  ///< the origin's direction, both as the plant was grown
    Vec3 new_base_m;
    Turn turn;
  };

  void choose(const PlantPart* only_part);
  void choose_all_on_chosen();
  void shape_stem(std::uint32_t stem, const ChangeGraph* changes);
  float position_of(std::uint32_t stem) const;
  Stand stand_of(std::uint32_t stem, const BranchChange* change) const;
  bool change_length(std::uint32_t stem, const BranchChange& change, float& factor) const;
  void change_direction(std::uint32_t stem, const BranchChange& change, const Stand& stand,
                        Shape& shape) const;
  void change_numbers(std::uint32_t stem, const BranchChange& change, Shape& shape) const;
  void set_axis(std::uint32_t stem, const Stand& stand, Shape& shape) const;
  Turn turn_along(std::uint32_t stem, const Shape& shape, float fraction) const;
  void draw_knots(std::uint32_t stem, const Shape& shape, Vec3 base_m, float factor);
  void move_knots(std::uint32_t stem, const Shape& shape, Vec3 base_m, float factor);
  const Knots& knots_of(std::uint32_t stem) const { return shapes_[stem].moves ? moved_ : base_.plant.knots; }

  bool is_borne(std::uint32_t organ) const;
  void choose_leaves(const PlantPart* only_part);
  void choose_leaves_on(std::int32_t stem);
  void write_stem(std::uint32_t stem, Plant& shaped);
  void write_leaf(std::uint32_t leaf, Plant& shaped) const;

  JointedPlant base_;
  ArcLengths arcs_;
  Groups stems_on_, organs_on_, leaves_of_;
  std::vector<std::uint32_t> organ_rank_;  ///< among those of its stem
  std::vector<Shape> shapes_;              ///< of the stems that were chosen last
  Knots moved_;                            ///< those of stems that move, numbered as the plant's
  std::vector<std::uint32_t> way_, chosen_, chosen_leaves_;
  std::vector<std::int32_t> written_as_;
};

}  // namespace espalier
