#pragma once

namespace drift::test {

/// Six trials of a quarter of an hour per position: one of every stratum.
inline constexpr const char* tiny_blind_study = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell = "15 min"
sample = "180 s"
[environment]
temperature = "20 degC"
temperature_amplitude = "0.4 degC"
field_n = "0.25 gauss"
field_w = "0.02 gauss"
field_u = "-0.47 gauss"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
coupling = "eq5"
[[filter]]
name = "nominal"
coupling = "eq5"
[monte_carlo]
seed = 5
[blind]
trials = 6
plans = ["six"]
couplings = ["eq5", "eq6"]
sizes = [6]
pair_size = 5
most_prior_sigmas = 100
[blind.shares]
null = 1
wrong_noise = 1
single = 1
pair = 1
outside = 1
local = 1
)toml";

}  // namespace drift::test
