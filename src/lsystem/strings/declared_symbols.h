// The names of symbols that a file declares. Strings are cut by the longest of them that fits, which a tree
// of their letters finds in as many steps as it has letters, however many names there are.
#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace espalier::lsystem {

class DeclaredSymbols {
 public:
  DeclaredSymbols() = default;
  DeclaredSymbols(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) add(name);
  }

  /// Throws InputError for more than 40 letters, and past 10,000 names.
  void add(std::string_view name);
  /// The length of the longest name that `text` opens with, 0 where there is none.
  std::size_t longest(std::string_view text) const;

 private:
  using Node = std::uint32_t;  ///< a beginning of a name; 0 is that of all names
  static std::uint64_t step(Node from, char letter) {
    return std::uint64_t{from} << 8 | static_cast<unsigned char>(letter);
  }

  std::unordered_map<std::uint64_t, Node> next_;
  std::unordered_set<Node> ends_;  ///< those that are a whole name
};

}  // namespace espalier::lsystem
