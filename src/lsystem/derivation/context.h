// Contexts in bracketed strings. The left context of a module is the path to the root; the right context is
// a tree, written with brackets; branches between are skipped [Herbaceous §2.3, ABOP p. 32: BC < S > G[HI]M
// matches S in ABC[DE][SG[HI[JK]L]MNO]]. A file may ask for branches to be followed too: where the axis does
// not match, the branches before that place are tried. Without it no signal would leave the branch whose
// pruning sent it [Topiary, L-systems 4 and 6].
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/lsystem/notation/grammar.h>
#include <espalier/lsystem/strings/module_string.h>
#include <espalier/lsystem/strings/work.h>

namespace espalier::lsystem {

/// A string with what contexts need: where each module's parameters start, and each bracket's partner.
class StringIndex {
 public:
  /// `skipped` tells by symbol what contexts look past; brackets are never skipped.
  void build(const ModuleString& string, const SymbolTable& alphabet, SymbolId open, SymbolId close,
             std::span<const std::uint8_t> skipped, bool follow_branches);

  /// Whether the path before module `i` ends with `pattern`; writes the place of each matched module.
  bool match_left(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched,
                  Work& work) const {
    // Most contexts are one module that stands beside: no walk is needed.
    if (pattern.size() == 1 && i > 0 && symbols_[i - 1] == pattern[0].symbol && is_plain(i - 1)) {
      matched[0] = static_cast<std::uint32_t>(i - 1);
      return true;
    }
    return pattern.empty() || match_path(i, pattern, matched, work);
  }
  /// Whether what follows module `i` starts with `pattern`; writes the place of each matched module.
  bool match_right(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched,
                   Work& work) const {
    if (pattern.size() == 1 && i + 1 < size_ && is_plain(i + 1)) {
      matched[0] = static_cast<std::uint32_t>(i + 1);
      return symbols_[i + 1] == pattern[0].symbol;
    }
    return pattern.empty() || match_tree(i + 1, pattern, matched, work);
  }

  std::uint32_t value_offset(std::size_t module) const { return value_offset_[module]; }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  /// A module that a context cannot look past.
  bool is_plain(std::size_t i) const {
    return symbols_[i] != open_ && symbols_[i] != close_ && !skipped_[symbols_[i]];
  }
  bool match_path(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched,
                  Work& work) const;
  std::size_t previous(std::size_t i, Work& work) const;

  /// Where the right context may go on in another way: the module `pattern` of it in the branches that open
  /// in [begin, end).
  struct Choice {
    std::size_t pattern = 0, begin = 0, end = 0;
  };
  bool match_tree(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched,
                  Work& work) const;
  std::size_t end_of_axis(std::size_t at, std::size_t& steps) const;
  std::size_t end_of_branch(std::size_t at, std::size_t& steps) const;
  std::size_t next_branch(std::size_t begin, std::size_t end, std::size_t& steps) const;

  const SymbolId* symbols_ = nullptr;
  std::size_t size_ = 0;
  SymbolId open_ = 0, close_ = 0;
  bool follow_branches_ = false;
  std::span<const std::uint8_t> skipped_;
  Buffer<std::uint32_t> value_offset_, partner_;
  std::vector<std::uint32_t> opened_;
  mutable std::vector<Choice> choices_;  ///< of the match under way
};

}  // namespace espalier::lsystem
