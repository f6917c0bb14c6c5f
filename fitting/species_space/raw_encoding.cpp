// The parameter list as it is: one number a row, all of them always mean something [CH §3.3.1]. Its fault is
// known [CH §4.4.1]: halfway between two kinds of thing lies a third that is neither.
#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>

namespace espalier {

namespace {

class RawEncoding : public Encoding {
 public:
  RawEncoding(const ParameterTable& table, const std::vector<bool>& rows) : Encoding(table) {
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (rows[row]) columns_.push_back({table.rows[row].full_name(), row});
  }
  std::string name() const override { return "raw"; }
  bool levels_are_a_choice() const override { return false; }

  EncodedValues encode(const ParameterValues& values) const override {
    EncodedValues encoded{{}, std::vector<char>(columns_.size(), 1), {}};
    encoded.numbers.reserve(columns_.size());
    for (const EncodingColumn& column : columns_) encoded.numbers.push_back(values[column.row]);
    return encoded;
  }

  DecodedValues decode(const EncodedValues& encoded) const override {
    ESPALIER_CHECK_EQ(encoded.numbers.size(), columns_.size());
    DecodedValues decoded{table_->defaults(), {}};
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::size_t row = columns_[i].row;
      decoded.values[row] = valid_value(table_->rows[row], encoded.numbers[i], decoded.clamped);
    }
    return decoded;
  }
};

}  // namespace

std::unique_ptr<Encoding> make_raw_encoding(const ParameterTable& table, const std::vector<bool>& rows) {
  return std::make_unique<RawEncoding>(table, rows);
}

}  // namespace espalier
