#include "core/physics/expression/parse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/config/nearest.hpp"

namespace drift {
namespace {

constexpr struct EquationFunction {
  std::string_view name;
  Operation op;
} equation_functions[] = {{"sin", Operation::sine},      {"cos", Operation::cosine},
                          {"tan", Operation::tangent},   {"exp", Operation::exponential},
                          {"log", Operation::logarithm}, {"sqrt", Operation::root},
                          {"abs", Operation::absolute},  {"tanh", Operation::hyperbolic_tangent},
                          {"step", Operation::step},     {"atan", Operation::arc_tangent},
                          {"sign", Operation::sign},     {"min", Operation::minimum},
                          {"max", Operation::maximum},   {"pow", Operation::power}};
constexpr int deepest_nesting =
    50;  // parentheses and signs; keeps a hostile text off the call stack
constexpr double largest_whole = 100.0;  // exponent that is multiplied out

bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads by recursive descent, a function for each level of binding; each returns the node it made.
class EquationParser {
 public:
  EquationParser(std::string_view text, const EquationNames& names) : text_(text), names_(names) {}

  EquationTree read() {
    sum();
    skip();
    if (at_ < text_.size())
      fail(at_, fmt::format("goes on with '{}'", text_[at_]), "an operator + - * / ^, or the end",
           text_[at_] == ')' ? "Remove the parenthesis" : "Write a product as a * b");
    return std::move(tree_);
  }

 private:
  [[noreturn]] void fail(std::size_t at, std::string what, std::string expected,
                         std::string fix) const {
    throw EquationMistake{at, std::move(what), std::move(expected), std::move(fix)};
  }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  int add(EquationNode node) {
    tree_.nodes.push_back(node);
    return static_cast<int>(tree_.nodes.size()) - 1;
  }
  int join(Operation op, int left, int right, std::size_t at) {
    return add({.op = op, .left = left, .right = right, .at = at});
  }

  int sum() {
    int left = product();
    while (true) {
      skip();
      const std::size_t at = at_;
      if (take('+'))
        left = join(Operation::add, left, product(), at);
      else if (take('-'))
        left = join(Operation::subtract, left, product(), at);
      else
        return left;
    }
  }
  int product() {
    int left = signed_factor();
    while (true) {
      skip();
      const std::size_t at = at_;
      if (take('*')) {
        if (at_ < text_.size() && text_[at_] == '*')
          fail(at, "has '**'", "a power written x^2", "Write ^ for **");
        left = join(Operation::multiply, left, signed_factor(), at);
      } else if (take('/')) {
        left = join(Operation::divide, left, signed_factor(), at);
      } else {
        return left;
      }
    }
  }
  int signed_factor() {
    skip();
    const std::size_t at = at_;
    if (++nesting_ > deepest_nesting)
      fail(at, "is nested too deeply", fmt::format("at most {} levels", deepest_nesting),
           "Simplify the equation");
    int made = 0;
    if (take('-'))
      made = join(Operation::negate, signed_factor(), -1, at);
    else if (take('+'))
      made = signed_factor();
    else
      made = power();
    --nesting_;
    return made;
  }
  int power() {
    const int base = primary();
    skip();
    const std::size_t at = at_;
    if (!take('^')) return base;
    return raised(base, signed_factor(), at);
  }
  int raised(int base, int exponent, std::size_t at) {
    const auto n = constant(exponent);
    if (n && *n == std::round(*n) && std::abs(*n) <= largest_whole)
      return add(
          {.op = Operation::whole_power, .index = static_cast<int>(*n), .left = base, .at = at});
    return join(Operation::power, base, exponent, at);
  }
  /// The value of what names nothing, as (2 + 3); nothing else is folded.
  std::optional<double> constant(int node) const {
    const EquationNode& n = tree_.nodes[static_cast<std::size_t>(node)];
    if (n.op == Operation::number) return n.number;
    const auto left = n.left >= 0 ? constant(n.left) : std::nullopt;
    if (!left) return {};
    if (n.op == Operation::negate) return -*left;
    const auto right = n.right >= 0 ? constant(n.right) : std::nullopt;
    if (!right) return {};
    switch (n.op) {
      case Operation::add:
        return *left + *right;
      case Operation::subtract:
        return *left - *right;
      case Operation::multiply:
        return *left * *right;
      case Operation::divide:
        return *left / *right;
      default:
        return {};
    }
  }
  int primary() {
    skip();
    const std::size_t at = at_;
    if (at_ >= text_.size())
      fail(at, "ends too early", "a number, a name or '('", "Complete the equation");
    if (take('(')) {
      const int inside = sum();
      if (!take(')'))
        fail(at_, "lacks a ')'", "one for the '(' " + place(at), "Close the parenthesis");
      return inside;
    }
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    if (begins_name(text_[at_])) return name();
    fail(at, fmt::format("has '{}' where a value is meant", text_[at_]), "a number, a name or '('",
         "Correct the equation");
  }
  static std::string place(std::size_t at) { return fmt::format("at character {}", at + 1); }

  int number() {
    const std::size_t at = at_;
    double value = 0.0;
    const char* end = text_.data() + text_.size();
    const auto [last, error] = std::from_chars(text_.data() + at_, end, value);
    if (error != std::errc() || !std::isfinite(value))
      fail(at, "has a number that cannot be read", "a number such as 0.8 or 1e-3",
           "Correct the number");
    at_ = static_cast<std::size_t>(last - text_.data());
    return add({.op = Operation::number, .number = value, .literal = true, .at = at});
  }

  int name() {
    const std::size_t at = at_;
    while (at_ < text_.size() && (begins_name(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(at, at_ - at);
    for (const EquationFunction& f : equation_functions)
      if (f.name == word) return call(f, at);
    if (word == "pi") return add({.op = Operation::number, .number = std::numbers::pi, .at = at});
    for (const auto& [list, op] : {std::pair{names_.parameters, Operation::parameter},
                                   std::pair{names_.inputs, Operation::input}})
      if (const auto found = std::ranges::find(list, word); found != list.end())
        return add({.op = op, .index = static_cast<int>(found - list.begin()), .at = at});
    std::vector<std::string_view> known(names_.parameters.begin(), names_.parameters.end());
    known.insert(known.end(), names_.inputs.begin(), names_.inputs.end());
    std::vector<std::string_view> all = reserved_equation_names();
    all.insert(all.end(), known.begin(), known.end());
    fail(at, fmt::format("has the unknown name '{}'", word),
         fmt::format("one of {}", fmt::join(known, ", ")),
         config::suggestion(word, all, "Name a parameter so, or use one of these"));
  }

  int call(const EquationFunction& f, std::size_t at) {
    const int wanted = operands_of(f.op);
    const auto wrong = [&] {
      fail(at,
           fmt::format("calls {} with other than {} value{}", f.name, wanted,
                       wanted == 1 ? "" : "s"),
           wanted == 1 ? fmt::format("{}(x)", f.name) : fmt::format("{}(x, y)", f.name),
           "Correct the call");
    };
    if (!take('(')) wrong();
    const int first = sum();
    int second = -1;
    if (wanted == 2) {
      if (!take(',')) wrong();
      second = sum();
    }
    if (take(',')) wrong();
    if (!take(')'))
      fail(at_, "lacks a ')'", "one for the call " + place(at), "Close the parenthesis");
    return f.op == Operation::power ? raised(first, second, at) : join(f.op, first, second, at);
  }

  std::string_view text_;
  EquationNames names_;
  EquationTree tree_;
  std::size_t at_ = 0;
  int nesting_ = 0;
};

}  // namespace

std::vector<std::string_view> reserved_equation_names() {
  std::vector<std::string_view> names{"pi"};
  for (const EquationFunction& f : equation_functions) names.push_back(f.name);
  return names;
}

OrMistake<EquationTree> parse_equation(std::string_view text, const EquationNames& names) {
  try {
    return EquationParser(text, names).read();
  } catch (EquationMistake& mistake) {
    return std::move(mistake);
  }
}

}  // namespace drift
