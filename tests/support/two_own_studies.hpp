#pragma once

#include "tests/mc/study/study_file.hpp"

namespace drift::test {

/// A small study with an own term "rumble" of this equation, in truth and filter.
inline std::string with_rumble(const std::string& equation, const std::string& more = "") {
  return R"toml(schema = 1
title = "Rumble"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
mode = "free"
dwell = "20 min"
sample = "2 min"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "rumble"]
[truth.parameters]
rumble_A = "0.5 deg/h"
[[filter]]
name = "right"
coupling = "eq5"
terms = ["fixed_drift", "rumble"]
[[term]]
key = "rumble"
acts_on = "rate.y"
equation = ")toml" +
         equation + R"toml("
parameters = { A = { unit = "deg/h", prior = "0.5 deg/h" }, P = { unit = "min", value = 37.50 } }
[monte_carlo]
runs = 20
seed = 3
)toml" + more;
}
inline const std::string sine_rumble = "A * sin(2*pi*t/P)", cosine_rumble = "A * cos(2*pi*t/P)";

/// A study without own terms.
inline const std::string no_rumble = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
[truth]
coupling = "eq5"
[[filter]]
coupling = "eq5"
)toml";

/// What an action throws at one whose own terms are those of another study by now; empty if it goes
/// well.
template <class Action>
std::string stale(const Action& action) {
  try {
    action();
    return "";
  } catch (const InputError& error) {
    return error.code() == ExitCode::config ? error.what() : "another code";
  }
}

}  // namespace drift::test
