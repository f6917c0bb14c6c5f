// Each row of the table is written by one of a few codecs, after what its values mean: a number, its
// logarithm, a count, a choice, shares of a choice that can be mixed, a flag with its magnitudes, a taper.
#include <algorithm>
#include <cmath>
#include <optional>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>

namespace espalier {

namespace {

/// Numbers and choices of one row, being written or read.
struct Fields {
  double* numbers;
  double* choices;
};

/// Writes one row's value into its fields, and reads it back.
class Codec {
 public:
  virtual ~Codec() = default;
  virtual void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>& columns,
                          std::vector<EncodingChoice>& choices) const = 0;
  virtual void write(const ParameterInfo& row, double value, Fields fields) const = 0;
  /// Notes in `clamped` a magnitude below zero, which is read as none.
  virtual double read(const ParameterInfo& row, Fields fields, std::vector<ClampedValue>& clamped) const = 0;
  /// Whether column `column` of the row means something where the row does.
  virtual bool means(double value, std::size_t column) const {
    (void)value, (void)column;
    return true;
  }
};

/// One number: a function of the value and its inverse.
class NumberCodec : public Codec {
 public:
  using Function = double (*)(const ParameterInfo& row, double value);
  NumberCodec(Function write, Function read) : write_(write), read_(read) {}
  void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>& columns,
                  std::vector<EncodingChoice>&) const override {
    columns.push_back({row.full_name(), index});
  }
  void write(const ParameterInfo& row, double value, Fields fields) const override {
    *fields.numbers = write_(row, value);
  }
  double read(const ParameterInfo& row, Fields fields, std::vector<ClampedValue>&) const override {
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

class ChoiceCodec : public Codec {
 public:
  void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>&,
                  std::vector<EncodingChoice>& choices) const override {
    choices.push_back({row.full_name(), index});
  }
  void write(const ParameterInfo&, double value, Fields fields) const override { *fields.choices = value; }
  double read(const ParameterInfo&, Fields fields, std::vector<ClampedValue>&) const override {
    return *fields.choices;
  }
};

/// Nothing where the number is below zero by more than rounding, which is noted.
double magnitude(const ParameterInfo& row, double number, std::vector<ClampedValue>& clamped) {
  if (number < -1e-9) clamped.push_back({row.full_name(), number, 0});
  return std::max(0.0, number);
}

std::string below_zero(const ParameterInfo& row) { return row.full_name() + " is below 0"; }

bool counts_children(const ParameterInfo& row) { return row.relaxable; }

/// A side and one measure for both: how many, along the stem or in a fan.
class OneMeasureCodec : public Codec {
 public:
  void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>& columns,
                  std::vector<EncodingChoice>& choices) const override {
    columns.push_back({row.full_name(), index});
    choices.push_back({below_zero(row), index});
  }
  void write(const ParameterInfo& row, double value, Fields fields) const override {
    *fields.choices = value < 0;
    *fields.numbers = counts_children(row) ? log_count(std::fabs(value)) : std::fabs(value);
  }
  double read(const ParameterInfo& row, Fields fields, std::vector<ClampedValue>& clamped) const override {
    const double number = magnitude(row, *fields.numbers, clamped);
    const double measure = counts_children(row) ? count_of(number) : number;
    return *fields.choices > 0.5 ? -measure : measure;
  }
};

/// A side, and a magnitude for each. Of two effects that meet at zero the other one is absent, and so zero;
/// of two measures without relation the other one means nothing.
class TwoMeasuresCodec : public Codec {
 public:
  explicit TwoMeasuresCodec(bool meet_at_zero) : meet_at_zero_(meet_at_zero) {}
  void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>& columns,
                  std::vector<EncodingChoice>& choices) const override {
    columns.push_back({row.full_name() + " below 0", index, false, meet_at_zero_});
    columns.push_back({row.full_name() + " from 0", index, false, meet_at_zero_});
    choices.push_back({below_zero(row), index});
  }
  void write(const ParameterInfo&, double value, Fields fields) const override {
    *fields.choices = value < 0;
    fields.numbers[0] = std::max(0.0, -value);
    fields.numbers[1] = std::max(0.0, value);
  }
  double read(const ParameterInfo& row, Fields fields, std::vector<ClampedValue>& clamped) const override {
    return *fields.choices > 0.5 ? -magnitude(row, fields.numbers[0], clamped)
                                 : magnitude(row, fields.numbers[1], clamped);
  }
  bool means(double value, std::size_t column) const override {
    return meet_at_zero_ || (value < 0) == (column == 0);
  }

 private:
  bool meet_at_zero_;
};

/// Open or round end, how much the stem narrows, how much it swells [CH, Appendix C].
class TaperCodec : public Codec {
 public:
  void add_fields(const ParameterInfo& row, std::size_t index, std::vector<EncodingColumn>& columns,
                  std::vector<EncodingChoice>& choices) const override {
    columns.push_back({row.full_name() + " narrowing", index});
    columns.push_back({row.full_name() + " swelling", index});
    choices.push_back({row.full_name() + " ends round", index});
  }
  void write(const ParameterInfo&, double value, Fields fields) const override {
    *fields.choices = value >= 1;
    fields.numbers[0] = value < 1 ? value : std::max(0.0, 2 - value);
    fields.numbers[1] = std::max(0.0, value - 2);
  }
  double read(const ParameterInfo& row, Fields fields, std::vector<ClampedValue>& clamped) const override {
    const double narrowing = std::min(1.0, magnitude(row, fields.numbers[0], clamped));
    return *fields.choices > 0.5 ? 2 - narrowing + magnitude(row, fields.numbers[1], clamped) : narrowing;
  }
};

const ChoiceCodec kChoice;
const OneMeasureCodec kOneMeasure;
const TwoMeasuresCodec kMeetAtZero(true), kUnrelated(false);
const TaperCodec kTaper;

const Codec& codec_of(const ParameterTable& table, const ParameterInfo& row) {
  const std::string name = row.full_name();
  if (row.scale == Scale::choice || name == table.levels_row) return kChoice;
  if (row.regimes == Regimes::taper) return kTaper;
  if (row.sign == SignMeaning::flag && row.sides == FlagSides::one_measure) return kOneMeasure;
  if (row.sign == SignMeaning::flag) return row.sides == FlagSides::meet_at_zero ? kMeetAtZero : kUnrelated;
  const bool at_least_one = row.scale == Scale::integer && row.lower >= 1;
  return row.scale == Scale::logarithmic || at_least_one ? kLogarithmic : kLinear;
}

/// A row and where its fields begin.
struct CodedRow {
  const Codec* codec;  ///< none: written by the row it is mixed into
  std::size_t first_column, first_choice;
};

/// A choice of which two can be mixed: rows of the first, the second, and the share of the second; its
/// columns are the shares of all there are.
struct MixedChoice {
  std::size_t first, second, share, first_column, count;
};

class MonotoneEncoding : public Encoding {
 public:
  explicit MonotoneEncoding(const ParameterTable& table);
  std::string name() const override { return "monotone"; }
  bool levels_are_a_choice() const override { return true; }
  EncodedValues encode(const ParameterValues& values) const override;
  DecodedValues decode(const EncodedValues& encoded) const override;

 private:
  void add_row(std::size_t row);
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

MonotoneEncoding::MonotoneEncoding(const ParameterTable& table)
    : Encoding(table), levels_row_(table.find(table.levels_row)) {
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (!table.rows[row].mixed_with.empty()) add_mixed(row);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    add_row(row);
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

void MonotoneEncoding::add_row(std::size_t row) {
  const Codec* codec = is_mixed(row) ? nullptr : &codec_of(*table_, table_->rows[row]);
  rows_.push_back({codec, columns_.size(), choices_.size()});
  if (codec) codec->add_fields(table_->rows[row], row, columns_, choices_);
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

std::unique_ptr<Encoding> make_monotone_encoding(const ParameterTable& table) {
  return std::make_unique<MonotoneEncoding>(table);
}

}  // namespace espalier
