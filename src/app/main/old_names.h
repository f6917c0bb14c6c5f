// Options that had another name in an earlier version, or have one in other commands: all are taken, one is
// shown.
#pragma once
#include <string>
#include <vector>

namespace espalier {

/// The same words with the options' names of today.
std::vector<std::string> with_names_of_today(std::vector<std::string> words);

}  // namespace espalier
