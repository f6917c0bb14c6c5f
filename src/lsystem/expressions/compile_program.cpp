// From a Lua expression to a Program: recursive descent along Lua's precedences (Lua 5.1, §2.5.6). Whatever
// is not arithmetic on numbers and truth values is given up, and then Lua evaluates the expression.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>

#include <espalier/core/error.h>
#include <espalier/lsystem/expressions/operations.h>
#include <espalier/lsystem/expressions/program.h>

namespace espalier::lsystem {

namespace {

/// Thrown, and caught here, where an expression is not plain arithmetic.
struct NotArithmetic {};

enum class Type {
  number,
  condition,
  guarded  ///< "c and x": x where c holds, else false; only "… or y" can use it
};

struct Value {
  Type type = Type::number;
  Operand operand;
  Operand guard = {};
};

using Scope = std::map<std::string, Value, std::less<>>;

constexpr std::size_t kMaxTemporaries = 250;
constexpr std::size_t kMostExpandedBytes = 10'000'000, kBytesOfCall = 100;
constexpr int kMaxDepth = 60;

class Compiler {
 public:
  Compiler(const Names& names, std::uint32_t& random_sites, std::size_t& expanded_bytes, Program& program)
      : names_(names), random_sites_(random_sites), expanded_bytes_(expanded_bytes), program_(program) {}

  Value compile(std::string_view text, const Scope& scope) {
    if (++depth_ > kMaxDepth) throw NotArithmetic{};
    const auto outer = std::pair(text_, at_);
    const Scope* outer_scope = scope_;
    text_ = text;
    at_ = 0;
    scope_ = &scope;
    const Value value = disjunction();
    if (!at_end()) throw NotArithmetic{};
    std::tie(text_, at_) = outer;
    scope_ = outer_scope;
    --depth_;
    return value;
  }

 private:
  // Reading

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool at_end() {
    skip_space();
    return at_ == text_.size();
  }
  static bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

  bool take(std::string_view token) {
    skip_space();
    if (!text_.substr(at_).starts_with(token)) return false;
    const std::size_t end = at_ + token.size();
    if (is_word(token[0]) && end < text_.size() && is_word(text_[end])) return false;
    at_ = end;
    return true;
  }
  void expect(std::string_view token) {
    if (!take(token)) throw NotArithmetic{};
  }
  std::string_view word() {
    skip_space();
    const std::size_t start = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

  // Emitting

  static Operand number(const Value& value) {
    if (value.type != Type::number) throw NotArithmetic{};
    return value.operand;
  }
  static Operand condition(const Value& value) {
    if (value.type != Type::condition) throw NotArithmetic{};
    return value.operand;
  }
  Operand literal(double value) {
    program_.literals.push_back(value);
    return {Operand::Kind::literal, static_cast<std::uint32_t>(program_.literals.size() - 1)};
  }
  Operand emit(Op op, Operand a, Operand b, Operand c) {
    if (program_.temporaries >= kMaxTemporaries) throw NotArithmetic{};
    program_.code.push_back({op, program_.temporaries, a, b, c});
    return {Operand::Kind::temporary, program_.temporaries++};
  }
  Operand emit(Op op, Operand a, Operand b) { return emit(op, a, b, literal(0)); }
  Operand emit(Op op, Operand a) { return emit(op, a, literal(0)); }

  // Lua's grammar, weakest operator first

  Value disjunction() {
    if (++depth_ > kMaxDepth) throw NotArithmetic{};
    Value left = conjunction();
    while (take("or")) left = either(left, conjunction());
    --depth_;
    return left;
  }

  /// A number counts as true, so what follows it is never looked at.
  Value either(const Value& left, const Value& right) {
    if (left.type == Type::number) return left;
    if (left.type == Type::guarded && right.type == Type::guarded)
      return {Type::guarded, emit(Op::select, left.guard, left.operand, right.operand),
              emit(Op::either, left.guard, right.guard)};
    if (left.type == Type::guarded)
      return {Type::number, emit(Op::select, left.guard, left.operand, number(right))};
    return {Type::condition, emit(Op::either, left.operand, condition(right))};
  }

  Value conjunction() {
    Value left = comparison();
    while (take("and")) left = both(left, comparison());
    return left;
  }

  Value both(const Value& left, const Value& right) {
    if (left.type == Type::number) return right;
    if (left.type == Type::guarded || right.type == Type::guarded) throw NotArithmetic{};
    if (right.type == Type::number) return {Type::guarded, right.operand, left.operand};
    return {Type::condition, emit(Op::both, left.operand, right.operand)};
  }

  Value comparison() {
    Value left = sum();
    for (;;) {
      if (take("<="))
        left = compare(Op::less_equal, left, sum());
      else if (take(">="))
        left = compare(Op::less_equal, sum(), left);
      else if (take("=="))
        left = compare(Op::equal, left, sum());
      else if (take("~="))
        left = compare(Op::unequal, left, sum());
      else if (take("<"))
        left = compare(Op::less, left, sum());
      else if (take(">"))
        left = compare(Op::less, sum(), left);
      else
        return left;
    }
  }

  Value compare(Op op, const Value& a, const Value& b) {
    return {Type::condition, emit(op, number(a), number(b))};
  }

  Value sum() {
    Value left = product();
    for (;;) {
      if (take("+"))
        left = {Type::number, binary(Op::add, left, product())};
      else if (take("-"))
        left = {Type::number, binary(Op::subtract, left, product())};
      else
        return left;
    }
  }

  Value product() {
    Value left = unary();
    for (;;) {
      if (take("*"))
        left = {Type::number, binary(Op::multiply, left, unary())};
      else if (take("/"))
        left = {Type::number, binary(Op::divide, left, unary())};
      else if (take("%"))
        left = {Type::number, binary(Op::modulo, left, unary())};
      else
        return left;
    }
  }

  Operand binary(Op op, const Value& a, const Value& b) { return emit(op, number(a), number(b)); }

  Value unary() {
    if (++depth_ > kMaxDepth) throw NotArithmetic{};
    const Value value = take("not") ? Value{Type::condition, emit(Op::invert, condition(unary()))}
                        : take("-") ? Value{Type::number, emit(Op::negate, number(unary()))}
                                    : power();
    --depth_;
    return value;
  }

  Value power() {
    const Value base = primary();
    return take("^") ? Value{Type::number, binary(Op::power, base, unary())} : base;
  }

  Value primary() {
    if (take("(")) {
      const Value value = disjunction();
      expect(")");
      return value;
    }
    skip_space();
    if (at_ >= text_.size()) throw NotArithmetic{};
    if (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.')
      return {Type::number, numeral()};
    return named(word());
  }

  Operand numeral() {
    double value = 0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + at_, end, value);
    if (error != std::errc() || (stop != end && (is_word(*stop) || *stop == '.'))) throw NotArithmetic{};
    at_ = static_cast<std::size_t>(stop - text_.data());
    return literal(value);
  }

  Value named(std::string_view name) {
    if (name.empty()) throw NotArithmetic{};
    if (const auto found = scope_->find(name); found != scope_->end()) return found->second;
    if (names_.from_lua.contains(name)) throw NotArithmetic{};
    if (const auto global = names_.globals.find(name))
      return {Type::number, {Operand::Kind::global, static_cast<std::uint32_t>(*global)}};
    if (name == "true" || name == "false") return {Type::condition, literal(name == "true" ? 1 : 0)};
    if (const auto let = names_.functions.find(name); let != names_.functions.end()) return call(let->second);
    if (const auto curve = names_.curves.find(name))
      return on_curve(name, static_cast<std::uint16_t>(*curve));
    if (name == "math") return in_math();
    return built_in(name);
  }

  Value in_math() {
    expect(".");
    const std::string_view name = word();
    if (name == "pi") return {Type::number, literal(3.14159265358979323846)};
    return built_in(name);
  }

  std::vector<Value> arguments() {
    std::vector<Value> values;
    expect("(");
    if (take(")")) return values;
    do values.push_back(disjunction());
    while (take(","));
    expect(")");
    return values;
  }

  Value call(const LetFunction& function) {
    const std::vector<Value> values = arguments();
    if (values.size() != function.parameters.size())
      throw_input_error("{}: got {} arguments, expected {}", function.name, values.size(),
                        function.parameters.size());
    expanded_bytes_ += kBytesOfCall + function.body.size();
    if (expanded_bytes_ > kMostExpandedBytes)
      throw_input_error("{}: got more than {} bytes of functions in functions, expected fewer", function.name,
                        kMostExpandedBytes);
    Scope scope;
    for (std::size_t i = 0; i < values.size(); ++i) scope[function.parameters[i]] = values[i];
    return compile(function.body, scope);
  }

  Value on_curve(std::string_view name, std::uint16_t curve) {
    const std::vector<Value> values = arguments();
    if (values.size() != 1) throw_input_error("{}: got {} arguments, expected 1", name, values.size());
    const Operand result = emit(Op::curve, number(values[0]));
    program_.code.back().object = curve;
    return {Type::number, result};
  }

  /// inside(clip, x, y, z): the first argument is the name of a volume or a field.
  std::uint16_t object(const NameList& names) {
    expect("(");
    const auto found = names.find(word());
    if (!found) throw NotArithmetic{};
    expect(",");
    return static_cast<std::uint16_t>(*found);
  }

  Value at_point(Op op, std::uint16_t object, std::size_t coordinates, Type type) {
    std::vector<Operand> point;
    for (std::size_t i = 0; i < coordinates; ++i) {
      if (i > 0) expect(",");
      point.push_back(number(disjunction()));
    }
    expect(")");
    if (coordinates == 2) point.push_back(literal(0));
    const Operand result = emit(op, point[0], point[1], point[2]);
    program_.code.back().object = object;
    return {type, result};
  }

  Value in_light(Op op) {
    expect("(");
    return at_point(op, 0, 3, Type::number);
  }

  Value built_in(std::string_view name) {
    if (name == "inside") return at_point(Op::inside, object(names_.volumes), 3, Type::condition);
    if (name == "distance") return at_point(Op::distance, object(names_.volumes), 3, Type::number);
    if (name == "value") return at_point(Op::field, object(names_.fields), 2, Type::number);
    if (name == "light" || name == "skylight") return in_light(name == "light" ? Op::light : Op::skylight);
    const std::vector<Value> values = arguments();
    if (name == "random" && values.empty()) {
      program_.draws = true;
      return {Type::number, emit(Op::random, literal(random_sites_++))};
    }
    if (const Operation* function = find_operation(name, Written::as_function))
      return {Type::number, apply(*function, values)};
    const Operation* folded = find_operation(name, Written::as_fold);
    if (!folded) throw NotArithmetic{};
    return {Type::number, fold(*folded, values)};
  }

  Operand apply(const Operation& function, const std::vector<Value>& values) {
    if (function.op == Op::log && values.size() == 2) throw NotArithmetic{};  // to a base
    if (values.size() != static_cast<std::size_t>(function.arity))
      throw_input_error("{}: got {} arguments, expected {}", function.name, values.size(), function.arity);
    std::array<Operand, 3> operands;
    for (std::size_t i = 0; i < operands.size(); ++i)
      operands[i] = i < values.size() ? number(values[i]) : literal(0);
    return emit(function.op, operands[0], operands[1], operands[2]);
  }

  Operand fold(const Operation& folded, const std::vector<Value>& values) {
    if (values.empty()) throw_input_error("{}: got no arguments, expected some", folded.name);
    Operand result = number(values[0]);
    for (std::size_t i = 1; i < values.size(); ++i) result = emit(folded.op, result, number(values[i]));
    return result;
  }

  const Names& names_;
  std::uint32_t& random_sites_;
  std::size_t& expanded_bytes_;
  Program& program_;
  std::string_view text_;
  std::size_t at_ = 0;
  const Scope* scope_ = nullptr;
  int depth_ = 0;
};

}  // namespace

std::optional<Program> compile_program(std::string_view expression, std::span<const std::string> columns,
                                       const Names& names, std::uint32_t& random_sites,
                                       std::size_t& expanded_bytes) {
  Program program;
  Scope scope;
  for (std::size_t i = 0; i < columns.size(); ++i)
    scope[columns[i]] = {Type::number, {Operand::Kind::column, static_cast<std::uint32_t>(i)}};
  try {
    const Value value = Compiler(names, random_sites, expanded_bytes, program).compile(expression, scope);
    if (value.type == Type::guarded) return std::nullopt;
    program.result = value.operand;
    program.is_condition = value.type == Type::condition;
    return program;
  } catch (const NotArithmetic&) {
    return std::nullopt;
  }
}

}  // namespace espalier::lsystem
