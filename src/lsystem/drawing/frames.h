// Surfaces on frames of axes [Herbaceous §6, Fig. 19]: ? and # mark the two ends of an edge that is inserted
// between nodes of the drawn tree. The edge and the segments between its ends bound a polygon; where an edge
// before it already connects the two axes, the polygon ends there: a web of edges has a quadrilateral between
// each two. A mark may have a number, so that several edges are open at a time.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include <espalier/core/vec3.h>
#include <espalier/lsystem/strings/work.h>

namespace espalier::lsystem {

class Frames {
 public:
  explicit Frames(Work& work) : work_(work) {}

  using Node = std::int32_t;  ///< -1: none

  /// A node at the end of a segment or a move from `parent`.
  Node add_node(Node parent, Vec3 point_m);
  /// ?(label): the next edge of this label starts here.
  void open_edge(int label, Node node) { open_[label] = node; }
  /// #(label): inserts the edge to `node`; the outline of its polygon, which is empty for an edge without
  /// length. Throws InputError where no edge is open.
  std::vector<Vec3> close_edge(int label, Node node);

 private:
  /// How far along its two axes a polygon goes: to the nodes of an edge, or to one they share.
  struct Corner {
    std::size_t on_first = 0, on_second = 0;
  };

  std::vector<Node> way_to_root(Node node);
  Corner nearest_connection(const std::vector<Node>& first, const std::vector<Node>& second) const;

  std::vector<Node> parents_;
  std::vector<Vec3> points_m_;
  std::map<int, Node> open_;
  std::multimap<Node, Node> edges_;  ///< both ways
  Work& work_;
};

}  // namespace espalier::lsystem
