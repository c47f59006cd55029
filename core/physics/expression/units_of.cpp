#include "core/physics/expression/units_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

namespace drift {
namespace {

constexpr Dimension plain_number{};
constexpr Dimension plane_angle = detail::dim_of(Dimension::angle);

/// a b^power; nothing where the exponents are not halves of whole numbers.
MaybeDimension dimension_product(const Dimension& a, const Dimension& b, double power) {
  Dimension out = a;
  for (std::size_t k = 0; k < Dimension::count; ++k) {
    const double twice = a.twice[k] + power * b.twice[k];
    if (twice != std::round(twice) || std::abs(twice) > 100.0) return std::nullopt;
    out.twice[k] = static_cast<std::int8_t>(twice);
  }
  return out;
}

class UnitChecker {
 public:
  UnitChecker(const EquationTree& tree, std::span<const MaybeDimension> inputs,
              std::span<const MaybeDimension> parameters)
      : tree_(tree), inputs_(inputs), parameters_(parameters) {}

  MaybeDimension whole() {
    for (const EquationNode& node : tree_.nodes) known_.push_back(of(node));
    return known_.back();
  }

 private:
  const MaybeDimension& operand(int k) const { return known_[static_cast<std::size_t>(k)]; }

  MaybeDimension of(const EquationNode& node) const {
    switch (node.op) {
      case Operation::number:
        return node.literal ? std::nullopt : MaybeDimension(plain_number);
      case Operation::input:
        return inputs_[static_cast<std::size_t>(node.index)];
      case Operation::parameter:
        return parameters_[static_cast<std::size_t>(node.index)];
      case Operation::add:
      case Operation::subtract:
      case Operation::minimum:
      case Operation::maximum:
        return alike(node);
      case Operation::multiply:
        return combined(node, 1.0);
      case Operation::divide:
        return combined(node, -1.0);
      case Operation::whole_power:
        return raised(node, node.index);
      case Operation::power:
        return raised_to_any(node);
      case Operation::root:
        return raised(node, 0.5);
      case Operation::negate:
      case Operation::absolute:
        return operand(node.left);
      case Operation::step:
      case Operation::sign:
        return plain_number;
      default:
        return of_function(node);
    }
  }
  MaybeDimension alike(const EquationNode& node) const {
    const MaybeDimension &a = operand(node.left), &b = operand(node.right);
    if (a && b && *a != *b)
      throw EquationMistake{node.at,
                            fmt::format("puts together what measures different things, {} and {}",
                                        dimension_in_words(*a), dimension_in_words(*b)),
                            "two of a kind", "Multiply one by a parameter of the missing unit"};
    // "1 + abs(f_x)": either the figure is in g, or the force is meant as a number.
    if (is_literal(node.left) || is_literal(node.right)) return std::nullopt;
    return a ? a : b;
  }
  bool is_literal(int k) const { return tree_.nodes[static_cast<std::size_t>(k)].literal; }
  MaybeDimension combined(const EquationNode& node, double power) const {
    const MaybeDimension &a = operand(node.left), &b = operand(node.right);
    return a && b ? dimension_product(*a, *b, power) : std::nullopt;
  }
  MaybeDimension raised(const EquationNode& node, double power) const {
    const MaybeDimension& a = operand(node.left);
    return a ? dimension_product(plain_number, *a, power) : std::nullopt;
  }
  MaybeDimension raised_to_any(const EquationNode& node) const {
    const MaybeDimension& exponent = operand(node.right);
    if (exponent && *exponent != plain_number)
      throw EquationMistake{
          node.at, fmt::format("has the exponent {}", dimension_in_words(*exponent)),
          "an exponent that is a plain number", "Divide it by a parameter of its unit"};
    const EquationNode& e = tree_.nodes[static_cast<std::size_t>(node.right)];
    if (e.op == Operation::number) return raised(node, e.number);
    const MaybeDimension& base = operand(node.left);
    return base && *base == plain_number ? base : std::nullopt;
  }
  MaybeDimension of_function(const EquationNode& node) const {
    const MaybeDimension& x = operand(node.left);
    if (x && *x != plain_number && *x != plane_angle)
      throw EquationMistake{node.at, fmt::format("takes a function of {}", dimension_in_words(*x)),
                            "a plain number or an angle", "Divide by a parameter of that unit"};
    // An arc tangent is an angle, or the plain number that turns into one.
    return node.op == Operation::arc_tangent ? std::nullopt : MaybeDimension(plain_number);
  }

  const EquationTree& tree_;
  std::span<const MaybeDimension> inputs_, parameters_;
  std::vector<MaybeDimension> known_;
};

}  // namespace

std::string dimension_in_words(const Dimension& dimension) {
  constexpr std::string_view names[] = {"angle",       "time",  "g",    "length",
                                        "temperature", "field", "mass", "current"};
  std::vector<std::string> factors;
  for (std::size_t k = 0; k < Dimension::count; ++k)
    if (const double power = 0.5 * dimension.twice[k]; power == 1.0)
      factors.emplace_back(names[k]);
    else if (power != 0.0)
      factors.push_back(fmt::format("{}^{:g}", names[k], power));
  return factors.empty() ? "a plain number" : fmt::format("{}", fmt::join(factors, " "));
}

OrMistake<MaybeDimension> dimension_of(const EquationTree& tree,
                                       std::span<const MaybeDimension> inputs,
                                       std::span<const MaybeDimension> parameters) {
  try {
    return UnitChecker(tree, inputs, parameters).whole();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
}

}  // namespace drift
