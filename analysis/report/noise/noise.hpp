#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/preparation/noise_card.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {

/// The Allan card: Q, N, B, K and R of every channel with their sigmas, an upper limit where one is
/// not distinguished from zero, and what was looked at; with the picture of Allan deviations and
/// spectra (allan.svg). `gravity` [m/s^2] for units of velocity.
Section noise_section(const preparation::NoiseCard& card, double gravity);

/// Allan deviations with intervals and the fitted slopes, and spectra: gyros and accelerometers.
std::string allan_picture(const preparation::NoiseCard& card);

/// The noise of the recording as keys of a study file, to paste: [readout] accelerometer_noise, and
/// as comments what belongs into its [[filter]]. Only what is distinguished from zero; empty of a
/// card without channels.
std::string noise_keys(const preparation::NoiseCard& card);

/// Everything of a card, numbers in the units named beside them.
nlohmann::json to_json(const preparation::NoiseCard& card, double gravity);

}  // namespace drift::report
