#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/recording/recording.hpp"

namespace drift {

/// The fact of a strapdown recording whose rates are means over their intervals: in what `convert`
/// writes, too, so that it is read again as what it is.
inline constexpr std::string_view sample_kind_fact = "sample_kind", mean_rates_word = "mean_rates";

/// Whether the rates of a recording's gyros are means over the interval of their row, as angles
/// gained in it are once divided by it, and not the rates at its end.
inline bool holds_mean_rates(const Recording& recording) {
  return std::ranges::any_of(recording.facts, [](const auto& fact) {
    return fact.first == sample_kind_fact && fact.second == mean_rates_word;
  });
}

/// Writes that fact down, once.
inline void say_mean_rates(Recording& recording) {
  std::erase_if(recording.facts, [](const auto& fact) { return fact.first == sample_kind_fact; });
  recording.facts.emplace_back(sample_kind_fact, mean_rates_word);
}

/// What a sample that comes `step` after the one before was gained over, or is the mean over: the
/// step, or the usual one where rows are lost between them [s].
inline double sampled_over(double step, double usual) {
  return std::abs(step - usual) > 0.5 * usual ? usual : step;
}

}  // namespace drift
