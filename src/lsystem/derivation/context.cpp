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

std::size_t StringIndex::previous(std::size_t i) const {
  while (i > 0) {
    --i;
    if (symbols_[i] == close_)
      i = partner_[i];
    else if (symbols_[i] != open_ && !skipped_[symbols_[i]])
      return i;
  }
  return kNone;
}

bool StringIndex::match_path(std::size_t i, std::span<const PatternModule> pattern,
                             std::uint32_t* matched) const {
  for (std::size_t k = pattern.size(); k-- > 0;) {
    i = previous(i);
    if (i == kNone || symbols_[i] != pattern[k].symbol) return false;
    matched[k] = static_cast<std::uint32_t>(i);
  }
  return true;
}

bool StringIndex::match_from(std::size_t at, std::span<const PatternModule> pattern,
                             std::uint32_t* matched) const {
  if (pattern.empty()) return true;
  if (pattern[0].symbol == open_) return match_branch(at, pattern, matched);
  if (pattern[0].symbol == close_) return match_end(at, pattern, matched);
  return match_module(at, pattern, matched);
}

/// The pattern goes on in a branch: the first one here that it fits.
bool StringIndex::match_branch(std::size_t at, std::span<const PatternModule> pattern,
                               std::uint32_t* matched) const {
  for (; at < size_; ++at) {
    if (symbols_[at] == open_) {
      if (match_from(at + 1, pattern.subspan(1), matched + 1)) return true;
      at = partner_[at];
    } else if (symbols_[at] == close_ || !skipped_[symbols_[at]]) {
      return false;
    }
  }
  return false;
}

/// The pattern leaves its branch; what else is in it does not matter.
bool StringIndex::match_end(std::size_t at, std::span<const PatternModule> pattern,
                            std::uint32_t* matched) const {
  for (; at < size_; ++at) {
    if (symbols_[at] == open_)
      at = partner_[at];
    else if (symbols_[at] == close_)
      return match_from(at + 1, pattern.subspan(1), matched + 1);
  }
  return false;
}

bool StringIndex::match_module(std::size_t at, std::span<const PatternModule> pattern,
                               std::uint32_t* matched) const {
  const std::size_t start = at;
  for (; at < size_ && symbols_[at] != close_; ++at) {
    if (symbols_[at] == open_) {
      at = partner_[at];
    } else if (!skipped_[symbols_[at]]) {
      if (symbols_[at] != pattern[0].symbol) break;
      matched[0] = static_cast<std::uint32_t>(at);
      if (match_from(at + 1, pattern.subspan(1), matched + 1)) return true;
      break;
    }
  }
  return follow_branches_ && follow(start, at, pattern, matched);
}

/// The pattern goes on in one of the branches between two places of an axis.
bool StringIndex::follow(std::size_t begin, std::size_t end, std::span<const PatternModule> pattern,
                         std::uint32_t* matched) const {
  for (std::size_t i = begin; i < end; ++i) {
    if (symbols_[i] != open_) continue;
    if (match_module(i + 1, pattern, matched)) return true;
    i = partner_[i];
  }
  return false;
}

}  // namespace espalier::lsystem
