#pragma once

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace drift {

/// What random numbers are for. Each purpose is a stream of its own, so that drawing more of one
/// never shifts another. The numbers are part of the scheme "philox4x32-10/v1": never renumber.
enum class Purpose : std::uint32_t {
  parameters = 0,
  initial_attitude = 1,
  sensor_noise = 2,
  process_noise = 3,
  filter_start = 4,
  design = 5,
  drift_level = 20,    ///< which of two levels a bistable drift is on
  wrong_samples = 21,  ///< outliers
  environment = 22,    ///< fluctuations of temperature
  test = 100,
};

/// A stream of random numbers that is a pure function of (seed, run, purpose, index): counter-based
/// (Random123 Philox4x32-10), so it does not depend on threads or on what was drawn elsewhere.
class Stream {
 public:
  static constexpr const char* scheme = "philox4x32-10/v1";

  Stream(std::uint64_t seed, std::uint64_t run, Purpose purpose, std::uint32_t index = 0)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        counter_{{0, static_cast<std::uint32_t>(run),
                  static_cast<std::uint32_t>(run >> 32) ^ (index << 8),
                  static_cast<std::uint32_t>(purpose)}} {}

  /// Uniform on (0, 1), 53 bits, never 0 or 1.
  double uniform() {
    if (left_ == 0) refill();
    const std::uint64_t bits = words_[--left_];
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
  }

  /// Standard normal (Box-Muller, both values used).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    double sine = 0.0, cosine = 0.0;  // glibc's: the bits of sin and cos, in 0.6 of their time
    ::sincos(2.0 * std::numbers::pi * uniform(), &sine, &cosine);
    spare_ = radius * sine;
    has_spare_ = true;
    return radius * cosine;
  }

 private:
  void refill() {
    const auto block = r123::Philox4x32()(counter_, key_);
    words_ = {(std::uint64_t{block[1]} << 32) | block[0],
              (std::uint64_t{block[3]} << 32) | block[2]};
    left_ = 2;
    ++counter_[0];
  }

  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_;
  std::array<std::uint64_t, 2> words_{};
  int left_ = 0;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace drift
