// The options of a fit as a table: one row for each member of FitRecord that describes what is asked for.
// From the rows are made the check of a record, run.toml and its reading [fit_record.h], the options of
// `espalier fit` and what goes on with a run may not change, the keys of experiments, and
// docs/fit_options.md. A new option is a member of FitRecord and a row here.
#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <espalier/fitting/record/fit_record.h>

namespace espalier {

/// What a member holds, in the few types that files know; monostate: an optional without a value.
using OptionValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::string>,
                 std::map<std::string, double>, std::vector<ViewRecord>>;

template <typename Type>
using Member = Type& (*)(FitRecord&);

/// Where in a record the value is, and thereby of which type.
using OptionMember =
    std::variant<Member<bool>, Member<int>, Member<long>, Member<Seed>, Member<double>,
                 Member<std::optional<double>>, Member<std::string>, Member<std::vector<std::string>>,
                 Member<std::map<std::string, double>>, Member<std::vector<ViewRecord>>, Member<KindChoice>,
                 Member<SeparationMethod>, Member<TreeSide>, Member<LabelChoice>, Member<FitStages>>;

/// A word for a number that means something else than an amount.
struct NumberWord {
  std::string_view word;
  std::int64_t value;
};

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct FitOption {
  std::string_view field;        ///< of FitRecord, as C++ names it: "budget.seconds"
  std::string_view key;          ///< its path in run.toml: "search.fixed"
  std::string_view option = {};  ///< of `espalier fit`, without its dashes; empty where a user cannot say it
  std::string_view group = {};   ///< under which its help stands
  OptionMember member;
  std::string_view unit = {};                      ///< "px", "m", "s"
  double lower = -kUnbounded, upper = kUnbounded;  ///< of numbers, both included
  bool zero_is_none = false;  ///< 0 in a record says that there is none; nobody asks for 0
  std::optional<NumberWord> word = {};
  std::string_view expected = {};                    ///< of texts that have a grammar of their own
  void (*check)(const FitRecord& record) = nullptr;  ///< what range and choices do not say; throws
  /// Of an assignment name=value: the value. Throws.
  double (*assigned)(const FitRecord& record, const std::string& name, const std::string& text) = nullptr;
  std::string help = {};                                  ///< one line
  std::string_view note = {};                             ///< in run.toml, after the value
  bool (*is_written)(const FitRecord& record) = nullptr;  ///< in run.toml; null: always
  std::string_view since = "0.1";                         ///< version of the program
  std::optional<OptionValue> before = {};  ///< what records without the key mean; none: all have it
  bool resumable = false;                  ///< a run that goes on may have another value
  bool inverted = false;                   ///< the option is a flag that turns the member off
  bool says_default = false;               ///< help says what it is without the option
  std::string_view experiment_list = {};   ///< key of an experiment that lists values to compare
};

/// In the order of run.toml.
const std::vector<FitOption>& fit_options();

/// Null where no row has this field.
const FitOption* find_option(std::string_view field);

/// The key of an experiment's [fits] that sets it for all runs: "fit_seeds"; empty where a list varies it, or
/// no user can say it.
std::string experiment_key(const FitOption& option);

}  // namespace espalier
