// Recordings as they come: several, with gaps, with columns that mean nothing; and any number of
// threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/absent_channels.hpp"
#include "analysis/preparation/lost_rows.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/base/rng.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::odd_input_test {
namespace {

using test::param;

/// Six positions of 15 min; nominal: fixed and g-sensitive drift. size: of D_SS_x in the truth
/// [deg/h/g^2].
mc::Study study() {
  mc::Study s;
  s.path = "study.toml";
  s.site = test::harbin;
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 900.0;
  s.plan = preset_plan("six", defaults).value();
  s.filters = {test::base_filter(Coupling::eq5)};
  s.filters.front().active = test::only({"D_F", "D_I", "D_O", "D_S"});
  return s;
}

/// One platform, other attitudes and noise in every run.
Recording made(double size, std::uint64_t run) {
  const mc::Study s = study();
  TruthSpec truth = test::base_truth(Coupling::eq5);
  truth.active = s.filters.front().active | test::only({"D_SS_x"});
  const Timeline timeline = lay_out(s.plan, s.site);
  TruthDraw draw = draw_truth(truth, timeline.chains, 4, run);
  const Theta platform = draw_truth(truth, timeline.chains, 4, 0).theta;
  draw.theta = platform;
  draw.theta[param("D_SS_x")] = size * test::deg_per_h;
  return make_recording(timeline, Simulator(truth, s.readout).run(timeline, draw, 4, run).measured,
                        s.readout);
}

constexpr double hidden = 0.3;

Diagnosis diagnosed(const std::vector<Recording>& recordings, int threads = 0) {
  RecordingsOptions options;
  options.diagnose.threads = threads;
  options.advising = Advising::left_out;
  Diagnosis d = diagnose_recordings(study(), recordings, options);
  d.seconds.clear();  // all else is the same on every machine
  return d;
}

void expect_found(const Diagnosis& d) {
  ASSERT_EQ(d.verdict, Verdict::named) << report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u) << report::sentence(d);
  EXPECT_EQ(d.causes[0].term, "g2_drift");
  EXPECT_EQ(d.causes[0].axis, "x");
  ASSERT_FALSE(d.causes[0].parameters.empty());
  for (const search::CauseParameter& p : d.causes[0].parameters)
    EXPECT_NEAR(p.value, p.key == "D_SS_x" ? hidden : 0.0, 4.0 * p.sigma) << p.key;
}

bool says(const Diagnosis& d, std::string_view text) {
  return std::ranges::any_of(d.remarks, [&](const auto& r) {
    return report::in_words(r).find(text) != std::string::npos;
  });
}

/// A recording without rows [first, end).
Recording without_rows(Recording r, std::size_t first, std::size_t end) {
  const auto cut = [&](auto& v) {
    v.erase(v.begin() + static_cast<std::ptrdiff_t>(first),
            v.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (Channel& c : r.channels) cut(c.values);
  if (!r.lines.empty()) cut(r.lines);
  return r;
}

TEST(OddInput, AnInstrumentThatWasNotRecordedIsSaidFirst) {
  Recording r = made(hidden, 0);
  std::erase_if(r.channels, [](const Channel& c) { return c.name.starts_with("acc_"); });
  const Diagnosis d = diagnosed({r});
  EXPECT_TRUE(identification::lacks(d.absent, accelerometer_channels));
  EXPECT_FALSE(identification::lacks(d.absent, gimbal_channels));
  EXPECT_EQ(
      report::sentence(d).find("The recording has no accelerometers: what follows is from the "
                               "gimbal angles alone."),
      0u);
  EXPECT_EQ(nlohmann::json::parse(report::to_json(d))["absent"],
            nlohmann::json({"accelerometers"}));
  EXPECT_TRUE(
      nlohmann::json::parse(report::to_json(diagnosed({made(hidden, 0)})))["absent"].empty());
}

TEST(OddInput, ThreadsDoNotChangeWhatIsFound) {
  const Recording r = made(hidden, 0);
  const Diagnosis one = diagnosed({r}, 1), three = diagnosed({r}, 3);
  expect_found(one);
  EXPECT_EQ(report::to_json(one), report::to_json(three));
}

TEST(OddInput, NoiseTenTimesAsDeclaredIsSaidAndMakesNoOutliersButASpikeIsStillOne) {
  mc::Study s = study();
  s.readout.gimbal_noise /= 10.0;
  s.readout.accelerometer_noise /= 10.0;
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  const auto outliers = [&](const Recording& r) {
    const Diagnosis d = diagnose(s, {r}, options);
    EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
    EXPECT_NE(report::sentence(d).find("times as declared"), std::string::npos)
        << report::sentence(d);
    std::size_t count = 0;
    for (const inference::NoiseFinding& f : d.noise)
      if (f.component == "outliers") count += f.count;
    return count;
  };
  Recording r = made(0.0, 0);
  EXPECT_EQ(outliers(r), 0u);
  for (Channel& c : r.channels)
    if (c.name == "gimbal_outer")
      c.values[20] += 20.0 * study().readout.gimbal_noise;  // of the true noise
  EXPECT_EQ(outliers(r), 1u);
}

TEST(OddInput, ASecondRecordingIsPredictedFromTheFirst) {
  const Diagnosis d = diagnosed({made(hidden, 0), made(hidden, 1)});
  expect_found(d);
  const HeldOut& held = d.fit.held_out;
  EXPECT_EQ(held.method, "refitted");
  EXPECT_EQ(held.folds.size(), 6u);
  ASSERT_EQ(held.recordings.size(), 2u);
  EXPECT_EQ(held.recordings[1].positions.size(), 6u);
  EXPECT_EQ(held.recordings[1].dof, 6u * 15u * 6u);
  EXPECT_GT(held.recording_gain, 0.0);
  EXPECT_NEAR(held.recording_chi2_per_dof_after, 1.0, 0.15);  // 1080 scalars: sigma 0.043
  const auto json = nlohmann::json::parse(report::to_json(d))["fit"]["held_out"];
  EXPECT_EQ(json["folds"], 6);
  EXPECT_EQ(json["by_recording"]["folds"], 2);
  EXPECT_EQ(json["by_recording"]["each"][1]["name"], "recording 2");
}

TEST(OddInput, RowsThatAreMissingWithinAPositionMakeTheNextOneLonger) {
  const Recording whole = made(hidden, 0), gappy = without_rows(whole, 20, 24);
  EXPECT_EQ(gappy.rows() + 4, whole.rows());
  std::vector<std::string> remarks, wrong;
  const Recording ready = preparation::with_begins(gappy, study(), remarks, wrong).recording;
  EXPECT_TRUE(wrong.empty());
  ASSERT_EQ(ready.rows(), gappy.rows());
  EXPECT_EQ(remarks.size(), 1u);
  for (std::size_t k = 0; k < gappy.rows(); ++k) {
    EXPECT_NEAR(ready.find("time")->values[k] - ready.begins[k], k == 20 ? 300.0 : 60.0, 1e-9) << k;
    EXPECT_EQ(std::isnan(ready.find("acc_x")->values[k]), k == 20) << k;
    EXPECT_TRUE(std::isfinite(ready.find("gimbal_outer")->values[k])) << k;
  }
  const Diagnosis d = diagnosed({gappy});
  expect_found(d);
  EXPECT_TRUE(says(d, "4 rows are missing within positions"));
}

TEST(OddInput, AGapInWhichTheCommandChangedIsRefusedWhereTheAnglesDoNotShowIt) {
  Recording r = without_rows(made(0.0, 0), 20, 24);
  for (Channel& c : r.channels)
    if (c.name == "cmd_x")
      for (std::size_t k = 20; k < c.values.size(); ++k) c.values[k] = 1e-3;
  std::vector<std::string> remarks, wrong;
  preparation::with_begins(r, study(), remarks, wrong);
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NE(wrong[0].find("about 4 rows are missing before this one"), std::string::npos);
  EXPECT_NE(wrong[0].find("explains how far the platform turned"), std::string::npos);
}

TEST(OddInput, ACovariateThatExplainsNothingIsNotBlamed) {
  Recording r = made(hidden, 0);
  Stream noise(1, 0, Purpose::test);
  Channel temperature{"temperature", "degC"_unit, {}}, humidity{"humidity", unit::one, {}};
  for (std::size_t k = 0; k < r.rows(); ++k) {
    temperature.values.push_back(20.0 + noise.normal());
    humidity.values.push_back(40.0 + 3.0 * noise.normal());
  }
  r.channels.push_back(temperature);
  r.channels.push_back(humidity);
  const Diagnosis d = diagnosed({r});
  expect_found(d);
  EXPECT_TRUE(std::ranges::any_of(
      d.candidates, [](const auto& c) { return c.term == "temperature_drift"; }));  // it was asked
  for (const RecoveredSignal& s : d.signals)
    EXPECT_TRUE(s.shape.covariate.empty()) << report::shape_text(s);
}

TEST(OddInput, AWholeBaseTermThatTheNominalFilterLacksIsNamedAsOne) {
  mc::Study s = study();
  s.filters.front().active = test::only({"D_F"});
  const Diagnosis d = diagnose(s, {made(0.0, 0)});
  ASSERT_EQ(d.verdict, Verdict::named) << report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u) << report::sentence(d);
  EXPECT_EQ(d.causes[0].term, "g_drift");
  EXPECT_EQ(d.causes[0].parameters.size(), 9u);
  EXPECT_NEAR(d.fit.held_out.chi2_per_dof_after, 1.0, 0.2);
}

TEST(OddInput, OnePositionIsDiagnosedButNothingIsHeldOut) {
  const Recording all = made(0.0, 0);
  const Diagnosis d = diagnosed({without_rows(all, 15, all.rows())});
  EXPECT_TRUE(says(d, "one position only"));
  EXPECT_TRUE(d.fit.held_out.folds.empty());
  EXPECT_FALSE(d.fit.held_out.improves);
  EXPECT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
}

}  // namespace
}  // namespace drift::diagnosis::odd_input_test
