#include "core/physics/expression/degree.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drift {
namespace {

/// How a part of an equation depends on the amplitudes.
enum class Degree { none, proportional };

class DegreeChecker {
 public:
  DegreeChecker(const EquationTree& tree, const std::vector<bool>& amplitude,
                const std::vector<std::string>& names)
      : tree_(tree), amplitude_(amplitude), names_(names) {}

  void check() {
    for (const EquationNode& node : tree_.nodes) {
      known_.push_back(of(node));
      inside_.push_back(amplitude_in(node));
    }
    if (known_.back() == Degree::none) {
      const auto lost = std::ranges::find(amplitude_, true) - amplitude_.begin();
      fail(tree_.nodes.back(), "is not proportional to an amplitude",
           names_[static_cast<std::size_t>(lost)]);
    }
  }

 private:
  static constexpr int no_amplitude = -1;

  [[noreturn]] void fail(const EquationNode& node, std::string what,
                         const std::string& name) const {
    throw EquationMistake{
        node.at, std::move(what),
        fmt::format("an equation proportional to '{}', which has a prior and no value: an "
                    "amplitude",
                    name),
        fmt::format("Give '{}' a value if it is no amplitude, or change the equation", name)};
  }
  const std::string& name_in(int operand) const {
    return names_[static_cast<std::size_t>(inside_[static_cast<std::size_t>(operand)])];
  }
  Degree operand(int k) const { return known_[static_cast<std::size_t>(k)]; }

  /// An amplitude that a part is made of, for messages.
  int amplitude_in(const EquationNode& node) const {
    if (node.op == Operation::parameter && amplitude_[static_cast<std::size_t>(node.index)])
      return node.index;
    for (const int k : {node.left, node.right})
      if (k >= 0 && inside_[static_cast<std::size_t>(k)] != no_amplitude)
        return inside_[static_cast<std::size_t>(k)];
    return no_amplitude;
  }

  Degree of(const EquationNode& node) const {
    switch (node.op) {
      case Operation::number:
      case Operation::input:
        return Degree::none;
      case Operation::parameter:
        return amplitude_[static_cast<std::size_t>(node.index)] ? Degree::proportional
                                                                : Degree::none;
      case Operation::negate:
        return operand(node.left);
      case Operation::add:
      case Operation::subtract:
        return sum(node);
      case Operation::multiply:
        return product(node);
      case Operation::divide:
        if (operand(node.right) != Degree::none)
          fail(node, fmt::format("divides by '{}'", name_in(node.right)), name_in(node.right));
        return operand(node.left);
      default:
        for (const int k : {node.left, node.right})
          if (k >= 0 && operand(k) != Degree::none)
            fail(node, fmt::format("has '{}' inside a function or a power", name_in(k)),
                 name_in(k));
        return Degree::none;
    }
  }
  Degree sum(const EquationNode& node) const {
    const Degree a = operand(node.left), b = operand(node.right);
    if (a != b) {
      const int with = a == Degree::proportional ? node.left : node.right;
      fail(node, fmt::format("adds what does not vanish with '{}'", name_in(with)), name_in(with));
    }
    return a;
  }
  Degree product(const EquationNode& node) const {
    const Degree a = operand(node.left), b = operand(node.right);
    if (a == Degree::proportional && b == Degree::proportional)
      fail(node, fmt::format("multiplies '{}' by '{}'", name_in(node.left), name_in(node.right)),
           name_in(node.right));
    return a == Degree::none ? b : a;
  }

  const EquationTree& tree_;
  const std::vector<bool>& amplitude_;
  const std::vector<std::string>& names_;
  std::vector<Degree> known_;
  std::vector<int> inside_;
};

}  // namespace

std::optional<EquationMistake> mistake_of_degree(const EquationTree& tree,
                                                 const std::vector<bool>& amplitude,
                                                 const std::vector<std::string>& names) {
  if (std::ranges::find(amplitude, true) == amplitude.end()) return std::nullopt;
  try {
    DegreeChecker(tree, amplitude, names).check();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
  return std::nullopt;
}

}  // namespace drift
