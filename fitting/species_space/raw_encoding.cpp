// The parameter list as it is: one number a row, all of them always mean something [CH §3.3.1]. Its fault is
// known [CH §4.4.1]: halfway between two kinds of thing lies a third that is neither.
#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>

namespace espalier {

namespace {

class RawEncoding : public Encoding {
 public:
  explicit RawEncoding(const ParameterTable& table) : Encoding(table) {
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      columns_.push_back({table.rows[row].full_name(), row});
  }
  std::string name() const override { return "raw"; }
  bool levels_are_a_choice() const override { return false; }

  EncodedValues encode(const ParameterValues& values) const override {
    return {values, std::vector<char>(values.size(), 1), {}};
  }

  DecodedValues decode(const EncodedValues& encoded) const override {
    ESPALIER_CHECK_EQ(encoded.numbers.size(), columns_.size());
    DecodedValues decoded;
    for (std::size_t row = 0; row < columns_.size(); ++row)
      decoded.values.push_back(valid_value(table_->rows[row], encoded.numbers[row], decoded.clamped));
    return decoded;
  }
};

}  // namespace

std::unique_ptr<Encoding> make_raw_encoding(const ParameterTable& table) {
  return std::make_unique<RawEncoding>(table);
}

}  // namespace espalier
