#include "core/plan/celsius_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/params/covariates.hpp"

namespace drift {

std::optional<RowMistake> take_celsius(std::vector<double>& values, const Channel& column) {
  const double zero = celsius_offset(column.unit);
  if (zero == 0.0) return std::nullopt;
  for (double& x : values) x += zero;
  constexpr CovariateSpec temperature = covariate("temperature");
  const auto other = std::ranges::find_if(
      values, [&](double x) { return std::abs(x) > temperature.reason * temperature.unit.to_si; });
  if (other == values.end()) return std::nullopt;
  return RowMistake{
      static_cast<std::size_t>(other - values.begin()),
      fmt::format("{0} reads {1:.4g} {2}, which is no temperature of a test (expected temperatures "
                  "in a column in {2}: equations have them in degC). If it holds differences, "
                  "write {0} = \"its header as it stands, then [degC]\" in columns of [recording]",
                  column.name, (*other - zero) / column.unit.to_si, column.unit.symbol.view())};
}

}  // namespace drift
