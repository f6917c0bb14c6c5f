#include <cctype>

#include <espalier/lsystem/notation/parse_modules.h>
#include <espalier/lsystem/strings/turtle_commands.h>
#include <espalier/lsystem/surfaces/surfaces.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostModules = 1'000'000;
constexpr std::size_t kMostNested = 10'000;
constexpr std::size_t kLongestPattern = 1000;
constexpr std::string_view kModule = "a module (a letter, a turtle symbol or a declared name)";

/// The name of the next module.
std::string_view take_symbol(Cursor& cursor, const Grammar& grammar) {
  cursor.skip_space();
  const std::size_t length = symbol_length(cursor.rest(), grammar.declared_symbols);
  if (length == 0) cursor.fail(kModule);
  const std::size_t begin = cursor.at();
  cursor.go_to(begin + length);
  return cursor.between(begin, begin + length);
}

bool opens_parameters(const Cursor& cursor) { return cursor.rest().starts_with('('); }

/// Follows the brackets of a list of modules.
class Brackets {
 public:
  void see(std::string_view name, const Cursor& cursor, std::size_t offset) {
    if (name == "[") open_.push_back(offset);
    if (open_.size() > kMostNested)
      throw_at(cursor.position(offset), "got {} brackets in each other, expected at most {}", open_.size(),
               kMostNested);
    if (name != "]") return;
    if (open_.empty()) throw_at(cursor.position(offset), "got ']', expected a '[' before it");
    open_.pop_back();
  }
  void finish(const Cursor& cursor) const {
    if (!open_.empty()) throw_at(cursor.position(open_.back()), "got '[', expected a ']' after it");
  }

 private:
  std::vector<std::size_t> open_;
};

PatternModule parse_pattern_module(Cursor& cursor, Grammar& grammar) {
  const std::string name(take_symbol(cursor, grammar));
  PatternModule module;
  if (opens_parameters(cursor)) {
    cursor.expect("(");
    do module.parameters.push_back(cursor.expect_word("the name of a parameter"));
    while (cursor.take(","));
    cursor.expect(")");
  }
  module.symbol = grammar.alphabet.intern(name, module.parameters.size());
  return module;
}

/// The number by which the turtle knows a surface, for the first argument of ~("leaf", …).
void replace_surface_name(SuccessorModule& module, std::string_view name, const Grammar& grammar) {
  if (name != "~" || module.arguments.empty()) return;
  Expression& first = module.arguments.front();
  if (first.text.size() < 2 || (first.text.front() != '"' && first.text.front() != '\'')) return;
  try {
    first.text =
        std::to_string(surface_by_name(first.text.substr(1, first.text.size() - 2), *grammar.appearance));
  } catch (const InputError& error) {
    throw_at(first.position, "{}", error.what());
  }
}

SuccessorModule parse_successor_module(Cursor& cursor, Grammar& grammar) {
  cursor.skip_space();
  const Position position = cursor.position();
  const std::string name(take_symbol(cursor, grammar));
  SuccessorModule module;
  if (opens_parameters(cursor)) {
    cursor.expect("(");
    module.arguments = parse_expressions(cursor, ")");
    cursor.expect(")");
  }
  replace_surface_name(module, name, grammar);
  try {
    check_arity(name, module.arguments.size());
    module.symbol = grammar.alphabet.intern(name, module.arguments.size());
  } catch (const InputError& error) {
    throw_at(position, "{}", error.what());
  }
  return module;
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

std::vector<PatternModule> parse_pattern(Cursor& cursor, Grammar& grammar) {
  std::vector<PatternModule> modules;
  Brackets brackets;
  for (;;) {
    const bool ends = cursor.at_end() || cursor.rest().starts_with("-->") ||
                      std::string_view("<>:").find(cursor.rest()[0]) != std::string_view::npos;
    if (ends) break;
    const std::size_t offset = cursor.at();
    if (modules.size() >= kLongestPattern)
      cursor.fail(fmt::format("at most {} modules before the arrow", kLongestPattern));
    modules.push_back(parse_pattern_module(cursor, grammar));
    brackets.see(grammar.alphabet[modules.back().symbol].name, cursor, offset);
  }
  brackets.finish(cursor);
  return modules;
}

std::vector<SuccessorModule> parse_successor(Cursor& cursor, Grammar& grammar) {
  std::vector<SuccessorModule> modules;
  if (cursor.take("*") || cursor.take("\u03b5")) return modules;
  Brackets brackets;
  while (!cursor.at_end() && cursor.rest()[0] != ':') {
    const std::size_t offset = cursor.at();
    if (++grammar.modules > kMostModules)
      throw_at(cursor.position(), "got more than {} modules in a file, expected fewer", kMostModules);
    modules.push_back(parse_successor_module(cursor, grammar));
    brackets.see(grammar.alphabet[modules.back().symbol].name, cursor, offset);
  }
  brackets.finish(cursor);
  if (modules.empty()) cursor.fail("modules, or * for none");
  return modules;
}

Expression parse_expression(Cursor& cursor, std::string_view stops) {
  cursor.skip_space();
  const std::size_t begin = cursor.at(), end = cursor.find_outside(stops);
  Expression expression{trimmed(cursor.between(begin, end)), cursor.position(begin)};
  if (expression.text.empty()) cursor.fail("an expression");
  cursor.go_to(end);
  return expression;
}

std::vector<Expression> parse_expressions(Cursor& cursor, std::string_view stops) {
  std::vector<Expression> expressions;
  const std::string all = std::string(stops) + ",";
  do expressions.push_back(parse_expression(cursor, all));
  while (cursor.take(","));
  return expressions;
}

}  // namespace espalier::lsystem
