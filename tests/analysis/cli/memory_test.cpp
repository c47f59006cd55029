// What takes more memory than there is, or more rows than were planned, is said before it is done.
#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::memory_test {
namespace {

using namespace drift::test;

std::string cheap() {
  return "'" + std::string(DRIFT_SOURCE_DIR) + "/configs/cheap.toml'";
}

#if defined(__has_feature)
#define DRIFT_SANITIZED __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define DRIFT_SANITIZED 1
#else
#define DRIFT_SANITIZED 0
#endif
constexpr bool sanitized = DRIFT_SANITIZED;

/// The program with at most 2 GB of address space.
Answer in_two_gigabytes(const std::string& arguments) {
  return run_program("/bin/bash",
                     "-c \"ulimit -v 2000000; '" DRIFT_PROGRAM "' " + arguments + "\"");
}

TEST(Memory, APlanOfMillionsOfSamplesIsRefusedInWords) {
  if (sanitized) GTEST_SKIP() << "the address sanitizer needs more address space than is allowed";
  const ScratchFolder scratch;
  // Two positions of 30 days, a sample each second.
  const std::string long_plan = cheap() + " --set plan.dwell='720 h' --set plan.sample='1 s'";
  for (const std::string& line :
       {"check " + long_plan, "simulate " + long_plan + " -o " + scratch.file("r.csv"),
        "identify " + long_plan, "rank " + long_plan}) {
    const Answer a = in_two_gigabytes(line);
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::config)) << line << "\n" << a.err;
    EXPECT_NE(a.err.find("samples together would take about"), std::string::npos) << a.err;
  }
}

TEST(Memory, MoreThreadsThanTheSystemGivesAreRefusedInWords) {
  if (sanitized) GTEST_SKIP() << "the address sanitizer needs more address space than is allowed";
  const ScratchFolder scratch;
  const std::string run = "run " + cheap() + " --runs 512 -o ";
  const Answer a = in_two_gigabytes(run + scratch.file("out") + " --threads 512");
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage)) << a.err;
  EXPECT_NE(a.err.find("--threads 512: the system gives this program no more than "),
            std::string::npos)
      << a.err;
  EXPECT_EQ(in_two_gigabytes(run + scratch.file("out") + " --threads 2").code, 0);
}

TEST(Memory, RowsOtherThanPlannedAreRemarked) {
  const ScratchFolder scratch;
  const std::string rec = scratch.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + cheap() + " --set plan.dwell='200 min' -o " + rec).code, 0);
  const Answer a = driftscope("identify " + cheap() + " " + rec);
  EXPECT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.err.find("positions 1, 2: not as many rows as planned: 20 where the plan has 2"),
            std::string::npos)
      << a.err;
  std::string text = text_of(rec), first_position;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = text.find('\n', at) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.find(",2,0,") == std::string::npos) first_position += line;
    at = end;
  }
  const Answer one =
      driftscope("identify " + cheap() + " " + scratch.write("one.csv", first_position));
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_NE(one.out.find("without position 2 of the plan;"), std::string::npos) << one.out;
}

}  // namespace
}  // namespace drift::memory_test
