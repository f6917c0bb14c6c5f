#include <CLI/CLI.hpp>

#include <espalier/app/options/option_names.h>
#include <espalier/app/options/record_options.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

namespace espalier {

namespace {

bool is_list(ValueType type) {
  return type == ValueType::texts || type == ValueType::assignments || type == ValueType::views;
}

std::string name_of_option(const FitOption& option) { return option_of(std::string(option.field)); }

void add_list(CLI::App& command, const FitOption& option, RecordWords& words) {
  const auto keep = [&words, field = std::string(option.field)](const std::vector<std::string>& given) {
    words.of[field] = given;
  };
  CLI::Option* list =
      command.add_option_function<std::vector<std::string>>(name_of_option(option), keep, option.help);
  list->group(std::string(option.group));
  if (type_of(option) == ValueType::texts) list->delimiter(',');
}

void add_word(CLI::App& command, const FitOption& option, RecordWords& words) {
  const auto keep = [&words, field = std::string(option.field)](const std::string& given) {
    words.of[field] = {given};
  };
  command.add_option_function<std::string>(name_of_option(option), keep, option.help)
      ->type_name(shown_type(option))
      ->default_str(shown_default(option, default_request()))
      ->group(std::string(option.group));
}

void add_switch(CLI::App& command, const FitOption& option, RecordWords& words) {
  const char* turned = option.inverted ? "false" : "true";
  command
      .add_flag_callback(
          name_of_option(option),
          [&words, turned, field = std::string(option.field)] { words.of[field] = {turned}; }, option.help)
      ->group(std::string(option.group));
}

}  // namespace

const char* shown_type(const FitOption& option) {
  switch (type_of(option)) {
    case ValueType::whole:
      return "INT";
    case ValueType::number:
      return "FLOAT";
    default:
      return "TEXT";
  }
}

std::string shown_default(const FitOption& option, const FitRecord& record) {
  const std::string words = to_words(get_value(option, record));
  if (option.says_default || (option.zero_is_none && words == "0")) return "";
  return option.word && words == fmt::format("{}", option.word->value) ? std::string(option.word->word)
                                                                       : words;
}

FitRecord default_request() {
  FitRecord record;
  record.kind = KindChoice::automatic;
  record.objective = kFitObjective;
  return record;
}

void add_record_options(CLI::App& command, RecordWords& words) {
  for (const FitOption& option : fit_options()) {
    if (option.option.empty()) continue;
    const ValueType type = type_of(option);
    if (type == ValueType::flag)
      add_switch(command, option, words);
    else if (is_list(type))
      add_list(command, option, words);
    else
      add_word(command, option, words);
  }
}

void exclude_record_options(CLI::App& command, CLI::Option& resume, CLI::Option& repeat) {
  for (const FitOption& option : fit_options()) {
    if (option.option.empty()) continue;
    CLI::Option* given = command.get_option(name_of_option(option));
    repeat.excludes(given);
    if (!option.resumable) resume.excludes(given);
  }
}

void apply_words(const RecordWords& words, FitRecord& record) {
  for (const FitOption& option : fit_options())
    if (const auto given = words.of.find(std::string(option.field)); given != words.of.end())
      set_from_words(option, given->second, record);
}

}  // namespace espalier
