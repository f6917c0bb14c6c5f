// The instructions of a Program, each an operation on a block of modules.
#include <array>

#include <espalier/lsystem/expressions/operations.h>
#include <espalier/lsystem/expressions/program.h>

namespace espalier::lsystem {

namespace {

class Runner {
 public:
  Runner(const Program& program, const ProgramInputs& inputs, std::vector<double>& scratch)
      : program_(program), inputs_(inputs), stride_(inputs.count <= 1 ? 1 : kBlockSize), scratch_(scratch) {
    if (scratch_.size() < program.temporaries * stride_) scratch_.resize(program.temporaries * stride_);
  }

  Column column(Operand operand) const {
    switch (operand.kind) {
      case Operand::Kind::column:
        return inputs_.columns[operand.index];
      case Operand::Kind::global:
        return {inputs_.globals + operand.index, 0};
      case Operand::Kind::literal:
        return {program_.literals.data() + operand.index, 0};
      case Operand::Kind::temporary:
        return {scratch_.data() + operand.index * stride_, strides_[operand.index]};
    }
    return {};
  }

  void run(const Instruction& instruction) {
    OpArguments in{
        column(instruction.a), column(instruction.b), column(instruction.c), inputs_.keys, nullptr, 0,
        inputs_.surroundings,  inputs_.curves,        instruction.object};
    const bool varies = in.a.stride + in.b.stride + in.c.stride > 0 || instruction.op == Op::random;
    in.count = varies ? inputs_.count : 1;
    in.target = scratch_.data() + instruction.target * stride_;
    strides_[instruction.target] = varies ? 1 : 0;
    kOperations[static_cast<std::size_t>(instruction.op)].run(in);
  }

 private:
  const Program& program_;
  const ProgramInputs& inputs_;
  const std::size_t
      stride_;  ///< from temporary to temporary: constants of a file are many, and one value each
  std::vector<double>& scratch_;
  std::array<std::uint8_t, 256> strides_{};
};

}  // namespace

Column run_program(const Program& program, const ProgramInputs& inputs, std::vector<double>& scratch) {
  Runner runner(program, inputs, scratch);
  for (const Instruction& instruction : program.code) runner.run(instruction);
  return runner.column(program.result);
}

double random_unit(RandomKey key, std::uint32_t site) {
  return static_cast<double>(random_bits(key, site) >> 11) * 0x1p-53;
}

}  // namespace espalier::lsystem
