// Things by what they belong to: children by their parent, leaves by their stem.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace espalier {

/// The things 0, 1, … in groups by their key, in order within each. Keys are -1 (belongs to none) and up.
class Groups {
 public:
  template <typename KeyOf>  // (thing) -> std::int32_t
  Groups(std::size_t things, std::size_t keys, KeyOf key_of) : first_(keys + 2, 0), members_(things) {
    const auto slot = [&](std::size_t thing) { return static_cast<std::size_t>(key_of(thing) + 1); };
    for (std::size_t thing = 0; thing < things; ++thing) ++first_[slot(thing) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t thing = 0; thing < things; ++thing)
      members_[next[slot(thing)]++] = static_cast<std::uint32_t>(thing);
  }

  std::span<const std::uint32_t> of(std::int32_t key) const {
    const auto slot = static_cast<std::size_t>(key + 1);
    return {members_.data() + first_[slot], members_.data() + first_[slot + 1]};
  }

 private:
  std::vector<std::uint32_t> first_, members_;
};

}  // namespace espalier
