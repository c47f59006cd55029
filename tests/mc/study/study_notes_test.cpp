// Notes on settings of the command line that change nothing, and on sweeps that compare noise.
#include "mc/study/study_notes.hpp"

#include <gtest/gtest.h>

#include "tests/mc/small_study.hpp"
#include "tests/mc/study/listed_study.hpp"
#include "tests/mc/study/study_file.hpp"

namespace drift::study_notes_test {
namespace {

using test::listed_study;
using test::read_text;
using test::small_study;

TEST(StudyNotes, ASettingWithoutEffectIsNoted) {
  const auto note = [](const std::string& key, const std::string& value,
                       const std::string& more = "") {
    return mc::idle_settings_text(read_text(listed_study + more, {{key, value}}));
  };
  EXPECT_EQ(note("plan.dwell", "20 min"),
            "note: --set plan.dwell changes nothing: every position has a dwell of its own. Name "
            "that of a position (plan.position.0.dwell), or remove it from the positions\n");
  EXPECT_NE(note("truth.parameters.eta", "1 arcsec").find("eta_x, eta_y and eta_z have values"),
            std::string::npos);
  EXPECT_EQ(note("truth.parameters.eta_x", "1 arcsec"), "");
  EXPECT_EQ(note("filter.f5.parameters.eta", "1 arcsec"), "");
  EXPECT_EQ(note("plan.position.second.dwell", "20 min"), "");
  EXPECT_NE(note("readout.gimbal_noise", "1 arcsec"), "");
  EXPECT_EQ(note("readout.gimbal_noise", "1 arcsec", "[sweep]\n\"readout.gimbals\" = [true]\n"),
            "");
  EXPECT_EQ(mc::idle_settings_text(read_text(listed_study)), "");
}

TEST(StudyNotes, ASweptSampleIsNotedUnlessTheNoiseIsSweptToo) {
  const auto note = [](const std::string& lines) {
    return mc::swept_sample_text(read_text(small_study + "[sweep]\n" + lines));
  };
  const std::string samples = "\"plan.sample\" = [\"1 min\", \"2 min\"]\n";
  EXPECT_EQ(note(samples).find("note: plan.sample is swept, the noise of [readout] is not: "), 0u)
      << note(samples);
  EXPECT_NE(note("plan = [{ sample = \"1 min\" }, { sample = \"2 min\" }]\n"), "");
  EXPECT_EQ(note(samples + "\"readout.accelerometer_noise\" = [\"5 ug\", \"7 ug\"]\n"), "");
  EXPECT_EQ(note("\"plan.sample\" = [\"1 min\"]\n"), "");
  EXPECT_EQ(note("\"plan.dwell\" = [\"20 min\", \"40 min\"]\n"), "");
  EXPECT_NE(mc::swept_sample_text(
                read_text(listed_study + "[sweep]\n\"plan.position.second.sample\" = [\"1 min\", "
                                         "\"2 min\"]\n")),
            "");
}

}  // namespace
}  // namespace drift::study_notes_test
