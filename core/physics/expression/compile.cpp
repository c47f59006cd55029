#include "core/physics/expression/compile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/physics/expression/evaluate.hpp"

namespace drift {
namespace {

class ProgramWriter {
 public:
  explicit ProgramWriter(const EquationTree& tree) : tree_(tree) {}

  EquationProgram write() {
    put(static_cast<int>(tree_.nodes.size()) - 1);
    return program_;
  }

 private:
  void put(int k) {
    const EquationNode& node = tree_.nodes[static_cast<std::size_t>(k)];
    if (node.left >= 0) put(node.left);
    if (node.right >= 0) put(node.right);
    if (folded(node)) return;
    if (program_.size == EquationProgram::longest)
      throw EquationMistake{
          node.at, "is too long",
          fmt::format("at most {} numbers, names and operations", EquationProgram::longest),
          "Shorten it, or split it into two terms"};
    depth_ += 1 - operands_of(node.op);
    if (depth_ > static_cast<int>(EquationProgram::deepest))
      throw EquationMistake{
          node.at, "is nested too deeply",
          fmt::format("at most {} values that wait for their operation", EquationProgram::deepest),
          "Put the longer operand first, or split the equation into two terms"};
    program_.code[program_.size++] = {node.op, static_cast<std::int16_t>(node.index), node.number};
  }
  /// Replaces an operation whose operands are constants by its result.
  bool folded(const EquationNode& node) {
    const auto wanted = static_cast<std::size_t>(operands_of(node.op));
    if (wanted == 0 || program_.size < wanted) return false;
    auto* const last = program_.code.data() + program_.size - wanted;
    if (!std::all_of(last, last + wanted,
                     [](const Instruction& i) { return i.op == Operation::number; }))
      return false;
    const Instruction step{node.op, static_cast<std::int16_t>(node.index), 0.0};
    last->number = wanted == 1 ? apply_operation(step, last->number)
                               : apply_operation(node.op, last[0].number, last[1].number);
    program_.size -= wanted - 1;
    depth_ -= static_cast<int>(wanted) - 1;
    return true;
  }

  const EquationTree& tree_;
  EquationProgram program_;
  int depth_ = 0;
};

}  // namespace

OrMistake<EquationProgram> compile_tree(const EquationTree& tree) {
  try {
    return ProgramWriter(tree).write();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
}

}  // namespace drift
