#include <algorithm>
#include <cmath>

#include <espalier/lsystem/expressions/operations.h>
#include <espalier/lsystem/surroundings/surroundings.h>

namespace espalier::lsystem {

namespace {

template <typename F>
void each(const OpArguments& in, F f) {
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = f(in.a.data[i * in.a.stride]);
}

/// The strides are constants of each loop, so that it becomes vector instructions.
template <std::size_t A, std::size_t B, typename F>
void pairs(const OpArguments& in, F f) {
  const double *a = in.a.data, *b = in.b.data;
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = f(a[i * A], b[i * B]);
}

template <typename F>
void each_pair(const OpArguments& in, F f) {
  if (in.a.stride == 1)
    in.b.stride == 1 ? pairs<1, 1>(in, f) : pairs<1, 0>(in, f);
  else
    in.b.stride == 1 ? pairs<0, 1>(in, f) : pairs<0, 0>(in, f);
}

template <auto kFunction>
void unary(const OpArguments& in) {
  each(in, [](double a) { return kFunction(a); });
}

template <auto kFunction>
void binary(const OpArguments& in) {
  each_pair(in, [](double a, double b) { return kFunction(a, b); });
}

// Lua 5.1, §2.5.1: a % b == a - floor(a/b)*b
double lua_modulo(double a, double b) { return a - std::floor(a / b) * b; }

void run_select(const OpArguments& in) {
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = in.a[i] != 0 ? in.b[i] : in.c[i];
}

void run_random(const OpArguments& in) {
  const auto site = static_cast<std::uint32_t>(in.a[0]);
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = random_unit(in.keys[i], site);
}

void run_curve(const OpArguments& in) {
  const Curve& curve = in.curves[in.object];
  for (std::size_t i = 0; i < in.count; ++i) in.target[i] = curve_value(curve, in.a[i]);
}

template <auto kMember>
void at_points(const OpArguments& in) {
  for (std::size_t i = 0; i < in.count; ++i)
    in.target[i] = static_cast<double>((in.surroundings->*kMember)(in.object, {in.a[i], in.b[i], in.c[i]}));
}

}  // namespace

constexpr std::array<Operation, static_cast<std::size_t>(Op::count)> kOperations{{
    {Op::add, "+", 2, Written::as_sign, binary<[](double a, double b) { return a + b; }>},
    {Op::subtract, "-", 2, Written::as_sign, binary<[](double a, double b) { return a - b; }>},
    {Op::multiply, "*", 2, Written::as_sign, binary<[](double a, double b) { return a * b; }>},
    {Op::divide, "/", 2, Written::as_sign, binary<[](double a, double b) { return a / b; }>},
    {Op::modulo, "%", 2, Written::as_sign, binary<lua_modulo>},
    {Op::power, "^", 2, Written::as_sign, binary<[](double a, double b) { return std::pow(a, b); }>},
    {Op::negate, "-", 1, Written::as_sign, unary<[](double a) { return -a; }>},
    {Op::less, "<", 2, Written::as_sign, binary<[](double a, double b) { return a < b ? 1.0 : 0.0; }>},
    {Op::less_equal, "<=", 2, Written::as_sign,
     binary<[](double a, double b) { return a <= b ? 1.0 : 0.0; }>},
    {Op::equal, "==", 2, Written::as_sign, binary<[](double a, double b) { return a == b ? 1.0 : 0.0; }>},
    {Op::unequal, "~=", 2, Written::as_sign, binary<[](double a, double b) { return a != b ? 1.0 : 0.0; }>},
    {Op::both, "and", 2, Written::as_sign, binary<[](double a, double b) { return a * b; }>},
    {Op::either, "or", 2, Written::as_sign, binary<[](double a, double b) { return a != 0 ? a : b; }>},
    {Op::invert, "not", 1, Written::as_sign, unary<[](double a) { return 1 - a; }>},
    {Op::select, "and … or", 3, Written::as_sign, run_select},
    {Op::minimum, "min", 2, Written::as_fold, binary<[](double a, double b) { return b < a ? b : a; }>},
    {Op::maximum, "max", 2, Written::as_fold, binary<[](double a, double b) { return a < b ? b : a; }>},
    {Op::absolute, "abs", 1, Written::as_function, unary<[](double a) { return std::fabs(a); }>},
    {Op::floor, "floor", 1, Written::as_function, unary<[](double a) { return std::floor(a); }>},
    {Op::ceil, "ceil", 1, Written::as_function, unary<[](double a) { return std::ceil(a); }>},
    {Op::sqrt, "sqrt", 1, Written::as_function, unary<[](double a) { return std::sqrt(a); }>},
    {Op::sin, "sin", 1, Written::as_function, unary<[](double a) { return std::sin(a); }>},
    {Op::cos, "cos", 1, Written::as_function, unary<[](double a) { return std::cos(a); }>},
    {Op::tan, "tan", 1, Written::as_function, unary<[](double a) { return std::tan(a); }>},
    {Op::exp, "exp", 1, Written::as_function, unary<[](double a) { return std::exp(a); }>},
    {Op::log, "log", 1, Written::as_function, unary<[](double a) { return std::log(a); }>},
    {Op::random, "random", 0, Written::specially, run_random},
    {Op::inside, "inside", 3, Written::specially, at_points<&Surroundings::inside>},
    {Op::distance, "distance", 3, Written::specially, at_points<&Surroundings::distance>},
    {Op::field, "value", 2, Written::specially, at_points<&Surroundings::field>},
    {Op::light, "light", 3, Written::specially, at_points<&Surroundings::light>},
    {Op::skylight, "skylight", 3, Written::specially, at_points<&Surroundings::skylight>},
    {Op::curve, "function", 1, Written::specially, run_curve},
}};

consteval bool rows_are_in_order() {
  for (std::size_t i = 0; i < kOperations.size(); ++i)
    if (kOperations[i].op != static_cast<Op>(i) || !kOperations[i].run) return false;
  return true;
}
static_assert(rows_are_in_order(), "kOperations: a row is missing, or is not where Op has its name");

const Operation* find_operation(std::string_view name, Written written) {
  const auto found = std::find_if(kOperations.begin(), kOperations.end(), [&](const Operation& row) {
    return row.name == name && row.written == written;
  });
  return found == kOperations.end() ? nullptr : &*found;
}

}  // namespace espalier::lsystem
