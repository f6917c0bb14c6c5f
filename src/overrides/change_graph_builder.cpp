// Makes the graph: from each of its nodes, children are told apart by where their index and their position
// lie among the ends of all ranges, as a finite automaton is made from several (Hopcroft, Motwani and Ullman,
// Introduction to Automata Theory, §2.3: the subset construction), so that a step of a stem is one lookup.
#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include <espalier/core/error.h>
#include <espalier/overrides/change_graph.h>

namespace espalier {

namespace {

/// Beyond the single branches that are named.
constexpr std::size_t kMostCombinations = 100'000;

void apply_to(const Override& entry, BranchChange& change) {
  const auto number = static_cast<float>(entry.number);
  if (entry.quantity == Quantity::seed)
    change.seed = static_cast<std::uint64_t>(entry.number);
  else if (entry.quantity == Quantity::removed)
    change.removed = entry.number != 0;
  else
    change[entry.quantity] = combined(change[entry.quantity], modification(entry.relation, number));
}

bool changes_anything(const BranchChange& change) {
  return !std::all_of(change.modifications.begin(), change.modifications.end(),
                      [](const Modification& m) { return m.changes_nothing(); });
}

/// A seed renews all that lies below its branch, and what is removed has nothing below it.
bool is_inherited(const Override& entry) {
  return !entry.is_private && entry.quantity != Quantity::seed && entry.quantity != Quantity::removed;
}

template <typename T>
void sort_and_keep_one(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

class ChangeGraphBuilder {
 public:
  ChangeGraphBuilder(const Overrides& overrides, ChangeGraph& graph)
      : overrides_(overrides), graph_(graph), most_nodes_(kMostCombinations) {
    sets_.reserve(overrides.nodes.size() + overrides.ranges.size());
    for (const OverrideNode& node : overrides.nodes) {
      sets_.push_back(resolved(node.set, overrides));
      most_nodes_ += node.path.size();
    }
    for (const RangeNode& node : overrides.ranges) sets_.push_back(resolved(node.set, overrides));
  }

  void build() {
    Matches all{0, overrides_.nodes.size(), {}};
    for (std::uint32_t i = 0; i < overrides_.ranges.size(); ++i) all.ranges.push_back(i);
    graph_.nodes_.emplace_back();
    add_children(0, -1, 0, -1, all);
  }

 private:
  /// What one set of the file amounts to.
  struct ResolvedSet {
    std::vector<Override> overrides;
    std::vector<RowOverride> rows;
    std::optional<StemAxis> axis;
    std::optional<BranchCrown> crown;
    std::optional<bool> is_locked;
  };

  /// Which nodes of the file are of some branches, or of what lies below them.
  struct Matches {
    std::size_t first_path = 0, end_path = 0;  ///< these of Overrides::nodes
    std::vector<std::uint32_t> ranges;         ///< in the order of files

    bool empty() const { return first_path == end_path && ranges.empty(); }
    bool operator<(const Matches& other) const {
      return std::tie(first_path, end_path, ranges) <
             std::tie(other.first_path, other.end_path, other.ranges);
    }
  };

  static ResolvedSet resolved(const OverrideSet& set, const Overrides& overrides) {
    ResolvedSet result{resolved_overrides(set, overrides), resolved_rows(set, overrides), std::nullopt,
                       resolved_crown(set, overrides), resolved_lock(set, overrides)};
    if (const DrawnAxis* axis = resolved_axis(set, overrides))
      result.axis = StemAxis{make_axis(axis->points), axis->frame};
    return result;
  }

  [[noreturn]] static void fail_as_too_many() {
    throw_input_error("overrides: got ranges of branches that meet in more than {} ways, expected fewer",
                      kMostCombinations);
  }

  const BranchPath& path(std::size_t i) const { return overrides_.nodes[i].path; }
  const BranchPattern& pattern(std::uint32_t i) const { return overrides_.ranges[i].pattern; }

  ChangeGraph::Node& node(std::int32_t index) { return graph_.nodes_[static_cast<std::size_t>(index)]; }

  /// The nodes below `index`, whose path has `depth` parts and is of this level.
  void add_children(std::int32_t index, std::int32_t inherits, std::size_t depth, int level,
                    const Matches& matches) {
    const std::vector<std::uint32_t> firsts = first_indices(depth, matches);
    const std::vector<float> positions = first_positions(depth, matches);
    if (firsts.size() * (positions.size() + 1) > most_nodes_ + 2 * overrides_.nodes.size())
      fail_as_too_many();
    std::vector<std::int32_t> children;
    std::map<Matches, std::int32_t> made;
    children.reserve(firsts.size() * (positions.size() + 1));
    for (const std::uint32_t first : firsts)
      for (std::size_t column = 0; column <= positions.size(); ++column) {
        const float position = column == 0 ? -std::numeric_limits<float>::infinity() : positions[column - 1];
        const Matches of_child = narrowed(depth, matches, first, position);
        if (of_child.empty()) {
          children.push_back(-1);
          continue;
        }
        const auto [place, is_new] =
            made.try_emplace(of_child, static_cast<std::int32_t>(graph_.nodes_.size()));
        if (is_new) add_node(index, inherits, depth + 1, level + (first < kFirstSplit), first, of_child);
        children.push_back(place->second);
      }
    node(index).first_index = firsts;
    node(index).first_position = positions;
    node(index).children = std::move(children);
  }

  std::vector<std::uint32_t> first_indices(std::size_t depth, const Matches& matches) const {
    std::vector<std::uint32_t> firsts;
    for (std::size_t i = matches.first_path; i < matches.end_path; ++i)
      if (path(i).size() > depth) firsts.insert(firsts.end(), {path(i)[depth], path(i)[depth] + 1});
    for (const std::uint32_t range : matches.ranges) {
      if (pattern(range).size() <= depth) continue;
      const PatternPart& part = pattern(range)[depth];
      const bool has_indices = part.kind == PatternPart::Kind::one || part.kind == PatternPart::Kind::indices;
      firsts.push_back(has_indices ? part.first : 0);
      firsts.push_back(has_indices ? part.last + 1 : kFirstSplit);
    }
    sort_and_keep_one(firsts);
    return firsts;
  }

  std::vector<float> first_positions(std::size_t depth, const Matches& matches) const {
    std::vector<float> positions;
    for (const std::uint32_t range : matches.ranges) {
      if (pattern(range).size() <= depth || pattern(range)[depth].kind != PatternPart::Kind::positions)
        continue;
      positions.push_back(pattern(range)[depth].lower);
      if (pattern(range)[depth].upper < 1) positions.push_back(pattern(range)[depth].upper);
    }
    sort_and_keep_one(positions);
    return positions;
  }

  /// Those that are of a child with this index and position.
  Matches narrowed(std::size_t depth, const Matches& matches, std::uint32_t index, float position) const {
    Matches result;
    const auto nodes = overrides_.nodes.begin();
    const auto begin = nodes + static_cast<std::ptrdiff_t>(matches.first_path),
               end = nodes + static_cast<std::ptrdiff_t>(matches.end_path);
    const auto is_before = [&](const OverrideNode& each, std::uint32_t first) {
      return each.path.size() <= depth || each.path[depth] < first;
    };
    const auto first = std::lower_bound(begin, end, index, is_before),
               last = std::lower_bound(first, end, index + 1, is_before);
    if (first != last) {
      result.first_path = static_cast<std::size_t>(first - nodes);
      result.end_path = static_cast<std::size_t>(last - nodes);
    }
    for (const std::uint32_t range : matches.ranges)
      if (pattern(range).size() > depth && pattern(range)[depth].means(index, position))
        result.ranges.push_back(range);
    return result;
  }

  void add_node(std::int32_t parent, std::int32_t inherits, std::size_t depth, int level, std::uint32_t part,
                const Matches& matches) {
    const auto index = static_cast<std::int32_t>(graph_.nodes_.size());
    if (graph_.nodes_.size() > most_nodes_) fail_as_too_many();
    graph_.nodes_.emplace_back();
    node(index).said_by = said_by(depth, matches);
    combine(index, inherits, parent, level, part >= kFirstSplit);
    add_children(index, node(index).hands_on ? index : -1, depth, level, matches);
  }

  /// The nodes of a path of `depth` parts, the weakest first.
  std::vector<std::uint32_t> said_by(std::size_t depth, const Matches& matches) const {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t range : matches.ranges)
      if (pattern(range).size() == depth) nodes.push_back(range);
    std::stable_sort(nodes.begin(), nodes.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return is_weaker(pattern(a), pattern(b)); });
    for (std::uint32_t& range : nodes) range += static_cast<std::uint32_t>(overrides_.nodes.size());
    if (matches.first_path < matches.end_path && path(matches.first_path).size() == depth)
      nodes.push_back(static_cast<std::uint32_t>(matches.first_path));
    return nodes;
  }

  /// What is inherited, and then what its nodes say in turn.
  void combine(std::int32_t index, std::int32_t inherits, std::int32_t parent, int level, bool is_split) {
    ChangeGraph::Node& made = node(index);
    if (inherits >= 0) {
      made.change = made.handed_on = node(inherits).handed_on;
      made.is_locked = node(inherits).is_locked;
    }
    // A stem that splits off has what its stem has, also what is private to that: they are one axis.
    BranchRows rows{{}, is_split, is_split ? node(parent).rows : -1, level};
    BranchRows handed_on{{}, false, -1, level};
    const std::int32_t rows_before = is_split ? node(parent).rows : node(parent).rows_handed_on;
    if (rows_before >= 0) rows.changes = graph_.rows_[static_cast<std::size_t>(rows_before)].changes;
    if (const std::int32_t before = node(parent).rows_handed_on; before >= 0)
      handed_on.changes = graph_.rows_[static_cast<std::size_t>(before)].changes;
    bool has_rows = false, hands_rows_on = false;
    for (const std::uint32_t each : made.said_by) {
      const ResolvedSet& set = sets_[each];
      for (const Override& entry : set.overrides) {
        apply_to(entry, made.own);
        apply_to(entry, made.change);
        if (is_inherited(entry)) apply_to(entry, made.handed_on);
      }
      for (const RowOverride& entry : set.rows) {
        apply(entry, rows.changes);
        has_rows = true;
        if (!entry.is_private) apply(entry, handed_on.changes), hands_rows_on = true;
      }
      if (set.axis) made.axis = set.axis;
      if (set.crown) made.crown = set.crown;
      if (set.is_locked) made.is_locked = *set.is_locked;
    }
    made.rows = has_rows ? add_rows(std::move(rows)) : rows_before;
    made.rows_handed_on = hands_rows_on ? add_rows(std::move(handed_on)) : node(parent).rows_handed_on;
    made.hands_on = changes_anything(made.handed_on) || made.rows_handed_on >= 0 || made.is_locked;
  }

  std::int32_t add_rows(BranchRows rows) {
    graph_.rows_.push_back(std::move(rows));
    return static_cast<std::int32_t>(graph_.rows_.size()) - 1;
  }

  const Overrides& overrides_;
  ChangeGraph& graph_;
  std::size_t most_nodes_;
  std::vector<ResolvedSet> sets_;  ///< of nodes, then of ranges
};

ChangeGraph::ChangeGraph(const Overrides& overrides) { ChangeGraphBuilder(overrides, *this).build(); }

}  // namespace espalier
