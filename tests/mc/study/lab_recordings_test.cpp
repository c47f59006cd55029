#include <gtest/gtest.h>

#include "core/plan/timeline.hpp"
#include "core/sim/simulate.hpp"
#include "tests/mc/study/study_file.hpp"
#include "tests/support/lab_damage.hpp"

namespace drift::lab_recordings_test {
namespace {

using test::LabColumn, test::LabFile, test::Variant;

const std::string study_text = R"toml(schema = 1
[site]
latitude = "45.75 deg"
gravity = "9.81 m/s^2"
[plan]
dwell = "4 min"
sample = "20 s"
[[plan.position]]
name = "z up"
axes = "x=N y=W z=U"
[[plan.position]]
name = "x up"
axes = "x=U y=S z=E"
[[plan.position]]
name = "y up"
axes = "x=W y=U z=N"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift"]
[[filter]]
coupling = "eq5"
terms = ["fixed_drift"]
)toml";

/// What the platform of the study shows, once for all variants.
const Recording& simulated() {
  static const Recording recording = [] {
    const mc::Study study = test::read_text(study_text);
    Timeline timeline = lay_out(study.plan, study.site);
    Simulator simulator(study.truth, study.readout);
    const Simulation sim = simulator.run(timeline, 5, 0);
    Recording r = make_recording(timeline, sim.measured, study.readout);
    const auto count = [](const std::string& name) { return name.starts_with("cmd_"); };
    std::erase_if(r.channels, [&](const Channel& c) { return count(c.name); });
    return r;
  }();
  return recording;
}

std::vector<Variant> variants() {
  auto all = test::read_variants();
  const auto refused = test::refused_variants();
  all.insert(all.end(), refused.begin(), refused.end());
  return all;
}

class LabRecording : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Variants, LabRecording, ::testing::ValuesIn(variants()),
                         [](const auto& one) { return one.param.name; });

TEST_P(LabRecording, IsReadRightlyOrRefusedWithOneMessage) {
  const Variant& v = GetParam();
  LabFile lab;
  if (v.style) v.style(lab);
  std::string text = lab.text(simulated());
  if (v.bytes) v.bytes(text);
  const test::StudyFile folder(study_text + lab.section());
  const std::string path = (std::filesystem::path(folder.path()).parent_path() / v.file).string();
  std::ofstream(path, std::ios::binary) << text;
  const mc::Study study = mc::read_study(folder.path());
  Recording r;
  try {
    r = read_recording(path, study.recording, study.kind, study.site.gravity);
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    ASSERT_FALSE(v.refused.empty()) << e.what();
    EXPECT_EQ(e.messages().size(), 1u) << e.what();
    for (const std::string& m : e.messages()) {
      EXPECT_TRUE(m.starts_with(path + ":")) << m;
      EXPECT_NE(m.find("(expected "), std::string::npos) << m;
    }
    EXPECT_NE(std::string(e.what()).find(v.refused), std::string::npos) << e.what();
    return;
  }
  ASSERT_TRUE(v.refused.empty()) << "it was read";
  EXPECT_NO_THROW(check_recording(r, study.kind));
  const Recording& truth = simulated();
  ASSERT_EQ(r.rows() + v.rows_lost, truth.rows());
  for (const LabColumn& c : lab.columns) {
    const Channel* got = r.find(c.channel);
    ASSERT_NE(got, nullptr) << c.channel;
    for (std::size_t i = 0; i < r.rows(); ++i)
      ASSERT_NEAR(got->values[i], truth.find(c.channel)->values[i], c.rounding())
          << c.channel << " in row " << i;
  }
  if (v.rows_lost > 0) {
    EXPECT_TRUE(std::ranges::any_of(r.remarks.texts(), [](const std::string& remark) {
      return remark.find("cut off") != std::string::npos;
    })) << testing::PrintToString(r.remarks.texts());
  }
}

TEST(LabRecordings, AreSixtyOrMore) {
  EXPECT_GE(variants().size(), 60u);
}

}  // namespace
}  // namespace drift::lab_recordings_test
