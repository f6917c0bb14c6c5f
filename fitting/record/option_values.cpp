#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <type_traits>

#include <espalier/core/assignment.h>
#include <espalier/core/field_error.h>
#include <espalier/fitting/record/option_values.h>

namespace espalier {

namespace {

template <typename Type>
inline constexpr bool kIsWhole =
    std::is_same_v<Type, int> || std::is_same_v<Type, long> || std::is_same_v<Type, Seed>;

/// The type that files know for one of C++.
template <typename Type>
constexpr ValueType type_for() {
  if constexpr (std::is_same_v<Type, bool>) return ValueType::flag;
  if constexpr (kIsWhole<Type>) return ValueType::whole;
  if constexpr (std::is_same_v<Type, double> || std::is_same_v<Type, std::optional<double>>)
    return ValueType::number;
  if constexpr (std::is_same_v<Type, std::vector<std::string>>) return ValueType::texts;
  if constexpr (std::is_same_v<Type, std::map<std::string, double>>) return ValueType::assignments;
  if constexpr (std::is_same_v<Type, std::vector<ViewRecord>>) return ValueType::views;
  return ValueType::text;
}

template <typename Type>
OptionValue to_value(const Type& member) {
  if constexpr (std::is_enum_v<Type>)
    return name_of(member);
  else if constexpr (std::is_same_v<Type, FitStages>)
    return to_string(member);
  else if constexpr (std::is_same_v<Type, std::optional<double>>)
    return member ? OptionValue(*member) : OptionValue();
  else if constexpr (kIsWhole<Type>)
    return static_cast<std::int64_t>(member);
  else
    return member;
}

template <typename Type>
void from_value(const OptionValue& value, Type& member) {
  if constexpr (std::is_enum_v<Type>) {
    member = parse_name<Type>(std::get<std::string>(value));
  } else if constexpr (std::is_same_v<Type, FitStages>) {
    member = parse_stages(std::get<std::string>(value));
  } else if constexpr (std::is_same_v<Type, std::optional<double>>) {
    member.reset();
    if (const double* number = std::get_if<double>(&value)) member = *number;
  } else if constexpr (kIsWhole<Type>) {
    member = static_cast<Type>(std::get<std::int64_t>(value));
  } else {
    member = std::get<Type>(value);
  }
}

template <typename Type>
std::vector<std::string> choices_for() {
  if constexpr (std::is_enum_v<Type>)
    return names_of<Type>();
  else
    return {};
}

/// `use` of the member's type, as in use(Member<double>{}).
template <typename Use>
auto with_member(const FitOption& option, Use use) {
  return std::visit(use, option.member);
}

std::vector<std::string> choices_of(const FitOption& option) {
  return with_member(option, []<typename Type>(Member<Type>) { return choices_for<Type>(); });
}

bool is_seed(const FitOption& option) { return std::holds_alternative<Member<Seed>>(option.member); }

std::string unit_text(const FitOption& option) {
  return option.unit.empty() ? "" : fmt::format(" ({})", option.unit);
}

/// Ranges without a practical end are described by their beginning.
constexpr double kLooksEndless = 1e8;

std::string or_word(const FitOption& option) {
  return option.word ? fmt::format(", or '{}'", option.word->word) : "";
}

std::string describe_whole(const FitOption& option) {
  const double lower = is_seed(option) ? 0 : option.zero_is_none ? 1 : option.lower;
  const std::string range = option.upper < kLooksEndless ? fmt::format("{}..{}", lower, option.upper)
                                                         : fmt::format("from {}", lower);
  return fmt::format("a whole number {}{}{}", range, unit_text(option), or_word(option));
}

std::string describe_number(const FitOption& option) {
  const bool endless = option.upper >= kLooksEndless;
  if (!option.zero_is_none)
    return fmt::format("a number {}..{}{}{}", option.lower, option.upper, unit_text(option), or_word(option));
  return fmt::format("a number above 0{}{}", endless ? "" : fmt::format(", at most {}", option.upper),
                     unit_text(option));
}

[[noreturn]] void refuse(const FitOption& option, const std::string& got) {
  throw_field_error(option.field, "got {}, expected {}", got, describe_values(option));
}

/// None for what is no number.
std::optional<double> number_in(const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

void check_range(const FitOption& option, const OptionValue& value) {
  const auto number = number_in(value);
  if (!number || is_seed(option)) return;
  if (option.word && *number == static_cast<double>(option.word->value)) return;
  if (!(std::isfinite(*number) && *number >= option.lower && *number <= option.upper))
    refuse(option, to_words(value));
}

/// Nobody asks for what is none.
void check_request(const FitOption& option, const OptionValue& value) {
  if (option.zero_is_none && number_in(value) == 0) refuse(option, to_words(value));
}

template <typename Whole>
std::optional<std::int64_t> parse_whole(const std::string& word) {
  Whole value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

OptionValue whole_of_word(const FitOption& option, const std::string& word) {
  if (option.word && word == option.word->word) return option.word->value;
  const auto value = is_seed(option) ? parse_whole<Seed>(word) : parse_whole<std::int64_t>(word);
  if (!value) refuse(option, fmt::format("'{}'", word));
  return *value;
}

OptionValue flag_of_word(const FitOption& option, const std::string& word) {
  if (word != "true" && word != "false") refuse(option, fmt::format("'{}'", word));
  return word == "true";
}

OptionValue number_of_word(const FitOption& option, const std::string& word) {
  if (option.word && word == option.word->word) return static_cast<double>(option.word->value);
  const auto value = parse_decimal(word);
  if (!value) refuse(option, fmt::format("'{}'", word));
  return *value;
}

double assigned_value(const FitOption& option, const FitRecord& record, const std::string& name,
                      const std::string& word) {
  return in_field(option.field, [&] { return option.assigned(record, name, word); });
}

OptionValue assignments_of_words(const FitOption& option, const std::vector<std::string>& words,
                                 const FitRecord& record) {
  std::map<std::string, double> values;
  for (const std::string& word : words) {
    const Assignment assignment = in_field(option.field, [&] { return parse_assignment(word); });
    values[assignment.name] = assigned_value(option, record, assignment.name, assignment.value);
  }
  return values;
}

OptionValue views_of_words(const std::vector<std::string>& words) {
  std::vector<ViewRecord> views;
  views.reserve(words.size());
  for (const std::string& word : words) views.push_back(parse_view(word));
  return views;
}

OptionValue value_of_words(const FitOption& option, const std::vector<std::string>& words,
                           const FitRecord& record) {
  const std::string word = words.empty() ? "" : words.back();
  switch (type_of(option)) {
    case ValueType::flag:
      return flag_of_word(option, word);
    case ValueType::whole:
      return whole_of_word(option, word);
    case ValueType::number:
      return number_of_word(option, word);
    case ValueType::text:
      return word;
    case ValueType::texts:
      return words;
    case ValueType::assignments:
      return assignments_of_words(option, words, record);
    case ValueType::views:
      return views_of_words(words);
  }
  throw InternalError("unknown type of option");
}

// From TOML.

OptionValue texts_of_array(const FitOption& option, const toml::array& array) {
  std::vector<std::string> texts;
  for (const toml::node& node : array) {
    const auto text = node.value_exact<std::string>();
    if (!text) refuse(option, describe_toml(node));
    texts.push_back(*text);
  }
  return texts;
}

/// Numbers, or the words that assignments take.
OptionValue assignments_of_table(const FitOption& option, const toml::table& table, const FitRecord& record) {
  std::map<std::string, double> values;
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (node.is_number())
      values[name] = *node.value<double>();
    else if (const auto word = node.value_exact<std::string>())
      values[name] = assigned_value(option, record, name, *word);
    else
      throw_field_error(option.field, "got {} for {}, expected a number", describe_toml(node), name);
  }
  return values;
}

OptionValue views_of_array(const FitOption& option, const toml::array& array, const std::string& source) {
  std::vector<ViewRecord> views;
  for (const toml::node& node : array) {
    if (!node.is_table()) refuse(option, describe_toml(node));
    views.push_back(read_view({*node.as_table(), source}));
  }
  return views;
}

OptionValue value_of_node(const FitOption& option, const toml::node& node, const std::string& source,
                          const FitRecord& record) {
  const ValueType type = type_of(option);
  if (type == ValueType::flag && node.is_boolean()) return *node.value_exact<bool>();
  if (type == ValueType::whole && node.is_integer()) return *node.value_exact<std::int64_t>();
  if (type == ValueType::whole && option.word && node.is_string())
    return whole_of_word(option, *node.value_exact<std::string>());
  if (type == ValueType::number && node.is_number()) return *node.value<double>();
  if (type == ValueType::number && option.word && node.is_string())
    return number_of_word(option, *node.value_exact<std::string>());
  if (type == ValueType::text && node.is_string()) return *node.value_exact<std::string>();
  if (type == ValueType::texts && node.is_array()) return texts_of_array(option, *node.as_array());
  if (type == ValueType::assignments && node.is_table())
    return assignments_of_table(option, *node.as_table(), record);
  if (type == ValueType::views && node.is_array()) return views_of_array(option, *node.as_array(), source);
  refuse(option, describe_toml(node));
}

std::string joined(const std::map<std::string, double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const auto& [name, value] : values) texts.push_back(fmt::format("{}={}", name, value));
  return fmt::format("{}", fmt::join(texts, ","));
}

}  // namespace

ValueType type_of(const FitOption& option) {
  return with_member(option, []<typename Type>(Member<Type>) { return type_for<Type>(); });
}

OptionValue get_value(const FitOption& option, const FitRecord& record) {
  FitRecord copy = record;  // members are found in records that may change
  return with_member(option, [&](auto member) { return to_value(member(copy)); });
}

void set_value(const FitOption& option, const OptionValue& value, FitRecord& record) {
  check_range(option, value);
  in_field(option.field,
           [&] { with_member(option, [&](auto member) { from_value(value, member(record)); }); });
}

void set_from_words(const FitOption& option, const std::vector<std::string>& words, FitRecord& record) {
  const OptionValue value = value_of_words(option, words, record);
  check_request(option, value);
  set_value(option, value, record);
}

void set_from_record(const FitOption& option, const toml::node& node, const std::string& source,
                     FitRecord& record) {
  set_value(option, value_of_node(option, node, source, record), record);
}

void set_from_request(const FitOption& option, const toml::node& node, const std::string& source,
                      FitRecord& record) {
  OptionValue value = value_of_node(option, node, source, record);
  check_request(option, value);
  if (option.inverted) value = !std::get<bool>(value);
  set_value(option, value, record);
}

void check_option(const FitOption& option, const FitRecord& record) {
  check_range(option, get_value(option, record));
  if (option.check) in_field(option.field, [&] { option.check(record); });
}

std::string describe_values(const FitOption& option) {
  if (!option.expected.empty()) return std::string(option.expected);
  if (const auto choices = choices_of(option); !choices.empty())
    return fmt::format("{}", fmt::join(choices, ", "));
  switch (type_of(option)) {
    case ValueType::flag:
      return "true or false";
    case ValueType::whole:
      return describe_whole(option);
    case ValueType::number:
      return describe_number(option);
    case ValueType::text:
      return "a string";
    case ValueType::texts:
      return "an array of strings";
    case ValueType::assignments:
      return "names with numbers";
    case ValueType::views:
      return "pictures with their angles";
  }
  throw InternalError("unknown type of option");
}

std::string to_words(const OptionValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
    return fmt::format("{}", fmt::join(*texts, ","));
  if (const auto* values = std::get_if<std::map<std::string, double>>(&value)) return joined(*values);
  return "";
}

std::string to_toml(const OptionValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return toml_number(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return quote_toml(*text);
  const auto* texts = std::get_if<std::vector<std::string>>(&value);
  if (!texts) return to_words(value);
  std::vector<std::string> quoted;
  for (const std::string& text : *texts) quoted.push_back(quote_toml(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string toml_number(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace espalier
