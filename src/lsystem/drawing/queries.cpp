#include <espalier/core/error.h>
#include <espalier/lsystem/drawing/queries.h>
#include <espalier/lsystem/drawing/turtle_walk.h>

namespace espalier::lsystem {

namespace {

Vector queried(const Turtle& turtle, Command command) {
  switch (command) {
    case Command::query_heading:
      return turtle.heading;
    case Command::query_up:
      return turtle.up;
    case Command::query_left:
      return turtle.left;
    default:
      return turtle.position;
  }
}

void write(const Vector& v, std::size_t arity, double* values) {
  values[0] = v.x;
  values[1] = arity == 2 ? v.z : v.y;
  if (arity == 3) values[2] = v.z;
}

/// Writes into the string that is read.
struct DirectAnswers : SilentVisitor {
  double* values = nullptr;
  void query(const Turtle& turtle, const Step& step) {
    write(queried(turtle, step.command), step.arity, values + step.value_offset);
  }
};

/// Collects answers for another string.
struct CollectedAnswers : SilentVisitor {
  Buffer<double> answers;
  void query(const Turtle& turtle, const Step& step) {
    write(queried(turtle, step.command), step.arity, answers.grow(step.arity));
  }
};

void copy_answers(const Buffer<double>& answers, ModuleString& string, const SymbolTable& alphabet) {
  const double* answer = answers.data();
  double* values = string.values.data();
  std::size_t left = answers.size();
  for (std::size_t i = 0; i < string.size(); ++i) {
    const Symbol& symbol = alphabet[string.symbols[i]];
    if (is_query(symbol.name)) {
      if (left < symbol.arity) break;
      for (std::size_t v = 0; v < symbol.arity; ++v) values[v] = *answer++;
      left -= symbol.arity;
    }
    values += symbol.arity;
  }
  if (values != string.values.data() + string.values.size() || left != 0)
    throw_input_error("interpretation rules make or remove query modules, expected them to stay");
}

}  // namespace

bool has_queries(const SymbolTable& alphabet) {
  for (std::size_t id = 0; id < alphabet.size(); ++id)
    if (is_query(alphabet[static_cast<SymbolId>(id)].name)) return true;
  return false;
}

void fill_queries(const ModuleString& drawn, ModuleString& string, const SymbolTable& alphabet,
                  const Settings& settings) {
  if (&drawn == &string) {
    DirectAnswers answers;
    answers.values = string.values.data();
    TurtleWalk(settings, answers).run(string, alphabet);
    return;
  }
  CollectedAnswers answers;
  TurtleWalk(settings, answers).run(drawn, alphabet);
  copy_answers(answers.answers, string, alphabet);
}

}  // namespace espalier::lsystem
