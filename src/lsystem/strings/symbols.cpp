#include <algorithm>
#include <cctype>

#include <espalier/core/error.h>
#include <espalier/lsystem/strings/symbols.h>
#include <espalier/lsystem/strings/turtle_commands.h>

namespace espalier::lsystem {

SymbolId SymbolTable::intern(std::string_view name, std::size_t arity) {
  if (arity > kMaxArity)
    throw_input_error("module {}: got {} parameters, expected at most {}", name, arity, kMaxArity);
  auto found = ids_.find(name);
  if (found == ids_.end()) found = ids_.emplace(name, std::array<SymbolId, kMaxArity + 1>{}).first;
  SymbolId& id = found->second[arity];
  if (id > 0) return static_cast<SymbolId>(id - 1);
  if (symbols_.size() >= 65'000) throw_input_error("got more than 65000 symbols, expected fewer");
  symbols_.push_back({std::string(name), static_cast<std::uint8_t>(arity)});
  arities_.push_back(static_cast<std::uint8_t>(arity));
  id = static_cast<SymbolId>(symbols_.size());
  return static_cast<SymbolId>(id - 1);
}

void SymbolTable::truncate(std::size_t size) {
  for (std::size_t id = size; id < symbols_.size(); ++id)
    ids_.find(symbols_[id].name)->second[symbols_[id].arity] = 0;
  symbols_.resize(std::min(size, symbols_.size()));
  arities_.resize(symbols_.size());
}

bool is_query(std::string_view name) {
  return name.size() == 2 && name[0] == '?' &&
         std::string_view("PHUL").find(name[1]) != std::string_view::npos;
}

std::size_t symbol_length(std::string_view text, const DeclaredSymbols& declared) {
  std::size_t longest = declared.longest(text);
  if (longest > 0 || text.empty()) return longest;
  if (std::isalpha(static_cast<unsigned char>(text[0]))) return 1;
  for (const CommandInfo& info : kCommands)
    for (const std::string_view symbol : {info.symbol, info.other_symbol})
      if (symbol.size() > longest && text.starts_with(symbol)) longest = symbol.size();
  return longest;
}

}  // namespace espalier::lsystem
