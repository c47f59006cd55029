#include "analysis/diagnosis/acting.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "core/physics/term_library.hpp"

namespace drift::diagnosis {
namespace {

using inference::Equation;

std::optional<Equation> equation_of(const TermInfo& term) {
  if (term.in_readout) return Equation::accelerometer;
  if (term.in_rates) return Equation::rate;
  if (term.in_offset) return Equation::attitude;
  if (term.in_gimbals) return Equation::gimbal;
  return std::nullopt;
}

/// The gimbals are axes of the resolvers alone: an offset of the platform about one turns with it.
std::optional<int> number_of(std::string_view axis, Equation equation) {
  constexpr std::string_view of_platform[] = {"x", "y", "z"},
                             of_gimbals[] = {"outer", "middle", "inner"};
  const auto& names = equation == Equation::gimbal ? of_gimbals : of_platform;
  const auto at = std::ranges::find(names, axis);
  if (at == std::end(names)) return std::nullopt;
  return static_cast<int>(at - std::begin(names));
}

/// The axis of the size that is largest against its prior, as the words of the verdict choose it.
std::string_view largest_axis(const search::Cause& cause) {
  std::string_view axis;
  double largest = -1.0;
  for (const search::CauseParameter& p : cause.parameters) {
    const double size = std::isfinite(p.prior_sigmas) ? std::abs(p.prior_sigmas) : 0.0;
    if (p.profiled || size <= largest) continue;
    largest = size;
    axis = TermLibrary::specs[p.param].axis;
  }
  return axis;
}

}  // namespace

std::optional<Acting> acting_of(const search::Cause& cause) {
  const auto term = TermLibrary::find_term(cause.term);
  if (!term) return std::nullopt;
  const auto equation = equation_of(TermLibrary::terms[*term]);
  if (!equation) return std::nullopt;
  Acting out{*equation, number_of(cause.axis.empty() ? largest_axis(cause) : cause.axis, *equation),
             std::nullopt};
  for (const search::CauseParameter& p : cause.parameters)
    if (TermLibrary::specs[p.param].kind == ParamKind::moment)
      out.onset = p.value * TermLibrary::specs[p.param].unit.to_si;
  return out;
}

std::vector<Acting> acting_of(std::span<const search::Cause> causes) {
  std::vector<Acting> all;
  for (const search::Cause& cause : causes) {
    const auto one = acting_of(cause);
    if (!one) return {};
    all.push_back(*one);
  }
  return all;
}

}  // namespace drift::diagnosis
