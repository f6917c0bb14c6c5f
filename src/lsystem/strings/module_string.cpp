#include <fmt/format.h>

#include <cmath>

#include <espalier/lsystem/strings/module_string.h>

namespace espalier::lsystem {

namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "*";
  // Turtle positions carry rounding of 1e-16: what shows as zero is written as zero.
  return std::fabs(value) < 1e-9 ? "0" : fmt::format("{:.6g}", value);
}

}  // namespace

std::string module_text(const Symbol& symbol, const double* values) {
  std::string text = symbol.name;
  for (int i = 0; i < symbol.arity; ++i) {
    text += i == 0 ? '(' : ',';
    text += number_text(values[i]);
  }
  return symbol.arity == 0 ? text : text + ")";
}

std::string to_text(const ModuleString& string, const SymbolTable& alphabet) {
  std::string text;
  const double* values = string.values.data();
  for (std::size_t i = 0; i < string.size(); ++i) {
    const Symbol& symbol = alphabet[string.symbols[i]];
    text += module_text(symbol, values);
    values += symbol.arity;
  }
  return text;
}

}  // namespace espalier::lsystem
