// `driftscope diagnose` as a user runs it.
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "core/sim/recording.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift {
namespace {

using namespace drift::test;

constexpr int recording_error = static_cast<int>(ExitCode::recording);

/// A case with misalignment, written to a file.
std::string tilted_case(const ScratchFolder& folder) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) set(theta, key, 900.0);
  set(theta, "eta_x", 3000.0);
  set(theta, "xi_y", -3000.0);
  const std::string path = folder.file("case.csv");
  write_recording(strapdown_recording({.dwells = 20, .rest = 4.0, .seed = 4}, theta), path);
  return path;
}

TEST(DiagnoseCommand, NamesWhatACaseLacksAndLeavesAReport) {
  const ScratchFolder folder;
  const Answer a = driftscope("diagnose " + config("diagnose_xsens.toml") + " " + tilted_case(folder) + " -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("Verdict named: The nominal model leaves out gyro_misalignment"), std::string::npos) << a.out;
  const auto json = nlohmann::json::parse(text_of(folder.file("out") + "/diagnosis.json"));
  EXPECT_EQ(json["verdict"], "named");
  EXPECT_EQ(json["causes"][0]["term"], "gyro_misalignment");
  EXPECT_EQ(json["model"], "patched.toml");
  for (const char* name : {"report.html", "residual_signal.csv", "identification.json", "study.toml", "where.svg"})
    EXPECT_GT(std::filesystem::file_size(folder.file("out") + "/" + name), 100u) << name;
  const Answer check = driftscope("check " + folder.file("out") + "/patched.toml");
  EXPECT_EQ(check.code, 0) << check.err;
  const Answer again = driftscope("diagnose " + folder.file("out") + "/patched.toml " + folder.file("case.csv"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("Verdict consistent"), std::string::npos) << again.out;
}

TEST(DiagnoseCommand, RefusesWhatItCannotDiagnose) {
  const ScratchFolder folder;
  EXPECT_EQ(driftscope("diagnose " + config("diagnose_xsens.toml")).code, static_cast<int>(ExitCode::usage));
  EXPECT_EQ(driftscope("diagnose " + config("diagnose_xsens.toml") + " " + folder.file("absent.csv")).code,
            static_cast<int>(ExitCode::io));
  const std::string no_gyros = folder.write("r.csv", "time [s],acc_x [g],acc_y [g],acc_z [g]\n1,0,0,1\n2,0,0,1\n");
  const Answer a = driftscope("diagnose " + config("diagnose_xsens.toml") + " " + no_gyros);
  EXPECT_EQ(a.code, recording_error);
  EXPECT_NE(a.err.find("gyro_x"), std::string::npos) << a.err;
}

}  // namespace
}  // namespace drift
