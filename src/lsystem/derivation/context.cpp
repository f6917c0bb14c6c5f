#include <espalier/lsystem/derivation/context.h>

namespace espalier::lsystem {

void StringIndex::build(const ModuleString& string, const SymbolTable& alphabet, SymbolId open,
                        SymbolId close, std::span<const std::uint8_t> skipped, bool follow_branches) {
  symbols_ = string.symbols.data();
  size_ = string.size();
  open_ = open;
  close_ = close;
  skipped_ = skipped;
  follow_branches_ = follow_branches;
  value_offset_.clear();
  partner_.clear();
  opened_.clear();
  std::uint32_t* offsets = value_offset_.grow(size_);
  std::uint32_t* partners = partner_.grow(size_);
  const std::uint8_t* arities = alphabet.arities().data();
  std::uint32_t offset = 0;
  for (std::uint32_t i = 0; i < size_; ++i) {
    offsets[i] = offset;
    offset += arities[symbols_[i]];
    if (symbols_[i] == open) {
      opened_.push_back(i);
    } else if (symbols_[i] == close) {  // strings are balanced: their pieces are
      partners[i] = opened_.back();
      partners[opened_.back()] = i;
      opened_.pop_back();
    }
  }
}

std::size_t StringIndex::previous(std::size_t i, Work& work) const {
  std::size_t steps = 0, found = kNone;
  while (i > 0 && found == kNone) {
    --i;
    ++steps;
    if (symbols_[i] == close_)
      i = partner_[i];
    else if (symbols_[i] != open_ && !skipped_[symbols_[i]])
      found = i;
  }
  work.add(work_of::kContextStep * static_cast<double>(steps));
  return found;
}

bool StringIndex::match_path(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched,
                             Work& work) const {
  for (std::size_t k = pattern.size(); k-- > 0;) {
    i = previous(i, work);
    if (i == kNone || symbols_[i] != pattern[k].symbol) return false;
    matched[k] = static_cast<std::uint32_t>(i);
  }
  return true;
}

/// The next module of the axis that a context cannot look past, or the end of its branch.
std::size_t StringIndex::end_of_axis(std::size_t at, std::size_t& steps) const {
  ++steps;
  for (; at < size_ && !is_plain(at) && symbols_[at] != close_; ++at, ++steps)
    if (symbols_[at] == open_) at = partner_[at];
  return at;
}

std::size_t StringIndex::end_of_branch(std::size_t at, std::size_t& steps) const {
  ++steps;
  for (; at < size_ && symbols_[at] != close_; ++at, ++steps)
    if (symbols_[at] == open_) at = partner_[at];
  return at;
}

/// The first branch that opens in [begin, end) of an axis, or the end.
std::size_t StringIndex::next_branch(std::size_t begin, std::size_t end, std::size_t& steps) const {
  const std::size_t first = begin;
  while (begin < end && symbols_[begin] != open_) ++begin;
  steps += begin - first + 1;
  return begin;
}

/// A search in depth, whose choices lie on a stack of their own: strings may be nested deeper than calls. A
/// bracket in the pattern goes on in the first branch that fits, its end behind the branch that it is in,
/// whatever else is there; a module is the next one of the axis, or, where branches are followed, of one of
/// the branches before that. With them the search may take exponentially many steps, which are work.
bool StringIndex::match_tree(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched,
                             Work& work) const {
  choices_.clear();
  std::size_t k = 0, steps = 1;
  for (;;) {
    bool fits = true;
    if (pattern[k].symbol == open_) {
      choices_.push_back({k, at, end_of_axis(at, steps)});
      fits = false;  // its first branch is the first choice
    } else if (pattern[k].symbol == close_) {
      at = end_of_branch(at, steps) + 1;
      fits = at <= size_;
    } else {
      ++steps;
      const std::size_t next = at < size_ && is_plain(at) ? at : end_of_axis(at, steps);
      fits = next < size_ && symbols_[next] == pattern[k].symbol;
      matched[k] = static_cast<std::uint32_t>(next);
      const bool is_last = fits && k + 1 == pattern.size();
      if (follow_branches_ && next > at && !is_last) choices_.push_back({k, at, next});
      at = next + 1;
    }
    if (fits) {
      if (++k < pattern.size()) continue;
      work.add(work_of::kContextStep * static_cast<double>(steps));
      return true;
    }
    work.add(work_of::kContextStep * static_cast<double>(steps));
    steps = 0;
    std::size_t branch = 0;
    for (;;) {
      if (choices_.empty()) return false;
      Choice& choice = choices_.back();
      branch = next_branch(choice.begin, choice.end, steps);
      k = choice.pattern;
      if (branch < choice.end) {
        choice.begin = partner_[branch] + 1;
        break;
      }
      choices_.pop_back();
    }
    at = branch + 1;
    if (pattern[k].symbol == open_ && ++k == pattern.size()) return true;
  }
}

}  // namespace espalier::lsystem
