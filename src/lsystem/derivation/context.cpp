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
  while (i > 0) {
    --i;
    work.add(work_of::kContextStep);
    if (symbols_[i] == close_)
      i = partner_[i];
    else if (symbols_[i] != open_ && !skipped_[symbols_[i]])
      return i;
  }
  return kNone;
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
std::size_t StringIndex::end_of_axis(std::size_t at, Work& work) const {
  for (; at < size_ && !is_plain(at) && symbols_[at] != close_; ++at) {
    work.add(work_of::kContextStep);
    if (symbols_[at] == open_) at = partner_[at];
  }
  return at;
}

std::size_t StringIndex::end_of_branch(std::size_t at, Work& work) const {
  for (; at < size_ && symbols_[at] != close_; ++at) {
    work.add(work_of::kContextStep);
    if (symbols_[at] == open_) at = partner_[at];
  }
  return at;
}

/// The first branch that opens in [begin, end) of an axis, or the end.
std::size_t StringIndex::next_branch(std::size_t begin, std::size_t end, Work& work) const {
  for (; begin < end && symbols_[begin] != open_; ++begin) work.add(work_of::kContextStep);
  return begin;
}

/// A search in depth, whose choices lie on a stack of their own: strings may be nested deeper than calls. A
/// bracket in the pattern goes on in the first branch that fits, its end behind the branch that it is in,
/// whatever else is there; a module is the next one of the axis, or, where branches are followed, of one of
/// the branches before that. With them the search may take exponentially many steps, which are work.
bool StringIndex::match_tree(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched,
                             Work& work) const {
  choices_.clear();
  std::size_t k = 0;
  for (;;) {
    work.add(work_of::kContextStep);
    bool fits = true;
    if (pattern[k].symbol == open_) {
      choices_.push_back({k, at, end_of_axis(at, work)});
      fits = false;  // its first branch is the first choice
    } else if (pattern[k].symbol == close_) {
      at = end_of_branch(at, work) + 1;
      fits = at <= size_;
    } else {
      const std::size_t next = end_of_axis(at, work);
      if (follow_branches_ && next > at) choices_.push_back({k, at, next});
      fits = next < size_ && symbols_[next] == pattern[k].symbol;
      matched[k] = static_cast<std::uint32_t>(next);
      at = next + 1;
    }
    if (fits) {
      if (++k == pattern.size()) return true;
      continue;
    }
    std::size_t branch = 0;
    for (;;) {
      if (choices_.empty()) return false;
      Choice& choice = choices_.back();
      work.add(work_of::kContextStep);
      branch = next_branch(choice.begin, choice.end, work);
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
