#include <algorithm>
#include <set>

#include <espalier/lsystem/notation/parse_modules.h>
#include <espalier/lsystem/notation/parse_production.h>

namespace espalier::lsystem {

namespace {

/// Before all pieces of Lua code, each of which has those of the file before it.
constexpr std::size_t kMostLineBreaks = 2'000'000;

/// An id is followed by a colon at once; the colon before a condition has a space before it.
std::string parse_id(Cursor& cursor) {
  const std::size_t begin = cursor.at();
  std::string word(cursor.take_word());
  if (!word.empty() && cursor.rest().starts_with(':')) {
    cursor.go_to(cursor.at() + 1);
    return word;
  }
  cursor.go_to(begin);
  return "";
}

void check_is_path(const std::vector<PatternModule>& modules, const Grammar& grammar,
                   const Position& position) {
  for (const PatternModule& module : modules)
    if (grammar.alphabet[module.symbol].name == "[" || grammar.alphabet[module.symbol].name == "]")
      throw_at(position, "got a bracket in the left context, expected a path without branches");
}

void check_parameters(const Production& production) {
  std::set<std::string> seen;
  const auto check = [&](const PatternModule& module) {
    for (const std::string& name : module.parameters)
      if (!seen.insert(name).second)
        throw_at(production.position, "{}: got parameter '{}' twice, expected different names",
                 production.name, name);
  };
  for (const PatternModule& module : production.left) check(module);
  check(production.predecessor);
  for (const PatternModule& module : production.right) check(module);
}

void parse_predecessor(Cursor& cursor, Grammar& grammar, Production& production) {
  std::vector<PatternModule> modules = parse_pattern(cursor, grammar);
  if (cursor.take("<")) {
    if (modules.empty()) cursor.fail("a left context before '<'");
    check_is_path(modules, grammar, production.position);
    production.left = std::move(modules);
    modules = parse_pattern(cursor, grammar);
  }
  if (modules.size() != 1)
    throw_at(production.position, "{}: got {} modules, expected one predecessor", production.name,
             modules.size());
  production.predecessor = modules.front();
  const std::string& name = grammar.alphabet[production.predecessor.symbol].name;
  if (name == "[" || name == "]")
    throw_at(production.position, "{}: got '{}', expected a predecessor that is no bracket", production.name,
             name);
  if (cursor.take(">")) {
    production.right = parse_pattern(cursor, grammar);
    if (production.right.empty()) cursor.fail("a right context after '>'");
  }
  check_parameters(production);
}

Expression parse_condition(Cursor& cursor) {
  cursor.skip_space();
  const std::size_t begin = cursor.at(), arrow = begin + cursor.rest().find("-->");
  std::string text(cursor.between(begin, arrow));
  text.erase(text.find_last_not_of(" \t\n") + 1);
  if (text.empty()) cursor.fail("a condition");
  cursor.go_to(arrow);
  return {text, cursor.position(begin)};
}

void parse_result(Cursor& cursor, Grammar& grammar, Production& production) {
  cursor.skip_space();
  const std::size_t begin = cursor.at();
  const std::string_view rest = cursor.rest();
  if (rest.starts_with("lua") &&
      (rest.size() == 3 || rest.substr(3).find_first_not_of(" \t\r") == rest.substr(3).find('\n'))) {
    production.lua_body = Expression{lua_code(cursor, begin, rest.substr(3), grammar), cursor.position()};
    cursor.go_to(begin + rest.size());
    return;
  }
  production.successor = parse_successor(cursor, grammar);
  if (cursor.take(":")) production.probability = parse_expression(cursor, "");
}

}  // namespace

std::string lua_code(const Cursor& cursor, std::size_t begin, std::string_view code, Grammar& grammar) {
  const std::size_t breaks = cursor.position().source->line_of(begin) - 1;
  grammar.lua_line_breaks += breaks;
  if (grammar.lua_line_breaks > kMostLineBreaks)
    throw_at(cursor.position(begin),
             "got too much Lua code after too many lines, expected fewer pieces of it");
  return std::string(breaks, '\n') + std::string(code);
}

Production parse_production(Cursor& cursor, Grammar& grammar, std::size_t number) {
  Production production;
  production.position = cursor.position();
  production.name = parse_id(cursor);
  if (production.name.empty()) production.name = fmt::format("production {}", number);
  parse_predecessor(cursor, grammar, production);
  if (cursor.take(":")) production.condition = parse_condition(cursor);
  cursor.expect("-->");
  parse_result(cursor, grammar, production);
  if (!cursor.at_end()) cursor.fail("the end of the production");
  return production;
}

}  // namespace espalier::lsystem
