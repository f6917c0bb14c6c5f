// An encoding writes the values of a plant as numbers that can be averaged, and reads them back. `raw` is the
// parameter list as it is [CH §3.3.1]; `monotone` parts what a flag says from how much of it there is, so
// that a number in between means something in between (docs/species_space.md). Both are made from the
// parameter table, whatever the model.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <espalier/core/parameter_codec.h>
#include <espalier/core/parameter_table.h>

namespace espalier {

/// What one number of an encoded plant stands for.
struct EncodingColumn {
  std::string name;       ///< "curve[1]", "rotate[1] below 0", "shape conical"
  std::size_t row = 0;    ///< of the table
  bool is_share = false;  ///< of a choice that can be mixed, which is written over several rows
  bool fades =
      false;  ///< one of two effects that meet at zero: nothing is left of it where the other takes over
};

/// One of a few kinds, which has nothing in between: "leaf_shape", "rotate[1] is below 0".
struct EncodingChoice {
  std::string name;
  std::size_t row = 0;
};

struct EncodedValues {
  std::vector<double> numbers;  ///< one a column; valid also where they mean nothing
  std::vector<char> means;      ///< one a column: 0 where the number means nothing to this plant
  std::vector<double> choices;  ///< one a choice
};

struct DecodedValues {
  ParameterValues values;  ///< valid
  std::vector<ClampedValue> clamped;
};

class Encoding {
 public:
  virtual ~Encoding() = default;
  virtual std::string name() const = 0;
  const ParameterTable& table() const { return *table_; }
  const std::vector<EncodingColumn>& columns() const { return columns_; }
  const std::vector<EncodingChoice>& choices() const { return choices_; }
  /// True where plants of different depth are to be written with equally many levels first (Model::deepened).
  virtual bool levels_are_a_choice() const = 0;

  virtual EncodedValues encode(const ParameterValues& values) const = 0;
  /// Valid values for any numbers: whole where they must be, inside their bounds, -0 as 0.
  virtual DecodedValues decode(const EncodedValues& encoded) const = 0;

 protected:
  explicit Encoding(const ParameterTable& table) : table_(&table) {}
  const ParameterTable* table_;
  std::vector<EncodingColumn> columns_;
  std::vector<EncodingChoice> choices_;
};

/// "raw" or "monotone". Throws InputError for any other name. `table` must outlive the encoding.
std::unique_ptr<Encoding> make_encoding(const std::string& name, const ParameterTable& table);
/// Of some rows only; the others have their defaults in all plants.
std::unique_ptr<Encoding> make_encoding(const std::string& name, const ParameterTable& table,
                                        const std::vector<bool>& rows);

std::unique_ptr<Encoding> make_raw_encoding(const ParameterTable& table, const std::vector<bool>& rows);
std::unique_ptr<Encoding> make_monotone_encoding(const ParameterTable& table, const std::vector<bool>& rows);

/// Whether the magnitudes of a row with a side are all zero, or mean nothing to this plant: then they say
/// nothing about the side.
bool is_nothing(const Encoding& encoding, const EncodedValues& plant, std::size_t row);

/// The nearest valid value of a row. Notes it in `clamped` where `value` is outside the bounds by more than
/// rounding.
double valid_value(const ParameterInfo& row, double value, std::vector<ClampedValue>& clamped);

}  // namespace espalier
