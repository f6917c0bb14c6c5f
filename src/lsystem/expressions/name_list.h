// Names in the order in which a file gives them, and where each stands: files may have thousands, and their
// expressions use millions.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::lsystem {

class NameList {
 public:
  NameList() = default;
  NameList(std::initializer_list<std::string> names) {
    for (const std::string& name : names) push_back(name);
  }

  /// A name that is there already keeps its first place.
  void push_back(std::string name) {
    places_.emplace(name, names_.size());
    names_.push_back(std::move(name));
  }
  std::optional<std::size_t> find(std::string_view name) const {
    const auto found = places_.find(name);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
  }
  std::size_t size() const { return names_.size(); }
  bool empty() const { return names_.empty(); }
  const std::string& operator[](std::size_t place) const { return names_[place]; }
  auto begin() const { return names_.begin(); }
  auto end() const { return names_.end(); }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::size_t, std::less<>> places_;
};

}  // namespace espalier::lsystem
