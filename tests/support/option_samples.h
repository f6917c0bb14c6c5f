// For tests that try each option of a fit: a value unlike its default, and TOML values that it must refuse.
#pragma once
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

namespace espalier {

struct OptionSample {
  OptionValue another;           ///< unlike the default, and valid
  std::string of_wrong_type;     ///< TOML
  std::vector<std::string> bad;  ///< TOML of the right type: out of range, not finite, or no known name
};

inline OptionValue record_zero(const FitOption& option) {
  return type_of(option) == ValueType::whole ? OptionValue(std::int64_t{0}) : OptionValue(0.0);
}

inline std::string number_as_toml(const FitOption& option, double value) {
  return type_of(option) == ValueType::whole ? fmt::format("{:.0f}", value) : toml_number(value);
}

inline OptionSample sample_of_number(const FitOption& option) {
  const bool is_whole = type_of(option) == ValueType::whole;
  const double another = option.upper <= 1 ? 0.25 : 17;
  OptionSample sample{is_whole ? OptionValue(static_cast<std::int64_t>(another)) : OptionValue(another),
                      is_whole ? "2.5" : "'many'",
                      {}};
  if (option.lower != -kUnbounded) sample.bad.push_back(number_as_toml(option, option.lower - 2));
  if (option.upper != kUnbounded) sample.bad.push_back(number_as_toml(option, option.upper + 2));
  if (!is_whole) sample.bad.insert(sample.bad.end(), {"nan", "inf"});
  return sample;
}

/// Texts have grammars of their own; a name that nobody has is none of most.
inline OptionSample sample_of_text(const FitOption& option) {
  const std::map<std::string_view, std::string> others = {{"model", "small_pine.lsys"},
                                                          {"objective", "iou"},
                                                          {"optimizer", "random_search"},
                                                          {"kind", "palm"},
                                                          {"target.method", "alpha"},
                                                          {"target.side", "dark"},
                                                          {"target.labels", "none"},
                                                          {"target_hash", "0123"},
                                                          {"target.ground_color", "#102030"},
                                                          {"target.tree_color", "1,2,3"},
                                                          {"target.region", "1,2,30,40"},
                                                          {"target.tree_seeds", "3,4"},
                                                          {"target.ground_seeds", "3,4;5,6"},
                                                          {"target.keep_marks", "lines"},
                                                          {"target.scale_bar", "100=5"},
                                                          {"stages", "search"},
                                                          {"start", "palm"},
                                                          {"space", "species:3"}};
  const auto other = others.find(option.field);
  OptionSample sample{other == others.end() ? "another" : other->second, "7", {}};
  const bool takes_any = option.field == "model" || option.field == "start" || option.field == "target_hash";
  if (option.field == "start") sample.bad = {"'random:0'", "'random:many'", "'auto,acer'", "''"};
  if (!takes_any && other != others.end()) sample.bad = {"'nobody'"};
  return sample;
}

inline OptionSample sample_of(const FitOption& option) {
  switch (type_of(option)) {
    case ValueType::flag:
      return {!std::get<bool>(get_value(option, FitRecord{})), "'maybe'", {}};
    case ValueType::whole:
    case ValueType::number:
      return sample_of_number(option);
    case ValueType::text:
      return sample_of_text(option);
    case ValueType::texts:
      return {std::vector<std::string>{"g_scale"}, "7", {"[7]"}};
    case ValueType::assignments:
      return {std::map<std::string, double>{{option.field == "search.fixed" ? "levels" : "population", 3.0}},
              "7",
              {}};
    case ValueType::views:
      return {std::vector<ViewRecord>{{"/b.png", {}}}, "7", {}};
  }
  throw InternalError("unknown type of option");
}

}  // namespace espalier
