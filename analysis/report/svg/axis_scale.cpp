#include "analysis/report/svg/axis_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drift::report {
namespace {

double round_step(double rough) {
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (rough <= m * decade * (1.0 + 1e-9)) return m * decade;
  return 10.0 * decade;
}

/// What is shown of the data.
Range with_margin(const Range& data, double margin) {
  Range r = data.empty() ? Range{0.0, 1.0} : data;
  const double largest = std::max(std::abs(r.low), std::abs(r.high));
  if (r.width() <= 1e-9 * largest || r.width() < 1e-300) {  // a constant, up to rounding
    const double half = largest > 1e-290 ? 0.1 * largest : 1.0;
    r = {r.low - half, r.high + half};
  } else {
    const double extra = margin * r.width();
    r = {r.low - extra, r.high + extra};
  }
  return r;
}

/// Ticks at multiples of a round step.
void add_linear_ticks(AxisScale& scale, int count) {
  const Range& r = scale.range;
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
}

/// Ticks of a logarithmic axis: powers of ten; where they are few, those numbers between them that
/// are still far enough apart; within a factor of four, multiples of a round step.
void add_logarithmic_ticks(AxisScale& scale, int count) {
  const Range& r = scale.range;
  if (r.width() < std::log10(4.0)) {
    AxisScale plain;
    plain.range = {std::pow(10.0, r.low), std::pow(10.0, r.high)};
    add_linear_ticks(plain, count);
    for (const double t : plain.ticks) scale.ticks.push_back(std::log10(t));
  } else if (std::floor(r.high) - std::ceil(r.low) >= 2.0) {
    const double step = std::max(1.0, round_step(r.width() / std::max(count, 1)));
    for (double k = std::ceil(r.low / step); k * step <= r.high; k += 1.0)
      scale.ticks.push_back(k * step);
  } else {
    using Mantissas = std::vector<double>;
    for (const Mantissas& mantissas : {Mantissas{1.0, 2.0, 5.0}, Mantissas{1.0, 3.0}}) {
      scale.ticks.clear();
      for (double k = std::floor(r.low); k <= r.high; k += 1.0)
        for (const double m : mantissas)
          if (const double t = k + std::log10(m); t >= r.low - 1e-9 && t <= r.high + 1e-9)
            scale.ticks.push_back(t);
      if (static_cast<int>(scale.ticks.size()) <= std::max(count, 3)) break;
    }
  }
  for (const double t : scale.ticks)
    scale.labels.push_back(fmt::format("{:.6g}", std::pow(10.0, t)));
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

AxisScale make_scale(const Range& data, int count, double margin, Spacing spacing) {
  AxisScale scale;
  scale.range = with_margin(data, margin);
  if (spacing == Spacing::linear)
    add_linear_ticks(scale, count);
  else
    add_logarithmic_ticks(scale, count);
  return scale;
}

double spaced(double value, Spacing spacing) {
  if (spacing == Spacing::linear) return value;
  return value > 0.0 ? std::log10(value) : std::nan("");
}

}  // namespace drift::report
