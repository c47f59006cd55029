#include "core/physics/expression/kelvins.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace drift {
namespace {

class KelvinChecker {
 public:
  KelvinChecker(const EquationTree& tree, std::size_t columns,
                const std::vector<std::optional<KelvinParameter>>& kelvins)
      : tree_(tree), columns_(columns), kelvins_(kelvins) {}

  void look() {
    for (const EquationNode& node : tree_.nodes) sums_.push_back(of(node));
    end(sums_.back());
  }

 private:
  /// What is added up in a node.
  struct Sum {
    int columns = 0;                       ///< added, less those taken away
    const EquationNode* kelvin = nullptr;  ///< a parameter in K, if there is one
  };

  Sum operand(int k) const { return k < 0 ? Sum{} : sums_[static_cast<std::size_t>(k)]; }

  Sum of(const EquationNode& node) const {
    const Sum a = operand(node.left), b = operand(node.right);
    const EquationNode* kelvin = a.kelvin != nullptr ? a.kelvin : b.kelvin;
    switch (node.op) {
      case Operation::input:
        return {static_cast<std::size_t>(node.index) >= columns_ ? 1 : 0, nullptr};
      case Operation::parameter:
        return {0, kelvins_[static_cast<std::size_t>(node.index)] ? &node : nullptr};
      case Operation::add:
        return {a.columns + b.columns, kelvin};
      case Operation::subtract:
        return {a.columns - b.columns, kelvin};
      case Operation::negate:
        return {-a.columns, kelvin};
      case Operation::minimum:
      case Operation::maximum:
        return {a.columns != 0 ? a.columns : b.columns, kelvin};
      default:
        end(a);
        end(b);
        return {};
    }
  }

  /// Throws what is wrong with a sum that goes into something else.
  void end(const Sum& sum) const {
    if (sum.columns == 0 || sum.kelvin == nullptr) return;
    const KelvinParameter& p = *kelvins_[static_cast<std::size_t>(sum.kelvin->index)];
    throw EquationMistake{
        sum.kelvin->at,
        fmt::format("puts '{}', in K, beside a column of the recording: columns of temperatures "
                    "are in degC here, whatever they are in in the file",
                    p.name),
        "a parameter in degC",
        fmt::format("Write {0} = {{ unit = \"degC\", ... }}: {1:.12g} K is {2:.12g} degC as a "
                    "temperature, and {1:.12g} degC as a difference",
                    p.name, p.value, p.value + celsius_offset("K"_unit))};
  }

  const EquationTree& tree_;
  std::size_t columns_;
  const std::vector<std::optional<KelvinParameter>>& kelvins_;
  std::vector<Sum> sums_;
};

}  // namespace

std::optional<EquationMistake> mistake_of_kelvins(
    const EquationTree& tree, std::size_t columns,
    const std::vector<std::optional<KelvinParameter>>& kelvins) {
  try {
    KelvinChecker(tree, columns, kelvins).look();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
  return std::nullopt;
}

}  // namespace drift
