// Contexts in bracketed strings. The left context of a module is the path to the root; the right context is
// a tree, written with brackets; branches between are skipped [Herbaceous §2.3: BC < S > G[HI]M matches S
// in ABC[DE][SG[HI][JK]LMNO]]. Where an axis has ended and only branches are left at its tip, they continue
// it: without this the signal of [Topiary, L-system 4] would never leave the branch that was cut.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "lsystem/grammar.h"
#include "lsystem/module_string.h"

namespace espalier::lsystem {

/// A string with what contexts need: where each module's parameters start, and each bracket's partner.
class StringIndex {
 public:
  /// `skipped` tells by symbol what contexts look past; brackets are never skipped.
  void build(const ModuleString& string, const SymbolTable& alphabet, SymbolId open, SymbolId close,
             std::span<const std::uint8_t> skipped);

  /// Whether the path before module `i` ends with `pattern`; writes the place of each matched module.
  bool match_left(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched) const;
  /// Whether what follows module `i` starts with `pattern`; writes the place of each matched module.
  bool match_right(std::size_t i, std::span<const PatternModule> pattern, std::uint32_t* matched) const;

  std::uint32_t value_offset(std::size_t module) const { return value_offset_[module]; }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::size_t previous(std::size_t i) const;
  bool match_from(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched) const;
  bool match_branch(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched) const;
  bool match_end(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched) const;
  bool match_module(std::size_t at, std::span<const PatternModule> pattern, std::uint32_t* matched) const;

  const SymbolId* symbols_ = nullptr;
  std::size_t size_ = 0;
  SymbolId open_ = 0, close_ = 0;
  std::span<const std::uint8_t> skipped_;
  Buffer<std::uint32_t> value_offset_, partner_;
  std::vector<std::uint32_t> opened_;
};

}  // namespace espalier::lsystem
