#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/diagnosis/findings/profile.hpp"
#include "analysis/report/diagnosis/words/instrument.hpp"
#include "analysis/search/cause.hpp"

namespace drift::report {

/// A term in words, the part it sits in behind: "magnetic sensitivity, gyro y". axis: "y",
/// "middle", or empty. A key that is no term stands for itself.
std::string in_words(std::string_view term, std::string_view axis,
                     Instrument instrument = Instrument::platform);

/// A cause in words, its key and numbers in brackets behind: "magnetic sensitivity, gyro y
/// (magnetic_drift.y: M_y = 0.0110±0.0004 deg/h/gauss)". Of more than three numbers the one that is
/// largest in sigmas of its prior. A title that ends in brackets takes them in: "g-sensitive drift
/// (mass unbalance; g_drift: ...)".
std::string in_words(const search::Cause& cause, Instrument instrument = Instrument::platform);
/// "0.056±0.011", or where refits found the interval to be another "0.058 (95 %: 0.037 to 0.22)",
/// with the most probable value; of a setting that is one of several values "4, 8, 16 or 32".
std::string value_in_words(const search::CauseParameter& p);

/// A number of lambda with the decimals of a sigma, and more where it would read as 0 or 1, which
/// are equations, and is not: "1.00004".
std::string lambda_in_words(double lambda, double sigma);

/// "less the mean of the three", as `identify` notes it: of a number without the common part that
/// the test does not see. Empty of any other.
std::string note_in_words(const search::CauseParameter& p);
std::string note_in_words(const diagnosis::Profile& p);

/// An equation (Where::equation) as a reader says it: "middle gimbal" of "gimbal middle".
std::string equation_in_words(const std::string& equation);

/// What a model lacks: "The nominal model lacks ... and ..."; with frame_closure among the causes
/// "The nominal model has the wrong drift equation (...) and lacks ...".
std::string lacking(const std::vector<search::Cause>& causes,
                    Instrument instrument = Instrument::platform);

/// A component of the noise (NoiseFinding) in words: "white noise of the gimbal readout".
std::string noise_in_words(const std::string& component);

}  // namespace drift::report
