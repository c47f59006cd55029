#include "analysis/report/svg/axis_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

double round_step(double rough) {
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (rough <= m * decade * (1.0 + 1e-9)) return m * decade;
  return 10.0 * decade;
}

}  // namespace

void Range::include(double value) {
  if (!(std::abs(value) < 1e100)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Range::include(std::span<const double> values) {
  for (const double v : values) include(v);
}

double AxisScale::at(double value, double pixels) const {
  if (!(std::abs(value) < 1e100)) return std::nan("");
  return std::clamp((value - range.low) / range.width(), -20.0, 20.0) * pixels;
}

AxisScale make_scale(const Range& data, int count, double margin) {
  AxisScale scale;
  scale.range = data.empty() ? Range{0.0, 1.0} : data;
  Range& r = scale.range;
  const double largest = std::max(std::abs(r.low), std::abs(r.high));
  if (r.width() <= 1e-9 * largest || r.width() < 1e-300) {  // a constant, up to rounding
    const double half = largest > 1e-290 ? 0.1 * largest : 1.0;
    r = {r.low - half, r.high + half};
  } else {
    const double extra = margin * r.width();
    r = {r.low - extra, r.high + extra};
  }
  const double step = round_step(r.width() / std::max(count, 1));
  const double first = std::ceil(r.low / step - 1e-9), last = std::floor(r.high / step + 1e-9);
  for (double k = first; k <= last; k += 1.0) scale.ticks.push_back(k * step);

  double tallest = 0.0;
  for (const double t : scale.ticks) tallest = std::max(tallest, std::abs(t));
  int power = tallest > 0.0 ? static_cast<int>(std::floor(std::log10(tallest) + 1e-9)) : 0;
  if (power > -4 && power < 5) power = 0;
  if (power != 0) scale.factor = fmt::format("×10^{}", power);
  const double unit = std::pow(10.0, power);
  const int decimals =
      std::clamp(static_cast<int>(-std::floor(std::log10(step / unit) + 1e-9)), 0, 9);
  for (const double t : scale.ticks)
    scale.labels.push_back(fmt::format("{:.{}f}", t == 0.0 ? 0.0 : t / unit, decimals));
  return scale;
}

double spaced(double value, Spacing spacing) {
  if (spacing == Spacing::linear) return value;
  return value > 0.0 ? std::log10(value) : std::nan("");
}

std::vector<std::size_t> shown_ticks(const AxisScale& scale, Spacing spacing) {
  std::vector<std::size_t> all, powers;
  for (std::size_t i = 0; i < scale.ticks.size(); ++i) {
    all.push_back(i);
    if (std::abs(scale.ticks[i] - std::round(scale.ticks[i])) < 1e-9) powers.push_back(i);
  }
  return spacing == Spacing::logarithmic && powers.size() >= 2 ? powers : all;
}

std::string tick_label(const AxisScale& scale, std::size_t tick, Spacing spacing) {
  if (spacing == Spacing::linear) return scale.labels[tick];
  return fmt::format("{:.6g}", std::stod(number_text(std::pow(10.0, scale.ticks[tick]), 2)));
}

}  // namespace drift::report
