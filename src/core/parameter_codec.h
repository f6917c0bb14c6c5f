// How the value of one parameter is written as numbers that can be averaged, and choices that cannot: what a
// species space and a blend of two plants are made of. A model whose values mean something else from one
// range to the next names a codec of its own in the parameter's row; the rest follows from the row.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace espalier {

struct ParameterInfo;  // core/parameter_table.h

/// Numbers and choices of one row, being written or read.
struct CodedFields {
  double* numbers;
  double* choices;
};

/// One number that a row is written as.
struct CodedNumber {
  std::string name;    ///< "curve[1]", "rotate[1] below 0"
  bool fades = false;  ///< one of two effects that meet at zero: nothing is left of it where the other begins
};

/// What a row is written as: names of its numbers, and of its choices.
struct CodedNames {
  std::vector<CodedNumber> numbers;
  std::vector<std::string> choices;
};

/// A value that was moved into its bounds.
struct ClampedValue {
  std::string parameter;  ///< full name
  double wanted = 0, got = 0;
};

/// Writes one row's value into its fields, and reads it back.
class ParameterCodec {
 public:
  virtual ~ParameterCodec() = default;
  virtual CodedNames names(const ParameterInfo& row) const = 0;
  virtual void write(const ParameterInfo& row, double value, CodedFields fields) const = 0;
  /// Notes in `clamped` a magnitude below zero, which is read as none.
  virtual double read(const ParameterInfo& row, CodedFields fields,
                      std::vector<ClampedValue>& clamped) const = 0;
  /// Whether number `number` of the row means something where the row does.
  virtual bool means(double value, std::size_t number) const {
    (void)value, (void)number;
    return true;
  }
};

/// `number`, or nothing where it is below zero; by more than rounding, that is noted.
double read_magnitude(const ParameterInfo& row, double number, std::vector<ClampedValue>& clamped);

}  // namespace espalier
