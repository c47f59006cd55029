// No result hangs on what the memory held before: glibc fills what it gives and takes back with a
// byte that differs from time to time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace drift::unset_memory_test {
namespace {

using namespace drift::test;

/// The answer of the program on standard output where memory is filled with a byte.
std::string answered(int filled_with, const std::string& arguments) {
  const Answer a =
      run_program("/usr/bin/env", fmt::format("MALLOC_PERTURB_={} '{}' {} --threads 1 --quiet",
                                              filled_with, DRIFT_PROGRAM, arguments));
  EXPECT_EQ(a.code, 0) << arguments << a.err;
  return a.out;
}

TEST(UnsetMemory, ChangesNoResult) {
  const std::string slow =
                        " --set plan.preset=slew12 --set 'plan.dwell=\"30 min\"' --set "
                        "'plan.slew_rate=\"0.05 deg/s\"'",
                    longer = " --set plan.preset=six --set 'plan.dwell=\"4 h\"'";
  const std::string study = test::config("diagnose_equation.toml");
  std::vector<std::string> all;
  for (const std::string& plan : {slow, longer}) {
    all.push_back("identify " + study + plan + " --full");
    all.push_back("rank " + study + plan);
  }
  for (const std::string& line : all) EXPECT_EQ(answered(85, line), answered(170, line)) << line;
  const ScratchFolder scratch;
  for (const std::string& plan : {slow, longer}) {
    const std::string csv = scratch.file("r.csv");
    answered(85, "simulate " + study + plan + " -o " + csv);
    const auto diagnosed = [&](int byte) {
      return answered(byte, "diagnose " + study + plan + " " + csv + " --full");
    };
    EXPECT_EQ(diagnosed(85), diagnosed(170)) << plan;
    for (const std::string estimator : {"batch", "iterated", "ekf"}) {
      const std::string line = "run " + study + plan +
                               " --runs 4 --set monte_carlo.estimator=" + estimator +
                               " --set monte_carlo.allowed_failures=4 -o ";
      for (const int byte : {85, 170}) answered(byte, line + scratch.file(std::to_string(byte)));
      const auto digest = [&](int byte) {
        const std::string said = answered(byte, "verify " + scratch.file(std::to_string(byte)));
        return said.substr(said.find("results "));
      };
      EXPECT_EQ(digest(85), digest(170)) << line;
      for (const int byte : {85, 170})
        std::filesystem::remove_all(scratch.file(std::to_string(byte)));
    }
  }
}

}  // namespace
}  // namespace drift::unset_memory_test
