// Damaged files: what a disk, a cut connection or somebody with a hex editor makes of a sound one. The same
// ones in each run; more of them where ESPALIER_MUTATIONS says how many.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace espalier::test {

/// One to four damages: bits flipped, bytes or short runs replaced, a part cut out, doubled or moved, the end
/// cut off, a number made huge.
inline std::string mutate(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t bound) { return bound == 0 ? 0 : random() % bound; };
  const auto insert_number = [&](std::size_t at) {
    static constexpr const char* kNumbers[] = {"0",    "-1",  "4294967295", "99999999999",
                                               "1e38", "nan", "65536"};
    const auto digits = bytes.find_first_of("0123456789", at);
    if (digits != std::string::npos) bytes.replace(digits, 1, kNumbers[below(std::size(kNumbers))]);
  };
  for (std::size_t left = 1 + below(4); left > 0 && !bytes.empty(); --left) {
    const std::size_t at =
        below(2) == 0 ? below(std::min<std::size_t>(bytes.size(), 128)) : below(bytes.size());
    const std::size_t count = 1 + below(std::min<std::size_t>(16, bytes.size() - at));
    switch (below(9)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
        break;
      case 1:
        bytes[at] = static_cast<char>(random());
        break;
      case 2:
        bytes.replace(at, count, std::string(count, below(2) == 0 ? '\xff' : '\0'));
        break;
      case 3:
        bytes.erase(at, count);
        break;
      case 4:
        bytes.insert(at, bytes.substr(at, count));
        break;
      case 5:
        bytes.insert(below(bytes.size()), bytes.substr(at, count));
        break;
      case 6:
        bytes.resize(at);
        break;
      case 7:
        insert_number(at);
        break;
      default:
        std::generate_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, std::ref(random));
        break;
    }
  }
  return bytes;
}

/// Of each sound file.
inline int mutation_count() {
  const char* count = std::getenv("ESPALIER_MUTATIONS");
  return count ? std::atoi(count) : 200;
}

}  // namespace espalier::test
