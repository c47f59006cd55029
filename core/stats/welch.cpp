#include "core/stats/welch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace drift::stats {
namespace {

constexpr std::size_t shortest = 32, longest = 8192;  // samples of a stretch, of a segment

std::vector<double> hann(std::size_t length) {
  std::vector<double> window(length);
  for (std::size_t k = 0; k < length; ++k)
    window[k] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(k) /
                                     static_cast<double>(length));
  return window;
}

}  // namespace

Spectrum welch(std::span<const Stretch> stretches, double interval) {
  std::size_t most = 0;
  for (const Stretch& s : stretches) most = std::max(most, s.size());
  if (most < shortest) return {};
  const std::size_t length = std::min(longest, std::bit_floor(most / 4));
  const std::vector<double> window = hann(length);
  double power = 0.0;
  for (const double w : window) power += w * w;
  Spectrum out;
  out.density.assign(length / 2, 0.0);
  Eigen::FFT<double> transform;
  std::vector<double> segment(length);
  std::vector<std::complex<double>> lines;
  for (const Stretch& s : stretches)
    for (std::size_t first = 0; first + length <= s.size(); first += length / 2) {
      double mean = 0.0;
      for (std::size_t k = 0; k < length; ++k) mean += s[first + k] / static_cast<double>(length);
      for (std::size_t k = 0; k < length; ++k) segment[k] = window[k] * (s[first + k] - mean);
      transform.fwd(lines, segment);
      for (std::size_t k = 1; k <= length / 2; ++k)
        out.density[k - 1] += (k < length / 2 ? 2.0 : 1.0) * std::norm(lines[k]) * interval / power;
      ++out.segments;
    }
  for (std::size_t k = 1; k <= length / 2; ++k) {
    out.density[k - 1] /= static_cast<double>(out.segments);
    out.frequency.push_back(static_cast<double>(k) / (static_cast<double>(length) * interval));
  }
  return out;
}

Spectrum thinned(const Spectrum& spectrum, int per_decade) {
  Spectrum out;
  out.segments = spectrum.segments;
  const double ratio = std::pow(10.0, 1.0 / per_decade);
  for (std::size_t first = 0, end = 0; first < spectrum.frequency.size(); first = end) {
    double frequency = 0.0, density = 0.0;
    while (end < spectrum.frequency.size() &&
           (end == first || spectrum.frequency[end] < ratio * spectrum.frequency[first])) {
      frequency += spectrum.frequency[end];
      density += spectrum.density[end++];
    }
    out.frequency.push_back(frequency / static_cast<double>(end - first));
    out.density.push_back(density / static_cast<double>(end - first));
  }
  return out;
}

}  // namespace drift::stats
