#include <algorithm>

#include <espalier/app/options/option_names.h>
#include <espalier/fitting/record/fit_options.h>

namespace espalier {

std::string option_of(const std::string& field) {
  const FitOption* option = find_option(field);
  std::string name(option && !option->option.empty() ? option->option : field);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

}  // namespace espalier
