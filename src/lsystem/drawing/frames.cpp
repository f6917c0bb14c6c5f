#include <limits>
#include <unordered_map>

#include <espalier/core/error.h>
#include <espalier/lsystem/drawing/frames.h>

namespace espalier::lsystem {

Frames::Node Frames::add_node(Node parent, Vec3 point_m) {
  parents_.push_back(parent);
  points_m_.push_back(point_m);
  return static_cast<Node>(parents_.size() - 1);
}

std::vector<Frames::Node> Frames::way_to_root(Node node) {
  std::vector<Node> way;
  for (; node >= 0; node = parents_[static_cast<std::size_t>(node)]) {
    way.push_back(node);
    work_.add(work_of::kFrameStep);
  }
  return way;
}

Frames::Corner Frames::nearest_connection(const std::vector<Node>& first,
                                          const std::vector<Node>& second) const {
  std::unordered_map<Node, std::size_t> place;
  for (std::size_t i = 0; i < second.size(); ++i) place.emplace(second[i], i);
  Corner best{first.size() - 1, second.size() - 1};
  std::size_t shortest = std::numeric_limits<std::size_t>::max();
  const auto consider = [&](std::size_t i, Node other) {
    work_.add(work_of::kFrameStep);
    const auto found = place.find(other);
    if (found == place.end() || i + found->second >= shortest) return;
    shortest = i + found->second;
    best = {i, found->second};
  };
  for (std::size_t i = 0; i < first.size() && i < shortest; ++i) {
    consider(i, first[i]);
    const auto [begin, end] = edges_.equal_range(first[i]);
    for (auto edge = begin; edge != end; ++edge) consider(i, edge->second);
  }
  return best;
}

std::vector<Vec3> Frames::close_edge(int label, Node node) {
  const auto opened = open_.find(label);
  if (opened == open_.end()) throw_input_error("got '#', expected a '?' before it");
  const Node start = opened->second;
  open_.erase(opened);
  if (start == node) return {};
  const std::vector<Node> first = way_to_root(start), second = way_to_root(node);
  const Corner corner = nearest_connection(first, second);
  std::vector<Vec3> outline;
  const auto point = [&](Node at) { return points_m_[static_cast<std::size_t>(at)]; };
  for (std::size_t i = 0; i <= corner.on_first; ++i) outline.push_back(point(first[i]));
  for (std::size_t i = corner.on_second + 1; i-- > 0;) outline.push_back(point(second[i]));
  edges_.emplace(start, node);
  edges_.emplace(node, start);
  return outline;
}

}  // namespace espalier::lsystem
