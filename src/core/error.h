// The kinds of error (bad input, broken invariant). A degenerate candidate is no error:
// it is a status with a finite penalty, see plant/model.h and fitting/task/plant_scorer.h.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace espalier {

/// Bad user input. The message is one line: where (file, line, key or value), got, expected.
/// The program prints it to stderr without a stack and exits 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A failure of ours, or of the machine: a broken invariant. The program exits 1.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

template <typename... Args>
[[noreturn]] void throw_input_error(fmt::format_string<Args...> format, Args&&... args) {
  throw InputError(fmt::format(format, std::forward<Args>(args)...));
}

/// Checks an invariant of the program and prints both values where it does not hold.
#define ESPALIER_CHECK_EQ(got, expected)                                                                   \
  do {                                                                                                     \
    if (!((got) == (expected)))                                                                            \
      throw ::espalier::InternalError(fmt::format("{}:{}: {} is {}, expected {} ({})", __FILE__, __LINE__, \
                                                  #got, (got), (expected), #expected));                    \
  } while (false)

}  // namespace espalier
