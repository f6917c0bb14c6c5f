// Functions of the C library that a search asks for: SLEEF's in this program, with the same bits on every
// processor.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>

#include <espalier/libm/libm.h>

namespace espalier {
namespace {

/// Kept from the compiler, which would compute constants by itself.
double opaque(double x) {
  volatile double hidden = x;
  return hidden;
}

/// As written by C's %a, which shows each bit.
std::string bits_of(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

/// In units in the last place of the right result, which long double holds with 11 more bits.
long double error_ulp(double got, long double right) {
  const double rounded = static_cast<double>(right);
  if (got == rounded || (std::isnan(got) && std::isnan(rounded))) return 0;
  const double last_place =
      std::nextafter(std::abs(rounded), std::numeric_limits<double>::infinity()) - std::abs(rounded);
  return std::abs(static_cast<long double>(got) - right) / last_place;
}

struct Function {
  const char* name;
  double (*ours)(double);
  long double (*right)(long double);
  double from, to;
  double most_ulp = 1.0;
};

const Function kFunctions[] = {
    {"exp", std::exp, std::exp, -700, 700},        {"exp2", std::exp2, std::exp2, -1000, 1000},
    {"expm1", std::expm1, std::expm1, -30, 600},   {"log", std::log, std::log, 1e-300, 1e300},
    {"log2", std::log2, std::log2, 1e-9, 1e9},     {"log10", std::log10, std::log10, 1e-9, 1e9},
    {"log1p", std::log1p, std::log1p, -.999, 1e9}, {"cbrt", std::cbrt, std::cbrt, -1e9, 1e9},
    {"sin", std::sin, std::sin, -1e4, 1e4},        {"cos", std::cos, std::cos, -1e4, 1e4},
    {"tan", std::tan, std::tan, -1e4, 1e4},        {"asin", std::asin, std::asin, -1, 1},
    {"acos", std::acos, std::acos, -1, 1},         {"atan", std::atan, std::atan, -1e9, 1e9},
    {"sinh", std::sinh, std::sinh, -700, 700},     {"cosh", std::cosh, std::cosh, -700, 700},
    {"tanh", std::tanh, std::tanh, -20, 20},       {"erf", std::erf, std::erf, -6, 6},
    {"erfc", std::erfc, std::erfc, -6, 20, 1.5},
};

double between(const Function& function, double fraction) {
  return function.from + fraction * (function.to - function.from);
}

RC_GTEST_PROP(Libm, IsWithinItsBoundOfTheRightResult, ()) {
  const double fraction = *rc::gen::inRange(0, 1'000'000'000) / 1e9;
  for (const Function& function : kFunctions) {
    const double x = opaque(between(function, fraction));
    RC_LOG() << function.name << "(" << bits_of(x) << ")\n";
    RC_ASSERT(error_ulp(function.ours(x), function.right(x)) <= function.most_ulp);
  }
}

RC_GTEST_PROP(Libm, OfTwoArgumentsToo, ()) {
  const double x = opaque(*rc::gen::inRange(1, 1'000'000) / 1e4),
               y = opaque(*rc::gen::inRange(-100'000, 100'000) / 1e3);
  const long double long_x = x, long_y = y;
  if (std::abs(y * std::log(x)) < 700) RC_ASSERT(error_ulp(std::pow(x, y), std::pow(long_x, long_y)) <= 1.0L);
  RC_ASSERT(error_ulp(std::atan2(y, x), std::atan2(long_y, long_x)) <= 1.0L);
  RC_ASSERT(error_ulp(std::hypot(x, y), std::hypot(long_x, long_y)) <= 0.51L);
}

RC_GTEST_PROP(Libm, SineAndCosineTogetherAreThoseAlone, ()) {
  const double x = opaque(*rc::gen::inRange(-1'000'000, 1'000'000) / 1e3);
  double sine = 0, cosine = 0;
  sincos(x, &sine, &cosine);
  RC_ASSERT(error_ulp(sine, std::sin(static_cast<long double>(x))) <= 1.0L);
  RC_ASSERT(error_ulp(cosine, std::cos(static_cast<long double>(x))) <= 1.0L);
  const float narrow = static_cast<float>(x);
  float narrow_sine = 0, narrow_cosine = 0;
  sincosf(narrow, &narrow_sine, &narrow_cosine);
  RC_ASSERT(narrow_sine == std::sin(narrow));
  RC_ASSERT(narrow_cosine == std::cos(narrow));
}

/// Within half a unit in the last place, and a millionth of it for the rounding of what is rounded.
::testing::AssertionResult is_rounded(const char* name, float got, double right) {
  const float rounded = static_cast<float>(right);
  const float last_place =
      std::nextafter(std::abs(rounded), std::numeric_limits<float>::infinity()) - std::abs(rounded);
  if (got == rounded || std::abs(got - right) <= .501 * last_place) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << name << ": " << bits_of(got) << ", expected " << bits_of(rounded);
}

RC_GTEST_PROP(Libm, OfSinglePrecisionIsTheRightOneRounded, ()) {
  const float x = static_cast<float>(opaque(*rc::gen::inRange(1, 800'000) / 1e4)), part = x / 81;
  const double wide = x, narrow = part;
  for (const auto& result : {is_rounded("exp", std::exp(x), std::exp(wide)),
                             is_rounded("exp2", std::exp2(x), std::exp2(wide)),
                             is_rounded("expm1", std::expm1(x), std::expm1(wide)),
                             is_rounded("log", std::log(x), std::log(wide)),
                             is_rounded("log2", std::log2(x), std::log2(wide)),
                             is_rounded("log10", std::log10(x), std::log10(wide)),
                             is_rounded("log1p", std::log1p(x), std::log1p(wide)),
                             is_rounded("cbrt", std::cbrt(x), std::cbrt(wide)),
                             is_rounded("hypot", std::hypot(x, part), std::hypot(wide, narrow)),
                             is_rounded("sin", std::sin(x), std::sin(wide)),
                             is_rounded("cos", std::cos(x), std::cos(wide)),
                             is_rounded("tan", std::tan(x), std::tan(wide)),
                             is_rounded("asin", std::asin(part), std::asin(narrow)),
                             is_rounded("acos", std::acos(part), std::acos(narrow)),
                             is_rounded("atan", std::atan(x), std::atan(wide)),
                             is_rounded("atan2", std::atan2(x, part), std::atan2(wide, narrow)),
                             is_rounded("sinh", std::sinh(x), std::sinh(wide)),
                             is_rounded("cosh", std::cosh(x), std::cosh(wide)),
                             is_rounded("tanh", std::tanh(part), std::tanh(narrow)),
                             is_rounded("erf", std::erf(part), std::erf(narrow)),
                             is_rounded("erfc", std::erfc(part), std::erfc(narrow))})
    RC_ASSERT(static_cast<bool>(result));
}

RC_GTEST_PROP(Libm, APowerOfSinglePrecisionIsTheRightOneRounded, ()) {
  const float x = static_cast<float>(opaque(std::exp2(*rc::gen::inRange(-20'000, 20'000) / 1e3)));
  const float y = static_cast<float>(opaque(*rc::gen::inRange(-59'000, 59'000) / 1e4));
  RC_ASSERT(static_cast<bool>(
      is_rounded("pow", std::pow(x, y), std::pow(static_cast<double>(x), static_cast<double>(y)))));
}

RC_GTEST_PROP(Libm, APowerOfAGreatExponentIsWithinAPlace, ()) {
  const float x = static_cast<float>(opaque(std::exp2(*rc::gen::inRange(-1'000, 1'000) / 1e3)));
  const float y = static_cast<float>(opaque(*rc::gen::inRange(60'000, 900'000) / 1e4));
  const double right = std::pow(static_cast<double>(x), static_cast<double>(y));
  RC_ASSERT(std::abs(std::pow(x, y) - right) <= 1.2e-7 * right);
}

TEST(Libm, APowerOfSinglePrecisionEndsAsPowersDo) {
  const auto power = [](double x, double y) {
    return std::pow(static_cast<float>(opaque(x)), static_cast<float>(opaque(y)));
  };
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(power(0, 2), 0);
  EXPECT_EQ(power(0, -1), infinity);
  EXPECT_EQ(power(-2, 3), -8);
  EXPECT_TRUE(std::isnan(power(-2, .5)));
  EXPECT_TRUE(std::isnan(power(std::nan(""), 2)));
  EXPECT_EQ(power(1e30, 2), infinity);
  EXPECT_EQ(power(1e-30, 2), 0);
  EXPECT_EQ(power(infinity, -1), 0);
  EXPECT_EQ(power(5, 0), 1);
  EXPECT_EQ(power(1, 5.9), 1);
  EXPECT_EQ(power(2, infinity), infinity);
}

TEST(Libm, KeepsTheLawsOfInfinitiesAndNaN) {
  const double infinity = opaque(std::numeric_limits<double>::infinity()), nan = opaque(std::nan(""));
  EXPECT_EQ(std::exp(-infinity), 0);
  EXPECT_EQ(std::exp(infinity), infinity);
  EXPECT_EQ(std::log(opaque(0)), -infinity);
  EXPECT_TRUE(std::isnan(std::log(opaque(-1))));
  EXPECT_EQ(std::pow(nan, opaque(0)), 1);
  EXPECT_EQ(std::pow(opaque(-2), opaque(3)), -8);
  EXPECT_TRUE(std::isnan(std::pow(opaque(-2), opaque(.5))));
  EXPECT_EQ(std::hypot(infinity, nan), infinity);
  EXPECT_EQ(bits_of(std::atan2(opaque(-0.0), opaque(1))), bits_of(-0.0));
  EXPECT_TRUE(std::isnan(std::sin(infinity)));
}

/// Bits that every machine must give; those of processors without FMA and AVX2, and with, were compared.
TEST(Libm, HasTheBitsThatWereSeen) {
  std::uint64_t digest = 14695981039346656037u;
  for (int i = 0; i < 2000; ++i)
    for (const Function& function : kFunctions)
      digest = (digest ^ std::bit_cast<std::uint64_t>(function.ours(opaque(between(function, i / 2000.0))))) *
               1099511628211u;
  EXPECT_EQ(digest, 7802364414861682586u);
}

/// Libraries that the program is linked with (NLopt) find the program's functions before the C library's.
TEST(Libm, IsWhatLibrariesCall) {
  for (const char* name : {"exp", "log", "pow"}) {
    Dl_info where;
    void* found = dlsym(RTLD_DEFAULT, name);
    ASSERT_NE(found, nullptr) << name;
    ASSERT_NE(dladdr(found, &where), 0) << name;
    EXPECT_THAT(where.dli_fname, testing::Not(testing::HasSubstr("libm.so"))) << name;
  }
}

TEST(Libm, SaysItsVersion) { EXPECT_THAT(sleef_version(), testing::MatchesRegex("3\\.[0-9]+\\.[0-9]+")); }

}  // namespace
}  // namespace espalier
