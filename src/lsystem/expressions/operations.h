// The table of operations that programs are made of: one row each, in the order of Op, which the compiler
// checks. An operation runs over a block of modules. To add a function of one argument, give it a name in Op
// and a row in operations.cpp.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <espalier/lsystem/expressions/program.h>

namespace espalier::lsystem {

/// Columns of the arguments, of which an operation reads as many as its row says.
struct OpArguments {
  Column a, b, c;
  const RandomKey* keys = nullptr;
  double* target = nullptr;
  std::size_t count = 0;
  const Surroundings* surroundings = nullptr;
  const Curve* curves = nullptr;
  std::size_t object = 0;  ///< a volume, a field or a curve
};

/// How expressions write it.
enum class Written : std::uint8_t {
  as_sign,      ///< an operator of Lua, or part of one
  as_function,  ///< name(arguments), as many as it takes
  as_fold,      ///< name(a, b, c, …): of the first two, then of the result and the third, …
  specially     ///< a function with a form of its own
};

struct Operation {
  Op op = Op::count;
  std::string_view name;
  int arity = 0;
  Written written = Written::as_sign;
  void (*run)(const OpArguments&) = nullptr;
};

/// By Op.
extern const std::array<Operation, static_cast<std::size_t>(Op::count)> kOperations;

/// The operation of a function's name that is written in this way, or nullptr.
const Operation* find_operation(std::string_view name, Written written);

}  // namespace espalier::lsystem
