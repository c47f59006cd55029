#pragma once

namespace drift::test {

/// The beginning of a study file: two cagings in free drift, where eq. (6) shows misalignments by
/// the drift that they turn.
inline constexpr const char* two_cagings = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "60 min"
sample = "10 min"
mode   = "free"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=N y=U z=E"
)";

}  // namespace drift::test
