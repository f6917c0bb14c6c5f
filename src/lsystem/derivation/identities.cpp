#include <map>
#include <string_view>

#include <espalier/core/random.h>
#include <espalier/lsystem/derivation/identities.h>

namespace espalier::lsystem {

std::vector<SymbolId> symbols_by_name(const SymbolTable& alphabet) {
  std::map<std::string_view, SymbolId> first;
  std::vector<SymbolId> by_name(alphabet.size());
  for (std::size_t id = 0; id < by_name.size(); ++id) {
    const auto symbol = static_cast<SymbolId>(id);
    by_name[id] = first.emplace(alphabet[symbol].name, symbol).first->second;
  }
  return by_name;
}

void append_identities(std::uint64_t identity, SymbolId predecessor, std::span<const SymbolId> successor,
                       std::span<const SymbolId> by_name, std::uint64_t step, Identities& identities) {
  const RandomKey born = child_key({identity}, step);
  bool has_heir = false;
  std::uint64_t* place = identities.grow(successor.size());
  for (std::size_t i = 0; i < successor.size(); ++i) {
    const bool is_heir =
        !has_heir && (successor.size() == 1 || by_name[successor[i]] == by_name[predecessor]);
    has_heir = has_heir || is_heir;
    place[i] = is_heir ? identity : child_key(born, i).value;
  }
}

}  // namespace espalier::lsystem
