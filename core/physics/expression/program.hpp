#pragma once

#include <array>
#include <cstdint>

namespace drift {

/// What one step of a program does: it takes its operands from the stack and leaves its result
/// there.
enum class Operation : std::uint8_t {
  number,     ///< a constant
  input,      ///< what the platform is at this instant, by index
  parameter,  ///< by index
  add,
  subtract,
  multiply,
  divide,
  power,        ///< any exponent, of a base that is not negative
  whole_power,  ///< `index`, a whole exponent
  minimum,
  maximum,
  negate,
  sine,
  cosine,
  tangent,
  exponential,
  logarithm,
  root,
  absolute,
  hyperbolic_tangent,
  arc_tangent,
  step,  ///< 1 above zero, else 0
  sign,  ///< 1, 0 or -1
};

/// How many operands an operation takes.
constexpr int operands_of(Operation op) {
  if (op <= Operation::parameter) return 0;
  return op == Operation::whole_power || op >= Operation::negate ? 1 : 2;
}

struct Instruction {
  Operation op = Operation::number;
  std::int16_t index = 0;
  double number = 0.0;
};

/// An equation made ready to be evaluated: in postfix order, of limited length, so that evaluating
/// it allocates nothing.
struct EquationProgram {
  static constexpr std::size_t longest = 64;  ///< instructions
  static constexpr std::size_t deepest = 16;  ///< numbers that wait for their operation at once
  std::array<Instruction, longest> code{};
  std::size_t size = 0;
};

}  // namespace drift
