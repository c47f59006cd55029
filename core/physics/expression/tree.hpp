#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/physics/expression/program.hpp"

namespace drift {

/// One operation of an equation, with where it stands in the text.
struct EquationNode {
  Operation op = Operation::number;
  double number = 0.0;        ///< of a constant
  bool literal = false;       ///< a constant written in figures, which may stand for any unit
  int index = 0;              ///< of an input or a parameter; a whole exponent
  int left = -1, right = -1;  ///< operands among the nodes
  std::size_t at = 0;         ///< character of the text, from 0
};

/// An equation as it was read; operands stand before what is made of them, the whole is last.
struct EquationTree {
  std::vector<EquationNode> nodes;
};

/// What is wrong with an equation.
struct EquationMistake {
  std::size_t at = 0;    ///< character of the text, from 0
  std::string what;      ///< "has the unknown name 'tt'"
  std::string expected;  ///< "one of t, t_position, ..."
  std::string fix;       ///< "Did you mean 't'?"
};

template <class T>
using OrMistake = std::variant<T, EquationMistake>;

}  // namespace drift
