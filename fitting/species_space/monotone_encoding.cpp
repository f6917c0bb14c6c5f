// Each row of the table is written by one of a few codecs, after what its values mean: a number, its
// logarithm, a count, a choice, shares of a choice that can be mixed, a flag with its magnitudes; or by the
// codec that the row names.
#include <algorithm>
#include <cmath>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>

namespace espalier {

namespace {

/// One number: a function of the value and its inverse.
class NumberCodec : public ParameterCodec {
 public:
  using Function = double (*)(const ParameterInfo& row, double value);
  NumberCodec(Function write, Function read) : write_(write), read_(read) {}
  CodedNames names(const ParameterInfo& row) const override { return {{{row.full_name()}}, {}}; }
  void write(const ParameterInfo& row, double value, CodedFields fields) const override {
    *fields.numbers = write_(row, value);
  }
  double read(const ParameterInfo& row, CodedFields fields, std::vector<ClampedValue>&) const override {
    return read_(row, *fields.numbers);
  }

 private:
  Function write_, read_;
};

/// Where a logarithm begins, so that zero has one too: well below what a search looks at.
double smallest(const ParameterInfo& row) { return row.lower > 0 ? 0 : 1e-3 * row.search_lower; }

const NumberCodec kLinear([](const ParameterInfo&, double value) { return value; },
                          [](const ParameterInfo&, double number) { return number; });
const NumberCodec kLogarithmic([](const ParameterInfo& row,
                                  double value) { return std::log(value + smallest(row)); },
                               [](const ParameterInfo& row, double number) {
                                 return std::exp(number) - smallest(row);
                               });

/// Counts of children multiply from level to level, so they too blend in logarithm, from none on.
double log_count(double count) { return std::log1p(count); }
double count_of(double number) { return std::expm1(number); }

class ChoiceCodec : public ParameterCodec {
 public:
  CodedNames names(const ParameterInfo& row) const override { return {{}, {row.full_name()}}; }
  void write(const ParameterInfo&, double value, CodedFields fields) const override {
    *fields.choices = value;
  }
  double read(const ParameterInfo&, CodedFields fields, std::vector<ClampedValue>&) const override {
    return *fields.choices;
  }
};

std::string below_zero(const ParameterInfo& row) { return row.full_name() + " is below 0"; }

bool counts_children(const ParameterInfo& row) { return row.relaxable; }

/// A side and one measure for both: how many, along the stem or in a fan.
class OneMeasureCodec : public ParameterCodec {
 public:
  CodedNames names(const ParameterInfo& row) const override {
    return {{{row.full_name()}}, {below_zero(row)}};
  }
  void write(const ParameterInfo& row, double value, CodedFields fields) const override {
    *fields.choices = value < 0;
    *fields.numbers = counts_children(row) ? log_count(std::fabs(value)) : std::fabs(value);
  }
  double read(const ParameterInfo& row, CodedFields fields,
              std::vector<ClampedValue>& clamped) const override {
    const double number = read_magnitude(row, *fields.numbers, clamped);
    const double measure = counts_children(row) ? count_of(number) : number;
    return *fields.choices > 0.5 ? -measure : measure;
  }
};

/// A side, and a magnitude for each. Of two effects that meet at zero the other one is absent, and so zero;
/// of two measures without relation the other one means nothing.
class TwoMeasuresCodec : public ParameterCodec {
 public:
  explicit TwoMeasuresCodec(bool meet_at_zero) : meet_at_zero_(meet_at_zero) {}
  CodedNames names(const ParameterInfo& row) const override {
    const std::string name = row.full_name();
    return {{{name + " below 0", meet_at_zero_}, {name + " from 0", meet_at_zero_}}, {below_zero(row)}};
  }
  void write(const ParameterInfo&, double value, CodedFields fields) const override {
    *fields.choices = value < 0;
    fields.numbers[0] = std::max(0.0, -value);
    fields.numbers[1] = std::max(0.0, value);
  }
  double read(const ParameterInfo& row, CodedFields fields,
              std::vector<ClampedValue>& clamped) const override {
    return *fields.choices > 0.5 ? -read_magnitude(row, fields.numbers[0], clamped)
                                 : read_magnitude(row, fields.numbers[1], clamped);
  }
  bool means(double value, std::size_t number) const override {
    return meet_at_zero_ || (value < 0) == (number == 0);
  }

 private:
  bool meet_at_zero_;
};

const ChoiceCodec kChoice;
const OneMeasureCodec kOneMeasure;
const TwoMeasuresCodec kMeetAtZero(true), kUnrelated(false);

const ParameterCodec& codec_of(const ParameterInfo& row) {
  if (row.codec) return *row.codec;
  if (row.scale == Scale::choice || row.role.role == Role::levels) return kChoice;
  if (row.sign == SignMeaning::flag && row.sides == FlagSides::one_measure) return kOneMeasure;
  if (row.sign == SignMeaning::flag) return row.sides == FlagSides::meet_at_zero ? kMeetAtZero : kUnrelated;
  const bool at_least_one = row.scale == Scale::integer && row.lower >= 1;
  return row.scale == Scale::logarithmic || at_least_one ? kLogarithmic : kLinear;
}

/// A row and where its fields begin.
struct CodedRow {
  const ParameterCodec* codec;  ///< none: written by the row it is mixed into, or not at all
  std::size_t first_column, first_choice;
};

/// A choice of which two can be mixed: rows of the first, the second, and the share of the second; its
/// columns are the shares of all there are.
struct MixedChoice {
  std::size_t first, second, share, first_column, count;
};

class MonotoneEncoding : public Encoding {
 public:
  MonotoneEncoding(const ParameterTable& table, const std::vector<bool>& rows);
  std::string name() const override { return "monotone"; }
  bool levels_are_a_choice() const override { return true; }
  EncodedValues encode(const ParameterValues& values) const override;
  DecodedValues decode(const EncodedValues& encoded) const override;

 private:
  void add_row(std::size_t row, bool is_written);
  void add_mixed(std::size_t row);
  bool is_mixed(std::size_t row) const;
  bool row_means(std::size_t row, const ParameterValues& values) const;
  void write_shares(const MixedChoice& mixed, const ParameterValues& values, EncodedValues& encoded) const;
  void read_shares(const MixedChoice& mixed, const EncodedValues& encoded, ParameterValues& values) const;

  std::vector<CodedRow> rows_;
  std::vector<MixedChoice> mixed_;
  std::optional<std::size_t> levels_row_;
  std::vector<std::vector<std::size_t>> needs_;
};

MonotoneEncoding::MonotoneEncoding(const ParameterTable& table, const std::vector<bool>& rows)
    : Encoding(table), levels_row_(table.find(Role::levels)) {
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (!table.rows[row].mixed_with.empty()) add_mixed(row);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    add_row(row, rows[row]);
    needs_.emplace_back();
    for (const std::string& name : table.rows[row].needs) needs_.back().push_back(table.index_of(name));
  }
}

void MonotoneEncoding::add_mixed(std::size_t row) {
  const ParameterInfo& info = table_->rows[row];
  mixed_.push_back({row, table_->index_of(info.mixed_with), table_->index_of(info.mixed_by), columns_.size(),
                    info.choices.size()});
  for (const std::string& choice : info.choices)
    columns_.push_back({info.full_name() + " " + choice, row, true});
}

bool MonotoneEncoding::is_mixed(std::size_t row) const {
  return std::any_of(mixed_.begin(), mixed_.end(), [row](const MixedChoice& mixed) {
    return row == mixed.first || row == mixed.second || row == mixed.share;
  });
}

void MonotoneEncoding::add_row(std::size_t row, bool is_written) {
  const ParameterCodec* codec = is_mixed(row) || !is_written ? nullptr : &codec_of(table_->rows[row]);
  rows_.push_back({codec, columns_.size(), choices_.size()});
  if (!codec) return;
  const CodedNames names = codec->names(table_->rows[row]);
  for (const CodedNumber& number : names.numbers) columns_.push_back({number.name, row, false, number.fades});
  for (const std::string& choice : names.choices) choices_.push_back({choice, row});
}

bool MonotoneEncoding::row_means(std::size_t row, const ParameterValues& values) const {
  if (levels_row_ && values[*levels_row_] < table_->rows[row].least_levels) return false;
  const std::vector<std::size_t>& needs = needs_[row];
  return needs.empty() ||
         std::any_of(needs.begin(), needs.end(), [&](std::size_t need) { return values[need] != 0; });
}

EncodedValues MonotoneEncoding::encode(const ParameterValues& values) const {
  ESPALIER_CHECK_EQ(values.size(), rows_.size());
  EncodedValues encoded{std::vector<double>(columns_.size()), std::vector<char>(columns_.size(), 1),
                        std::vector<double>(choices_.size())};
  for (const MixedChoice& mixed : mixed_) write_shares(mixed, values, encoded);
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (rows_[row].codec)
      rows_[row].codec->write(table_->rows[row], values[row],
                              {encoded.numbers.data() + rows_[row].first_column,
                               encoded.choices.data() + rows_[row].first_choice});
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const std::size_t row = columns_[column].row;
    if (rows_[row].codec)
      encoded.means[column] =
          row_means(row, values) && rows_[row].codec->means(values[row], column - rows_[row].first_column);
  }
  return encoded;
}

DecodedValues MonotoneEncoding::decode(const EncodedValues& encoded) const {
  ESPALIER_CHECK_EQ(encoded.numbers.size(), columns_.size());
  EncodedValues fields = encoded;
  DecodedValues decoded{table_->defaults(), {}};
  for (const MixedChoice& mixed : mixed_) read_shares(mixed, encoded, decoded.values);
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (rows_[row].codec) {
      const double value = rows_[row].codec->read(
          table_->rows[row],
          {fields.numbers.data() + rows_[row].first_column, fields.choices.data() + rows_[row].first_choice},
          decoded.clamped);
      decoded.values[row] = valid_value(table_->rows[row], value, decoded.clamped);
    }
  return decoded;
}

void MonotoneEncoding::write_shares(const MixedChoice& mixed, const ParameterValues& values,
                                    EncodedValues& encoded) const {
  double* shares = encoded.numbers.data() + mixed.first_column;
  const auto column = [&](std::size_t row) {
    return static_cast<std::size_t>(values[row]) - static_cast<std::size_t>(table_->rows[row].first_choice);
  };
  shares[column(mixed.first)] += 1 - values[mixed.share];
  shares[column(mixed.second)] += values[mixed.share];
}

/// The two largest shares are kept; in a tie the choices that come first.
void MonotoneEncoding::read_shares(const MixedChoice& mixed, const EncodedValues& encoded,
                                   ParameterValues& values) const {
  const double* shares = encoded.numbers.data() + mixed.first_column;
  std::size_t first = 0, second = mixed.count;
  for (std::size_t i = 1; i < mixed.count; ++i)
    if (shares[i] > shares[first])
      second = first, first = i;
    else if (second == mixed.count || shares[i] > shares[second])
      second = i;
  const double kept = shares[first] + std::max(0.0, shares[second]);
  const double share = kept > 0 ? std::max(0.0, shares[second]) / kept : 0;
  const auto choice = [&](std::size_t i) {
    return table_->rows[mixed.first].first_choice + static_cast<double>(i);
  };
  values[mixed.first] = choice(first);
  values[mixed.second] = choice(share > 0 ? second : first);
  values[mixed.share] = std::clamp(share, 0.0, 1.0);
}

}  // namespace

std::unique_ptr<Encoding> make_monotone_encoding(const ParameterTable& table, const std::vector<bool>& rows) {
  return std::make_unique<MonotoneEncoding>(table, rows);
}

}  // namespace espalier
