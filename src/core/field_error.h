// Errors in a field of a record. Whoever throws names the field as C++ does; whoever let somebody fill it in
// catches and says it in his words: a key and its line to the author of a file, an option to the user of a
// command. Nobody in between needs to know who asked.
#pragma once
#include <utility>

#include <espalier/core/error.h>

namespace espalier {

struct FieldError : InputError {
  FieldError(std::string of_field, std::string what_is_wrong)
      : InputError(of_field + ": " + what_is_wrong),
        field(std::move(of_field)),
        complaint(std::move(what_is_wrong)) {}

  std::string field;      ///< "budget.seconds"
  std::string complaint;  ///< "got …, expected …"
};

template <typename... Args>
[[noreturn]] void throw_field_error(std::string_view field, fmt::format_string<Args...> format,
                                    Args&&... args) {
  throw FieldError(std::string(field), fmt::format(format, std::forward<Args>(args)...));
}

/// Does `work`, whose every InputError concerns `field`.
template <typename Work>
auto in_field(std::string_view field, Work work) {
  try {
    return work();
  } catch (const FieldError&) {
    throw;
  } catch (const InputError& error) {
    throw FieldError(std::string(field), error.what());
  }
}

/// Does `work`; where it complains of a field, `place(field)` opens the message instead.
template <typename Place, typename Work>
auto with_places(Place place, Work work) {
  try {
    return work();
  } catch (const FieldError& error) {
    throw InputError(place(error.field) + ": " + error.complaint);
  }
}

}  // namespace espalier
