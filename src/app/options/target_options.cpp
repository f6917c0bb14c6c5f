#include <CLI/CLI.hpp>
#include <string>

#include <espalier/app/options/option_names.h>
#include <espalier/app/options/record_options.h>
#include <espalier/app/options/target_options.h>
#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/option_values.h>

namespace espalier {

namespace {

/// Sizes, trees and labels are for the commands to say: not all of them look at these.
bool is_of_reading(const FitOption& option) {
  const bool is_of_target = option.field.starts_with("target.") && !option.option.empty();
  return is_of_target && option.field != "target.size_px" && option.field != "target.one_tree" &&
         option.field != "target.labels";
}

void add_row(CLI::App& command, const FitOption& option, const std::shared_ptr<FitRecord>& record) {
  const auto set = [&option, record](const std::string& word) {
    set_from_words(option, {word}, *record);
    check_option(option, *record);
  };
  if (type_of(option) == ValueType::flag) {
    command.add_flag_callback(
        option_of(std::string(option.field)), [set] { set("true"); }, option.help);
    return;
  }
  command.add_option_function<std::string>(option_of(std::string(option.field)), set, option.help)
      ->type_name(shown_type(option))
      ->default_str(shown_default(option, *record));
}

}  // namespace

std::shared_ptr<TargetOptions> add_target_options(CLI::App& command) {
  const auto record = std::make_shared<FitRecord>();
  record->target = TargetOptions{};
  for (const FitOption& option : fit_options())
    if (is_of_reading(option) && !command.get_option_no_throw(option_of(std::string(option.field))))
      add_row(command, option, record);
  return {record, &record->target};
}

}  // namespace espalier
