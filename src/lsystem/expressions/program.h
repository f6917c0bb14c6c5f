// Arithmetic over many modules at once. The conditions, arguments and probabilities of an L-system are Lua
// expressions; those that are plain arithmetic (numbers, parameters, constants, operators, and functions of
// `math`) are compiled to a Program, which computes a column of values for a block of modules with the
// results that Lua has. Everything else is left to Lua (lua_functions.h).
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/core/curves/curve.h>
#include <espalier/core/random.h>
#include <espalier/lsystem/expressions/name_list.h>

namespace espalier::lsystem {

class Surroundings;  // surroundings.h

/// How many modules are evaluated together.
inline constexpr std::size_t kBlockSize = 512;

enum class Op : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,
  power,
  negate,
  less,
  less_equal,
  equal,
  unequal,
  both,
  either,
  invert,
  select,
  minimum,
  maximum,
  absolute,
  floor,
  ceil,
  sqrt,
  sin,
  cos,
  tan,
  exp,
  log,
  random,
  inside,
  distance,
  field,
  light,
  skylight,
  curve,
  count  ///< of the names above; operations.h has a row for each
};

struct Operand {
  enum class Kind : std::uint8_t { column, global, literal, temporary } kind = Kind::literal;
  std::uint32_t index = 0;
};

struct Instruction {
  Op op = Op::add;
  std::uint16_t target = 0;  ///< a temporary
  Operand a, b, c;
  std::uint16_t object = 0;  ///< a volume, a field or a curve
};

struct Program {
  std::vector<Instruction> code;
  std::vector<double> literals;
  Operand result;
  std::uint16_t temporaries = 0;
  bool draws = false;         ///< calls random()
  bool is_condition = false;  ///< the result is 1 for true and 0 for false
};

/// A function that an L-system file defines by one expression: "let prune(x, y) = x^2 + y^2 > L^2".
struct LetFunction {
  std::string name;
  std::vector<std::string> parameters;
  std::string body;
};

/// What names mean in the expressions of a file.
struct Names {
  NameList globals;  ///< constants and parameters in order, then "fraction", "step"
  std::map<std::string, LetFunction, std::less<>> functions;
  NameList volumes, fields;                     ///< in order
  NameList curves;                              ///< functions that are given by numbers, in order
  std::set<std::string, std::less<>> from_lua;  ///< given by the file's Lua code: not plain arithmetic
};

/// The program of an expression whose names are `columns` (parameters of modules), globals and functions;
/// nullopt where it is not plain arithmetic, or does not parse. `random_sites` numbers the calls of random().
/// Bodies of let functions are read anew at each call, and may call others: `expanded_bytes` counts them over
/// all expressions of a file. Throws InputError where there are more than 10 million.
std::optional<Program> compile_program(std::string_view expression, std::span<const std::string> columns,
                                       const Names& names, std::uint32_t& random_sites,
                                       std::size_t& expanded_bytes);

/// Values at a stride of 1, or one value for all at a stride of 0.
struct Column {
  const double* data = nullptr;
  std::size_t stride = 1;

  double operator[](std::size_t i) const { return data[i * stride]; }
};

struct ProgramInputs {
  std::span<const Column> columns;
  const double* globals = nullptr;
  const RandomKey* keys = nullptr;  ///< a key per module, for random()
  std::size_t count = 0;            ///< at most kBlockSize
  const Surroundings* surroundings = nullptr;
  const Curve* curves = nullptr;  ///< in the order of their names
};

/// Runs the program. The result lies in `scratch`, among the inputs, or in the program.
Column run_program(const Program& program, const ProgramInputs& inputs, std::vector<double>& scratch);

/// Uniform in [0, 1) with 53 bits, for the `site`-th draw at this place.
double random_unit(RandomKey key, std::uint32_t site);

}  // namespace espalier::lsystem
