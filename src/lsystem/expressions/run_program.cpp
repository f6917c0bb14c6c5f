// The instructions of a Program, each a loop over a block of modules.
#include <algorithm>
#include <array>
#include <cmath>

#include <espalier/lsystem/expressions/program.h>
#include <espalier/lsystem/surroundings/surroundings.h>

namespace espalier::lsystem {

namespace {

struct Arguments {
  Column a, b, c;
  const RandomKey* keys;
  double* target;
  std::size_t count;
  const Surroundings* surroundings = nullptr;
  std::size_t object = 0;
};

using Run = void (*)(const Arguments&);

template <typename F>
void each(const Arguments& in, F f) {
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = f(in.a.data[i * in.a.stride]);
}

/// The strides are constants of each loop, so that it becomes vector instructions.
template <std::size_t A, std::size_t B, typename F>
void pairs(const Arguments& in, F f) {
  const double *a = in.a.data, *b = in.b.data;
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = f(a[i * A], b[i * B]);
}

template <typename F>
void each_pair(const Arguments& in, F f) {
  if (in.a.stride == 1)
    in.b.stride == 1 ? pairs<1, 1>(in, f) : pairs<1, 0>(in, f);
  else
    in.b.stride == 1 ? pairs<0, 1>(in, f) : pairs<0, 0>(in, f);
}

template <auto kFunction>
void unary(const Arguments& in) {
  each(in, [](double a) { return kFunction(a); });
}

template <auto kFunction>
void binary(const Arguments& in) {
  each_pair(in, [](double a, double b) { return kFunction(a, b); });
}

// Lua 5.1, §2.5.1: a % b == a - floor(a/b)*b
double lua_modulo(double a, double b) { return a - std::floor(a / b) * b; }

void run_select(const Arguments& in) {
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = in.a[i] != 0 ? in.b[i] : in.c[i];
}

void run_random(const Arguments& in) {
  const auto site = static_cast<std::uint32_t>(in.a[0]);
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = random_unit(in.keys[i], site);
}

template <auto kMember>
void at_points(const Arguments& in) {
  for (std::size_t i = 0; i < in.count; ++i)
    in.target[i] = static_cast<double>((in.surroundings->*kMember)(in.object, {in.a[i], in.b[i], in.c[i]}));
}

/// In the order of Op.
constexpr std::array<Run, 32> kRuns{
    binary<[](double a, double b) { return a + b; }>,
    binary<[](double a, double b) { return a - b; }>,
    binary<[](double a, double b) { return a * b; }>,
    binary<[](double a, double b) { return a / b; }>,
    binary<lua_modulo>,
    binary<[](double a, double b) { return std::pow(a, b); }>,
    unary<[](double a) { return -a; }>,
    binary<[](double a, double b) { return a < b ? 1.0 : 0.0; }>,
    binary<[](double a, double b) { return a <= b ? 1.0 : 0.0; }>,
    binary<[](double a, double b) { return a == b ? 1.0 : 0.0; }>,
    binary<[](double a, double b) { return a != b ? 1.0 : 0.0; }>,
    binary<[](double a, double b) { return a * b; }>,
    binary<[](double a, double b) { return a != 0 ? a : b; }>,
    unary<[](double a) { return 1 - a; }>,
    run_select,
    binary<[](double a, double b) { return b < a ? b : a; }>,
    binary<[](double a, double b) { return a < b ? b : a; }>,
    unary<[](double a) { return std::fabs(a); }>,
    unary<[](double a) { return std::floor(a); }>,
    unary<[](double a) { return std::ceil(a); }>,
    unary<[](double a) { return std::sqrt(a); }>,
    unary<[](double a) { return std::sin(a); }>,
    unary<[](double a) { return std::cos(a); }>,
    unary<[](double a) { return std::tan(a); }>,
    unary<[](double a) { return std::exp(a); }>,
    unary<[](double a) { return std::log(a); }>,
    run_random,
    at_points<&Surroundings::inside>,
    at_points<&Surroundings::distance>,
    at_points<&Surroundings::field>,
    at_points<&Surroundings::light>,
    at_points<&Surroundings::skylight>,
};

class Runner {
 public:
  Runner(const Program& program, const ProgramInputs& inputs, std::vector<double>& scratch)
      : program_(program), inputs_(inputs), scratch_(scratch) {
    scratch_.resize(program.temporaries * kBlockSize);
  }

  Column column(Operand operand) const {
    switch (operand.kind) {
      case Operand::Kind::column:
        return inputs_.columns[operand.index];
      case Operand::Kind::global:
        return {inputs_.globals + operand.index, 0};
      case Operand::Kind::literal:
        return {program_.literals.data() + operand.index, 0};
      case Operand::Kind::temporary:
        return {scratch_.data() + operand.index * kBlockSize, strides_[operand.index]};
    }
    return {};
  }

  void run(const Instruction& instruction) {
    Arguments in{
        column(instruction.a), column(instruction.b), column(instruction.c), inputs_.keys, nullptr, 0,
        inputs_.surroundings,  instruction.object};
    const bool varies = in.a.stride + in.b.stride + in.c.stride > 0 || instruction.op == Op::random;
    in.count = varies ? inputs_.count : 1;
    in.target = scratch_.data() + instruction.target * kBlockSize;
    strides_[instruction.target] = varies ? 1 : 0;
    kRuns[static_cast<std::size_t>(instruction.op)](in);
  }

 private:
  const Program& program_;
  const ProgramInputs& inputs_;
  std::vector<double>& scratch_;
  std::array<std::uint8_t, 256> strides_{};
};

}  // namespace

Column run_program(const Program& program, const ProgramInputs& inputs, std::vector<double>& scratch) {
  Runner runner(program, inputs, scratch);
  for (const Instruction& instruction : program.code) runner.run(instruction);
  return runner.column(program.result);
}

double random_unit(RandomKey key, std::uint32_t site) {
  return static_cast<double>(random_bits(key, site) >> 11) * 0x1p-53;
}

}  // namespace espalier::lsystem
