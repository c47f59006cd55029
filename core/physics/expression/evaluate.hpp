#pragma once

#include "core/physics/expression/functions.hpp"
#include "core/physics/expression/program.hpp"

namespace drift {

/// An operation on one number.
template <class S>
S apply_operation(const Instruction& step, const S& x) {
  using std::abs;
  using std::cos;
  using std::exp;
  using std::sin;
  using std::tanh;
  switch (step.op) {
    case Operation::whole_power:
      return whole_power(x, step.index);
    case Operation::sine:
      return sin(x);
    case Operation::cosine:
      return cos(x);
    case Operation::tangent:
      return sin(x) / cos(x);
    case Operation::exponential:
      return exp(x);
    case Operation::logarithm:
      return log_of(x);
    case Operation::root:
      return root_of(x);
    case Operation::absolute:
      return abs(x);
    case Operation::hyperbolic_tangent:
      return tanh(x);
    case Operation::arc_tangent:
      return arc_tangent(x);
    case Operation::step:
      return step_at(x);
    case Operation::sign:
      return sign_of(x);
    default:
      return -x;
  }
}

/// An operation on two.
template <class S>
S apply_operation(Operation op, const S& a, const S& b) {
  switch (op) {
    case Operation::add:
      return a + b;
    case Operation::subtract:
      return a - b;
    case Operation::multiply:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::power:
      return any_power(a, b);
    case Operation::minimum:
      return smaller_of(a, b);
    default:
      return larger_of(a, b);
  }
}

/// The value of a program, 0 for an empty one. input(index): what the platform is, as S.
template <class S, class Input>
S evaluate_program(const EquationProgram& program, const S* parameters, Input&& input) {
  if (program.size == 0) return S(0.0);
  std::array<S, EquationProgram::deepest> stack;
  std::size_t top = 0;  // of the stack, the next free place
  for (std::size_t k = 0; k < program.size; ++k) {
    const Instruction& step = program.code[k];
    switch (operands_of(step.op)) {
      case 0:
        stack[top++] = step.op == Operation::number  ? S(step.number)
                       : step.op == Operation::input ? input(step.index)
                                                     : parameters[step.index];
        break;
      case 1:
        stack[top - 1] = apply_operation(step, stack[top - 1]);
        break;
      default:
        --top;
        stack[top - 1] = apply_operation(step.op, stack[top - 1], stack[top]);
    }
  }
  return stack[0];
}

}  // namespace drift
