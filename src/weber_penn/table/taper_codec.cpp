#include <algorithm>

#include <espalier/core/parameter_table.h>
#include <espalier/weber_penn/table/taper_codec.h>

namespace espalier {

namespace {

class TaperCodec : public ParameterCodec {
 public:
  CodedNames names(const ParameterInfo& row) const override {
    const std::string name = row.full_name();
    return {{{name + " narrowing"}, {name + " swelling"}}, {name + " ends round"}};
  }
  void write(const ParameterInfo&, double value, CodedFields fields) const override {
    *fields.choices = value >= 1;
    fields.numbers[0] = value < 1 ? value : std::max(0.0, 2 - value);
    fields.numbers[1] = std::max(0.0, value - 2);
  }
  double read(const ParameterInfo& row, CodedFields fields,
              std::vector<ClampedValue>& clamped) const override {
    const double narrowing = std::min(1.0, read_magnitude(row, fields.numbers[0], clamped));
    return *fields.choices > 0.5 ? 2 - narrowing + read_magnitude(row, fields.numbers[1], clamped)
                                 : narrowing;
  }
};

}  // namespace

const ParameterCodec& taper_codec() {
  static const TaperCodec kCodec;
  return kCodec;
}

}  // namespace espalier
