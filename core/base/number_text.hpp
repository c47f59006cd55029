#pragma once

#include <string>

namespace drift {

/// A number with so many significant digits, "-" if it is not finite. One below a million with more
/// digits before the point than that is whole: 12346, not 1.2e+04.
std::string number_text(double value, int digits = 3);

/// A number with so many decimals, "-" if it is not finite; never "-0.00".
std::string decimal_text(double value, int decimals);

/// "1.510±0.030", "96±4": sigma with two significant digits if it starts with 355 or less, else
/// one (the rule of the Particle Data Group); the value with as many decimals.
std::string with_sigma(double value, double sigma);

/// A number with as many decimals as stand in with_sigma() of this sigma.
std::string to_match(double value, double sigma);

/// "101.04±5.47", "-1.20±0.03": both as somebody else gave them, with equally many decimals.
std::string as_given(double value, double sigma);

/// A probability that is no more exact than it is known: "0.076", "4e-4" (scientific only below
/// 0.001), "below 1e-300"; "-" if it is not finite.
std::string p_text(double p_value);

}  // namespace drift
