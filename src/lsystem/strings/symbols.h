// The alphabet of an L-system. A symbol is a name with a number of parameters: A, A(x) and A(x,y) are three
// symbols, as in parametric L-systems [ABOP §1.10]. Names are one character, "@o", the query modules ?P ?H
// ?U ?L [Topiary §3], or longer words that the file declares.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/lsystem/strings/declared_symbols.h>

namespace espalier::lsystem {

using SymbolId = std::uint16_t;

inline constexpr std::size_t kMaxArity = 16;

struct Symbol {
  std::string name;
  std::uint8_t arity = 0;
};

class SymbolTable {
 public:
  /// The id of this name and number of parameters, made if there is none.
  /// Throws InputError past 65,000 symbols or 16 parameters.
  SymbolId intern(std::string_view name, std::size_t arity);
  /// Forgets all but the first `size` symbols.
  void truncate(std::size_t size);
  const Symbol& operator[](SymbolId id) const { return symbols_[id]; }
  std::size_t size() const { return symbols_.size(); }
  /// Parameters of each symbol, by id.
  const std::vector<std::uint8_t>& arities() const { return arities_; }

 private:
  std::vector<Symbol> symbols_;
  std::vector<std::uint8_t> arities_;
  std::map<std::string, std::array<SymbolId, kMaxArity + 1>, std::less<>>
      ids_;  ///< by name and arity, 1 too large
};

/// The length of the symbol's name that `text` opens with: the longest of `declared`, else one of the
/// built-in names; 0 where there is none.
std::size_t symbol_length(std::string_view text, const DeclaredSymbols& declared);

bool is_query(std::string_view name);

}  // namespace espalier::lsystem
