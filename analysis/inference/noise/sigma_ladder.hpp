#pragma once

namespace drift::inference {

/// A size that was tried, and what it gained.
struct Rung {
  double sigma = 0.0, gain = 0.0;
};

/// The best size of something unknown: up a ladder by factors of three from `lowest`, where hardly
/// anything is changed, until the gain falls by more than `drop` from one rung to the next. No size
/// if the lowest gains nothing: the likelihood of a variance that falls from zero on has its
/// maximum there.
template <class Gain>
Rung climb(double lowest, int rungs, double drop, Gain&& gain) {
  Rung best;
  double last = 0.0, sigma = lowest;
  for (int k = 0; k < rungs; ++k, sigma *= 3.0) {
    const double g = gain(sigma);
    if (g > best.gain) best = {sigma, g};
    if (g < last - drop || best.gain == 0.0) break;
    last = g;
  }
  return best;
}

}  // namespace drift::inference
