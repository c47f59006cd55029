#pragma once

namespace drift::test {

/// Site, plan and readout (but for its noise, which follows) of five positions at a pole with
/// accelerometers alone: misalignments are seen through their product with drifts that are not, and
/// what is read hangs on the attitude as a bent line.
inline constexpr const char* polar_plan = R"([site]
latitude = "-90 deg"
[plan]
mode = "free"
dwell = "12 min"
sample = "90 s"
slew_rate = "2 deg/s"
[[plan.position]]
axes = "x=E y=S z=D"
entry = "caged"
sample = "180 s"
dwell = "720 s"
[[plan.position]]
axes = "x=S y=E z=U"
entry = "caged"
sample = "171 s"
dwell = "1026 s"
[[plan.position]]
axes = "x=W y=D z=S"
entry = "caged"
sample = "20 s"
dwell = "280 s"
[[plan.position]]
axes = "x=N y=E z=D"
entry = "caged"
sample = "20 s"
dwell = "200 s"
[[plan.position]]
axes = "x=D y=W z=N"
entry = "torqued"
sample = "171 s"
dwell = "1368 s"
[readout]
gimbals = false
)";

}  // namespace drift::test
