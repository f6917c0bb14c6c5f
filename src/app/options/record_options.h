// The options of `espalier fit` that make up its record, from the table of a fit's options: the words that a
// user gives, and the record they make.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <espalier/fitting/record/fit_options.h>
#include <espalier/fitting/record/fit_record.h>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace espalier {

/// Words by the field that they are for.
struct RecordWords {
  std::map<std::string, std::vector<std::string>> of;

  bool has(const std::string& field) const { return of.contains(field); }
};

/// What the help shows as the type of an option's value, and as its default; empty where it says it in words.
const char* shown_type(const FitOption& option);
std::string shown_default(const FitOption& option, const FitRecord& record);

/// What `espalier fit` does without any option; its picture comes later.
FitRecord default_request();

/// An option for each row that has one; `words` is filled in when `command` is parsed.
void add_record_options(CLI::App& command, RecordWords& words);

/// `resume` goes with those alone that a run may change when it goes on, `repeat` with none.
void exclude_record_options(CLI::App& command, CLI::Option& resume, CLI::Option& repeat);

/// Sets what the words say. Throws FieldError.
void apply_words(const RecordWords& words, FitRecord& record);

}  // namespace espalier
