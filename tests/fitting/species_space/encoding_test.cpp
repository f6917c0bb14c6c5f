// Encodings lose nothing that means something, and read anything as a valid plant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <espalier/core/error.h>
#include <espalier/fitting/species_space/encoding.h>
#include <espalier/models/models.h>
#include <espalier/models/preset.h>

namespace espalier {
namespace {

const ParameterTable& table() { return model_by_name("weber_penn").table(); }

double random_valid(const ParameterInfo& row) {
  const double value = row.lower + *rc::gen::inRange(0, 1'000'001) * 1e-6 * (row.upper - row.lower);
  const bool whole = row.scale == Scale::choice || (row.scale == Scale::integer && !row.relaxable);
  return (whole ? std::round(value) : value) + 0.0;
}

ParameterValues random_values() {
  ParameterValues values;
  for (const ParameterInfo& row : table().rows) values.push_back(random_valid(row));
  return values;
}

bool column_means(const Encoding& encoding, const EncodedValues& encoded, const std::string& name) {
  for (std::size_t i = 0; i < encoded.means.size(); ++i)
    if (encoding.columns()[i].name == name) return encoded.means[i] != 0;
  ADD_FAILURE() << "no column " << name;
  return false;
}

RC_GTEST_PROP(Encoding, RawIsTheParameterListItself, ()) {
  const auto encoding = make_encoding("raw", table());
  const ParameterValues values = random_values();
  RC_ASSERT(encoding->encode(values).numbers == values);
  RC_ASSERT(encoding->decode(encoding->encode(values)).values == values);
}

RC_GTEST_PROP(Encoding, MonotoneReadsBackWhatItWrote, ()) {
  const auto encoding = make_encoding("monotone", table());
  const ParameterValues values = random_values();
  const DecodedValues decoded = encoding->decode(encoding->encode(values));
  RC_ASSERT(decoded.clamped.empty());
  for (std::size_t row = 0; row < values.size(); ++row) {
    const std::string& name = table().rows[row].name;
    if (name.starts_with("shape")) continue;  // shares: the same crown, perhaps with its two shapes swapped
    RC_ASSERT(std::fabs(decoded.values[row] - values[row]) <= 1e-9 * std::max(1.0, std::fabs(values[row])));
  }
  const EncodedValues once = encoding->encode(values), twice = encoding->encode(decoded.values);
  for (std::size_t column = 0; column < once.numbers.size(); ++column)
    RC_ASSERT(std::fabs(once.numbers[column] - twice.numbers[column]) <= 1e-6);
}

RC_GTEST_PROP(Encoding, ReadsAnyNumbersAsAValidPlant, ()) {
  for (const char* name : {"raw", "monotone"}) {
    const auto encoding = make_encoding(name, table());
    EncodedValues encoded = encoding->encode(random_values());
    for (double& number : encoded.numbers) number *= *rc::gen::inRange(-1000, 1000);
    const DecodedValues decoded = encoding->decode(encoded);
    for (std::size_t row = 0; row < decoded.values.size(); ++row)
      check_value(table().rows[row], decoded.values[row], name);
  }
}

TEST(Encoding, LevelsThatAPlantHasNotMeanNothing) {
  const auto encoding = make_encoding("monotone", table());
  const EncodedValues three_levels = encoding->encode(load_preset("quaking_aspen").values);
  EXPECT_TRUE(column_means(*encoding, three_levels, "length[2]"));
  EXPECT_FALSE(column_means(*encoding, three_levels, "length[3]"));
  EXPECT_TRUE(column_means(*encoding, three_levels, "down_angle[3]")) << "leaves are placed by it";
  const EncodedValues four_levels = encoding->encode(load_preset("weeping_willow").values);
  EXPECT_TRUE(column_means(*encoding, four_levels, "length[3]"));
}

TEST(Encoding, WhatNeedsSomethingElseMeansNothingWithoutIt) {
  const auto encoding = make_encoding("monotone", table());
  const EncodedValues aspen = encoding->encode(load_preset("quaking_aspen").values);
  EXPECT_FALSE(column_means(*encoding, aspen, "split_angle[0] from 0")) << "no splits";
  EXPECT_FALSE(column_means(*encoding, aspen, "prune_width"));
  const EncodedValues acer = encoding->encode(load_preset("acer").values);
  EXPECT_TRUE(column_means(*encoding, acer, "split_angle[0] from 0"));
}

TEST(Encoding, OfTwoMeasuresWithoutRelationOneMeansNothing) {
  const auto encoding = make_encoding("monotone", table());
  const EncodedValues willow = encoding->encode(load_preset("weeping_willow").values);
  EXPECT_TRUE(column_means(*encoding, willow, "rotate[1] below 0"));
  EXPECT_FALSE(column_means(*encoding, willow, "rotate[1] from 0"));
}

TEST(Encoding, ClampsAndSaysSo) {
  const auto encoding = make_encoding("raw", table());
  ParameterValues values = table().defaults();
  const std::size_t row = table().index_of("base_size[1]");
  values[row] = 7;
  const DecodedValues decoded = encoding->decode({values, {}, {}});
  ASSERT_EQ(decoded.clamped.size(), 1u);
  EXPECT_EQ(decoded.clamped[0].parameter, "base_size[1]");
  EXPECT_EQ(decoded.clamped[0].wanted, 7);
  EXPECT_EQ(decoded.clamped[0].got, 0.99);
  EXPECT_EQ(decoded.values[row], 0.99);
}

/// Sign and size.
class SignCodec : public ParameterCodec {
 public:
  CodedNames names(const ParameterInfo& row) const override {
    return {{{row.name + " size"}}, {row.name + " sign"}};
  }
  void write(const ParameterInfo&, double value, CodedFields fields) const override {
    *fields.numbers = std::fabs(value);
    *fields.choices = value < 0 ? -1 : 1;
  }
  double read(const ParameterInfo& row, CodedFields fields,
              std::vector<ClampedValue>& clamped) const override {
    return *fields.choices * read_magnitude(row, *fields.numbers, clamped);
  }
};

TEST(Encoding, ARowIsWrittenByTheCodecItNames) {
  const SignCodec codec;
  ParameterTable toy{"toy", {}};
  toy.rows.resize(2);
  toy.rows[1].name = "tilt";
  toy.rows[1].lower = -9, toy.rows[1].upper = 9;
  toy.rows[1].codec = &codec;
  const auto encoding = make_encoding("monotone", toy);
  ASSERT_EQ(encoding->columns().size(), 2u);
  EXPECT_EQ(encoding->columns()[1].name, "tilt size");
  EXPECT_EQ(encoding->choices()[0].name, "tilt sign");
  EncodedValues encoded = encoding->encode({0, -3});
  EXPECT_EQ(encoded.numbers[1], 3);
  EXPECT_EQ(encoding->decode(encoded).values[1], -3);
  encoded.numbers[1] = -2;
  const DecodedValues decoded = encoding->decode(encoded);
  EXPECT_EQ(decoded.values[1], 0);
  ASSERT_EQ(decoded.clamped.size(), 1u);
  EXPECT_EQ(decoded.clamped[0].parameter, "tilt");
}

TEST(Encoding, ATaperIsNarrowingSwellingAndTheFormOfItsEnd) {
  const auto encoding = make_encoding("monotone", table());
  ParameterValues values = table().defaults();
  const std::size_t row = table().index_of("taper[0]");
  const auto column = [&](const EncodedValues& encoded, const std::string& name) {
    for (std::size_t i = 0; i < encoded.numbers.size(); ++i)
      if (encoding->columns()[i].name == name) return encoded.numbers[i];
    ADD_FAILURE() << "no column " << name;
    return 0.0;
  };
  const struct {
    double taper, narrowing, swelling;
  } kCases[] = {{0.75, 0.75, 0}, {1.5, 0.5, 0}, {2.25, 0, 0.25}};
  for (const auto& expected : kCases) {
    values[row] = expected.taper;
    const EncodedValues encoded = encoding->encode(values);
    EXPECT_EQ(column(encoded, "taper[0] narrowing"), expected.narrowing);
    EXPECT_EQ(column(encoded, "taper[0] swelling"), expected.swelling);
    EXPECT_EQ(encoding->decode(encoded).values[row], expected.taper);
  }
}

TEST(Encoding, RefusesAnUnknownName) { EXPECT_THROW(make_encoding("pca", table()), InputError); }

}  // namespace
}  // namespace espalier
