#pragma once

#include <string>

namespace drift::test {

/// Two positions with a dwell and a mode of their own, no slew, accelerometers alone.
inline const std::string listed_study = R"toml(schema = 1
title = "Listed"
[site]
latitude = "45 deg"
[plan]
sample = "10 min"
[[plan.position]]
axes = "x=N y=W z=U"
dwell = "40 min"
mode = "free"
[[plan.position]]
name = "second"
axes = "x=U y=S z=E"
dwell = "30 min"
mode = "free"
[readout]
gimbals = false
[truth]
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
[truth.parameters]
eta_x = "112 arcsec"
eta_y = "112 arcsec"
eta_z = "112 arcsec"
[[filter]]
name = "f5"
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
[monte_carlo]
runs = 64
)toml";

}  // namespace drift::test
