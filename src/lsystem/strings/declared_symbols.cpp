#include <espalier/core/error.h>
#include <espalier/lsystem/strings/declared_symbols.h>

namespace espalier::lsystem {

void DeclaredSymbols::add(std::string_view name) {
  constexpr std::size_t kMostNames = 10'000, kMostLetters = 40;
  if (name.size() > kMostLetters)
    throw_input_error("got a symbol of {} letters, expected at most {}", name.size(), kMostLetters);
  Node node = 0;
  for (const char letter : name)
    node = next_.emplace(step(node, letter), static_cast<Node>(next_.size() + 1)).first->second;
  ends_.insert(node);
  if (ends_.size() > kMostNames) throw_input_error("got more than {} symbols, expected fewer", kMostNames);
}

std::size_t DeclaredSymbols::longest(std::string_view text) const {
  std::size_t longest = 0;
  Node node = 0;
  for (std::size_t i = 0; i < text.size() && !next_.empty(); ++i) {
    const auto found = next_.find(step(node, text[i]));
    if (found == next_.end()) break;
    node = found->second;
    if (ends_.contains(node)) longest = i + 1;
  }
  return longest;
}

}  // namespace espalier::lsystem
