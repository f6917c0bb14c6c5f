// Expressions for blocks of modules: a Program where they are plain arithmetic, else a Lua function.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <espalier/lsystem/derivation/rule.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostExpressions = 50'000;

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The names an expression uses as variables or functions: words that follow neither '.' nor ':'.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    while (i < text.size() && is_word(text[i])) ++i;
    const bool is_field = begin > 0 && (text[begin - 1] == '.' || text[begin - 1] == ':');
    if (i > begin && !std::isdigit(static_cast<unsigned char>(text[begin])) && !is_field)
      names.emplace_back(text.substr(begin, i - begin));
    if (i == begin) ++i;
  }
  return names;
}

/// A name that is nothing would be nil, and an error only once it is used: better said when the file is read.
void check_names(const Expression& expression, std::span<const std::string> columns, RuleContext& shared) {
  static const std::set<std::string, std::less<>> kKnown{"and", "or", "not", "true", "false", "nil", "step"};
  // Quotes, tables and functions inside an expression are left to Lua.
  if (expression.text.find_first_of("\"'{[") != std::string::npos ||
      expression.text.find("function") != std::string::npos)
    return;
  for (const std::string& name : names_in(expression.text)) {
    if (kKnown.contains(name) || std::find(columns.begin(), columns.end(), name) != columns.end()) continue;
    if (!shared.lua.has_global(name))
      throw_at(expression.position,
               "'{}': got the unknown name '{}', expected a parameter, a constant or a function",
               shortened(expression.text), shortened(name));
  }
}

/// In additions.
double weight_of(Op op) {
  switch (op) {
    case Op::power:
    case Op::sin:
    case Op::cos:
    case Op::tan:
    case Op::exp:
    case Op::log:
    case Op::curve:
      return 6;
    case Op::modulo:
    case Op::random:
      return 3;
    default:
      return 1;
  }
}

}  // namespace

BlockExpression::BlockExpression(const Expression& expression, std::span<const std::string> columns,
                                 bool is_condition, RuleContext& shared)
    : source_(&expression) {
  if (++shared.expressions > kMostExpressions)
    throw_at(expression.position, "got more than {} expressions, expected fewer", kMostExpressions);
  shared.lua.check_expression(expression.text, expression.position);
  check_names(expression, columns, shared);
  try {
    program_ = compile_program(expression.text, columns, shared.grammar.names, shared.random_sites,
                               shared.expanded_bytes);
  } catch (const InputError& error) {
    throw_at(expression.position, "'{}': {}", shortened(expression.text), error.what());
  }
  if (program_ && program_->is_condition != is_condition) program_.reset();
  if (program_)
    for (const Instruction& instruction : program_->code) operations_ += weight_of(instruction.op);
  if (!program_) function_ = shared.functions.compile(expression, columns, is_condition);
}

Column BlockExpression::compute(std::span<const Column> columns, const RandomKey* keys, std::size_t count,
                                RuleContext& shared) {
  if (program_) {
    shared.work.add(work_of::kBlock / 2 + static_cast<double>(program_->code.size()) * work_of::kBlock / 4 +
                    operations_ * work_of::kOperation * static_cast<double>(count));
    return run_program(
        *program_, {columns, shared.globals.data(), keys, count, &shared.surroundings, shared.curves.data()},
        scratch_);
  }
  shared.work.add(work_of::kLuaCall + work_of::kValue * static_cast<double>(count * (columns.size() + 1)));
  scratch_.resize(kBlockSize);
  shared.functions.evaluate(function_, columns, keys, count, scratch_.data());
  return {scratch_.data(), 1};
}

std::optional<std::size_t> BlockExpression::first_not_finite(const Column& column, std::size_t count) {
  const std::size_t n = column.stride == 0 ? std::min<std::size_t>(count, 1) : count;
  double sum = 0;  // 0 · x is 0 only where x is finite: one test for all of them
  for (std::size_t i = 0; i < n; ++i) sum += column.data[i] * 0;
  if (sum == 0) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(column[i])) return i;
  return std::nullopt;
}

}  // namespace espalier::lsystem
