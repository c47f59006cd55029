#pragma once

#include <functional>

#include "tests/support/program.hpp"

namespace drift::test {

/// Runs a command again and again, each time with another call of a kind failing once, as on a full
/// disk, until there is no further one: every `stride`-th. `prepare` comes before, `look` judges
/// each end. Returns how many calls failed. `fault` is what is set beside the call and its kind.
inline std::size_t with_faults(const std::string& program, const std::string& arguments,
                               const std::string& kind, std::size_t stride,
                               const std::function<void(std::size_t)>& prepare,
                               const std::function<void(std::size_t, const Answer&)>& look,
                               const std::string& fault = "") {
  constexpr std::size_t most = 10000;
  const ScratchFolder scratch;
  const std::string hit = scratch.file("hit");
  std::size_t failed = 0;
  for (std::size_t at = 0; at < most; at += stride, ++failed) {
    std::filesystem::remove(hit);
    prepare(at);
    const Answer a = run_program(
        "/usr/bin/env", "LD_PRELOAD=" DRIFT_FAULTS " DRIFT_FAULT_AT=" + std::to_string(at) +
                            " DRIFT_FAULT_KIND=" + kind + " DRIFT_FAULT_HIT='" + hit + "' " +
                            fault + " '" + program + "' " + arguments);
    if (!std::filesystem::exists(hit)) return failed;
    look(at, a);
  }
  ADD_FAILURE() << "more than " << most << " calls of kind " << kind;
  return most;
}

}  // namespace drift::test
