// Programs give what Lua gives: the same expressions through both, over many values.
#include <gtest/gtest.h>

#include <cmath>

#include <espalier/lsystem/derivation/rule.h>
#include <espalier/lsystem/expressions/program.h>
#include <espalier/lsystem/files/grammar_file.h>

namespace espalier::lsystem {
namespace {

const std::vector<std::string> kColumns{"x", "y"};
const std::vector<double> kValues{-7.5, -2, -1, -0.25, 0, 0.5, 1, 2, 3, 10, 1e6};

class Programs : public testing::Test {
 protected:
  Programs()
      : grammar_(parse_grammar("const g = 3\nlet twice(a) = a + a\naxiom: A\n", "test.lsys")),
        shared_(grammar_, {}) {
    for (const LuaCode& code : grammar_.lua) shared_.lua.run(code.text, code.label);
    shared_.globals = {3, 0};
    shared_.lua.set_global("g", 3);
    for (const double a : kValues)
      for (const double b : kValues) {
        x_.push_back(a);
        y_.push_back(b);
      }
  }

  /// Both results for all pairs of values.
  void expect_same(const std::string& text, bool is_condition) {
    SCOPED_TRACE(text);
    const auto program =
        compile_program(text, kColumns, grammar_.names, shared_.random_sites, shared_.expanded_bytes);
    ASSERT_TRUE(program.has_value());
    ASSERT_EQ(program->is_condition, is_condition);
    const std::vector<Column> columns{{x_.data(), 1}, {y_.data(), 1}};
    std::vector<double> scratch, from_lua(x_.size());
    const Column ours = run_program(*program, {columns, shared_.globals.data(), nullptr, x_.size()}, scratch);
    const Expression expression{text, {}};
    const auto function = shared_.functions.compile(expression, kColumns, is_condition);
    shared_.functions.evaluate(function, columns, nullptr, x_.size(), from_lua.data());
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const bool same = ours[i] == from_lua[i] || (std::isnan(ours[i]) && std::isnan(from_lua[i]));
      EXPECT_TRUE(same) << x_[i] << ", " << y_[i] << ": " << ours[i] << ", Lua " << from_lua[i];
    }
  }

  Grammar grammar_;
  RuleContext shared_;
  std::vector<double> x_, y_;
};

TEST_F(Programs, ComputeNumbersAsLuaDoes) {
  for (const char* text : {"x + y*2",
                           "x - y - 1",
                           "x/y",
                           "x % y",
                           "x % 3",
                           "-x^2",
                           "2^-y",
                           "2^3^2*x",
                           "(x + y)*(x - y)",
                           "-(-x)",
                           "1e-3*x + .5",
                           "g*x",
                           "twice(x)*twice(y + 1)",
                           "min(x, y, 1)",
                           "max(x, 2)",
                           "math.abs(x)",
                           "floor(x) + ceil(y)",
                           "sqrt(abs(x))",
                           "sin(x)*cos(y)",
                           "math.pi*x",
                           "x > 1 and y or -y",
                           "x > 1 and 5 or y < 2 and 6 or 7",
                           "x or y",
                           "x and y",
                           "exp(min(x, 5))"})
    expect_same(text, false);
}

TEST_F(Programs, DecideConditionsAsLuaDoes) {
  for (const char* text : {"x < y", "x <= y", "x > y and y > 0", "x >= 1 or y >= 1", "not (x == y)", "x ~= y",
                           "true", "x < 1 and true", "not (x < 0) and not (y < 0)", "x + 1 < y*2 or false"})
    expect_same(text, true);
}

TEST_F(Programs, LeaveTheRestToLua) {
  for (const char* text : {"unknown(x)", "x..y", "#x", "{x}", "x == true", "(x < 1) + 1", "x < 1 and y",
                           "\"a\"", "x +", "f(x)[1]"})
    EXPECT_FALSE(compile_program(text, kColumns, grammar_.names, shared_.random_sites, shared_.expanded_bytes)
                     .has_value())
        << text;
}

TEST_F(Programs, DrawUniformNumbersByKeyAndPlace) {
  const auto program =
      compile_program("random()", kColumns, grammar_.names, shared_.random_sites, shared_.expanded_bytes);
  ASSERT_TRUE(program.has_value());
  std::vector<RandomKey> keys;
  for (std::uint64_t i = 0; i < kBlockSize; ++i) keys.push_back(child_key(root_key(1), i));
  std::vector<double> scratch;
  const Column drawn = run_program(*program, {{}, nullptr, keys.data(), kBlockSize}, scratch);
  double sum = 0;
  for (std::size_t i = 0; i < kBlockSize; ++i) {
    EXPECT_GE(drawn[i], 0);
    EXPECT_LT(drawn[i], 1);
    sum += drawn[i];
  }
  EXPECT_NEAR(sum / kBlockSize, 0.5, 4 / std::sqrt(12.0 * kBlockSize));
  EXPECT_NE(drawn[0], drawn[1]);
}

}  // namespace
}  // namespace espalier::lsystem
