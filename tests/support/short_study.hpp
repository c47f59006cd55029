#pragma once

namespace drift::test {

/// A short six-position study: seconds of computing, all features of a long one.
inline constexpr const char* short_study = R"(schema = 1
title  = "short"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "10 min"
sample = "60 s"
mode   = "free"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise        = "5 arcsec"
[truth]
coupling = "eq5"
[[filter]]
name     = "corrected"
coupling = "eq5"
starts   = 2
[[filter]]
name     = "legacy"
coupling = "eq6"
[monte_carlo]
seed = 3
)";

}  // namespace drift::test
