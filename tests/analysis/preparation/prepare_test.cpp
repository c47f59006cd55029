#include "analysis/preparation/prepare.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::prepare_test {
namespace {

using test::channel;
using test::says;
using test::simulated;

std::string message(const mc::Study& s, const Recording& r) {
  try {
    prepare(s, {r});
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    return error.what();
  }
  return "";
}

TEST(Prepare, AGoodRecordingIsLeftAsItIs) {
  const mc::Study s = test::six_study();
  const Recording r = simulated(s);
  const Prepared p = prepare(s, {r});
  EXPECT_TRUE(p.remarks.empty()) << p.remarks.front();
  EXPECT_EQ(p.recordings[0].rows(), r.rows());
  EXPECT_EQ(p.recordings[0].find("acc_x")->values, r.find("acc_x")->values);
}

TEST(Prepare, AnotherPlanIsSaid) {
  const mc::Study s = test::six_study();
  mc::Study other = s;
  std::swap(other.plan.positions[1], other.plan.positions[4]);
  EXPECT_NE(message(other, simulated(s)).find("in which they were held: 1, 5, 3, 4, 2, 6."),
            std::string::npos)
      << message(other, simulated(s));
  mc::Study few = s;
  few.plan.positions.resize(3);
  EXPECT_NE(message(few, simulated(s)).find("are not in the plan"), std::string::npos);
  EXPECT_NE(message(test::six_study(1200.0, 40.0), simulated(s)).find("samples are 60 s apart"),
            std::string::npos);
  EXPECT_NE(message(test::six_study(1200.0, 80.0), simulated(s)).find("samples are 60 s apart"),
            std::string::npos);
}

/// The same recording without the columns whose names begin so.
Recording without(Recording r, std::string_view prefix) {
  std::erase_if(r.channels, [&](const Channel& c) { return c.name.starts_with(prefix); });
  return r;
}

mc::Study with_law(mc::Study s, CommandLaw law) {
  for (Position& p : s.plan.positions) p.mode = law;
  return s;
}

TEST(Prepare, PositionsThatThePlanDoesNotHaveAreOneMessage) {
  const mc::Study s = test::six_study();
  mc::Study few = s;
  few.plan.positions.resize(3);
  const std::string said = message(few, simulated(s));
  EXPECT_NE(said.find("positions 4, 5, 6 are not in the plan, in 60 rows from here on (expected "
                      "positions 1 to 3)"),
            std::string::npos)
      << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

TEST(Prepare, DwellsOfAnotherLengthAreRemarkedAndUsed) {
  const mc::Study s = test::six_study();
  Recording r = simulated(s);
  const Prepared all = prepare(test::six_study(600.0), {r});
  EXPECT_TRUE(says(all, "positions 1 to 6 for 20 min (in the plan 10 min)"));
  EXPECT_EQ(all.recordings[0].rows(), r.rows());
  // Position 2 cut short: the last 15 of its 20 rows are gone.
  for (Channel& c : r.channels) c.values.erase(c.values.begin() + 25, c.values.begin() + 40);
  r.lines.erase(r.lines.begin() + 25, r.lines.begin() + 40);
  EXPECT_TRUE(says(prepare(s, {r}), "position 2 for 5 min (in the plan 20 min)"));
}

TEST(Prepare, RecordedCommandsOfAnotherLawAreRemarked) {
  const mc::Study free = test::six_study(), level = with_law(test::six_study(), CommandLaw::level);
  EXPECT_TRUE(says(prepare(level, {simulated(free)}),
                   "the commands in positions 1 to 6 are those of a free dwell, the plan says mode "
                   "= \"level\""));
  EXPECT_TRUE(says(prepare(free, {simulated(level)}),
                   "the commands in positions 1 to 6 are those of a level dwell, the plan says "
                   "mode = \"free\""));
  EXPECT_TRUE(prepare(level, {simulated(level)}).remarks.empty());
  // Earth rate of another latitude: the recording knows better than the study.
  mc::Study elsewhere = level;
  elsewhere.site.latitude = 50.0 * unit::deg.to_si;
  EXPECT_TRUE(says(prepare(elsewhere, {simulated(level)}),
                   "Earth rate at latitude 45.750 deg, [site] says 50.000 deg"));
  Recording odd = simulated(free);
  for (double& x : channel(odd, "cmd_y")) x = 5.0 * unit::deg_per_h.to_si;
  EXPECT_TRUE(
      says(prepare(free, {odd}), "up to 5 deg/h from those of the plan, and of neither law"));
}

TEST(Prepare, WithoutCommandsThePlatformShowsTheLawAndTheWrongOneIsRefused) {
  const mc::Study free = test::six_study(), level = with_law(test::six_study(), CommandLaw::level);
  for (const char* instruments : {"none", "gimbal_", "acc_"}) {
    const Recording drifting = without(without(simulated(free), "cmd_"), instruments);
    const Recording kept = without(without(simulated(level), "cmd_"), instruments);
    EXPECT_NE(message(level, drifting).find("turns at Earth rate against the local axes"),
              std::string::npos)
        << instruments;
    EXPECT_NE(message(level, drifting).find("Set plan.mode = \"free\""), std::string::npos)
        << instruments;
    EXPECT_NE(message(free, kept).find("keeps its attitude to the local axes"), std::string::npos)
        << instruments;
    EXPECT_EQ(message(free, drifting), "") << instruments;
    EXPECT_EQ(message(level, kept), "") << instruments;
  }
}

TEST(Prepare, ALargeDriftIsNoOtherLaw) {
  // Three prior sigmas of everything that drifts: the mean over the positions still tells.
  mc::Study s = test::six_study();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"})
    s.truth.priors[test::param(key)] = fixed(3.0 * unit::deg_per_h.to_si);
  for (const char* key : {"D_I_x", "D_S_y", "D_I_z"})
    s.truth.priors[test::param(key)] = fixed(-6.0 * unit::deg_per_h_per_g.to_si);
  EXPECT_EQ(message(s, without(simulated(s), "cmd_")), "");
}

TEST(Prepare, FiveEqualSamplesAreAStuckSensorWhereNoneRepeatsOtherwise) {
  const mc::Study s = test::six_study(1800.0);
  const auto stuck = [&](std::ptrdiff_t samples) {
    Recording r = simulated(s);
    auto& x = channel(r, "gimbal_inner");
    std::fill(x.begin() + 40, x.begin() + 40 + samples, x[40]);
    return says(prepare(s, {r}), "stands still");
  };
  EXPECT_FALSE(stuck(4));
  EXPECT_TRUE(stuck(5));
}

TEST(Prepare, SampleIntervalsMayDifferFromThePlansByATwentieth) {
  const Recording r = simulated(test::six_study());
  EXPECT_EQ(message(test::six_study(1200.0, 62.9), r), "");
  EXPECT_NE(message(test::six_study(1200.0, 63.2), r).find("samples are 60 s apart"),
            std::string::npos);
}

TEST(Prepare, AClockThatIsOffByAPerMilleIsSaid) {
  const Recording r = simulated(test::six_study());
  const auto said = [&](double sample, const char* what) {
    return says(prepare(test::six_study(1200.0, sample), {r}), what);
  };
  EXPECT_FALSE(said(60.0, "samples are"));
  EXPECT_FALSE(said(60.02, "samples are"));
  EXPECT_TRUE(said(60.06, "samples are 60 s apart, in the plan 60.06 s: 0.1 % shorter"));
  EXPECT_TRUE(said(59.4, "samples are 60 s apart, in the plan 59.4 s: 1 % longer"));
}

TEST(Prepare, TwoPositionsUnderOneNumberAreRefusedWithTheirPlace) {
  const mc::Study s = test::six_study();
  const auto said = [&](std::size_t rows, double number) {
    Recording r = simulated(s);
    auto& position = channel(r, "position");
    const auto last = static_cast<std::ptrdiff_t>(position.size());
    std::fill(position.end() - static_cast<std::ptrdiff_t>(rows), position.begin() + last, number);
    return message(s, without(std::move(r), "cmd_"));
  };
  EXPECT_EQ(said(20, 6.0), "");
  EXPECT_NE(said(20, 5.0).find("within position 5 the platform turns by "), std::string::npos)
      << said(20, 5.0);
  EXPECT_NE(said(20, 5.0).find("at 6060 s"), std::string::npos) << said(20, 5.0);
}

TEST(Prepare, ACommandOneDegPerHourFromThePlansIsSaid) {
  const mc::Study s = test::six_study();
  const auto said = [&](double deg_per_h) {
    Recording r = simulated(s);
    for (double& x : channel(r, "cmd_y")) x = deg_per_h * unit::deg_per_h.to_si;
    return says(prepare(s, {r}), "the commands in");
  };
  EXPECT_FALSE(said(0.99));
  EXPECT_TRUE(said(1.01));
}

TEST(Prepare, ADwellTwoSamplesShortIsSaid) {
  const mc::Study s = test::six_study();
  const auto said = [&](std::ptrdiff_t rows) {
    Recording r = simulated(s);
    for (Channel& c : r.channels)
      c.values.erase(c.values.begin() + 40 - rows, c.values.begin() + 40);
    r.lines.erase(r.lines.begin() + 40 - rows, r.lines.begin() + 40);
    return says(prepare(s, {r}), "position 2 for");
  };
  EXPECT_FALSE(said(1));
  EXPECT_TRUE(said(2));
}

TEST(Prepare, MissingChannelsAndBurstsAreRemarkedAndNothingMeasuredIsRefused) {
  const mc::Study s = test::six_study();
  Recording r = simulated(s);
  std::erase_if(r.channels, [](const Channel& c) { return c.name.starts_with("gimbal_"); });
  auto& x = channel(r, "acc_x");
  std::fill(x.begin() + 10, x.begin() + 15, std::numeric_limits<double>::quiet_NaN());
  const Prepared p = prepare(s, {r});
  EXPECT_TRUE(says(p, "no gimbal_outer"));
  EXPECT_TRUE(says(p, "acc_x lacks 5 of 120 samples, 5 of them in a row from line 11 on"));
  for (const char* name : {"acc_x", "acc_y", "acc_z"})
    std::ranges::fill(channel(r, name), std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(message(s, r).find("nothing measured"), std::string::npos);
}

TEST(Prepare, OnePositionIsSaid) {
  mc::Study s = test::six_study();
  s.plan.positions.resize(1);
  const Prepared p = prepare(s, {simulated(s)});
  EXPECT_TRUE(says(p, "one position only"));
  mc::Study six = test::six_study();
  Recording r = simulated(six);
  for (Channel& c : r.channels) c.values.resize(40);
  r.lines.resize(40);
  EXPECT_EQ(prepare(six, {r}).absent_positions, (std::vector{3, 4, 5, 6}));
}

TEST(Prepare, FineSamplesAreAveragedToThePlanAndKeepWhatTheySay) {
  mc::Study fine = test::six_study(600.0, 1.0);
  fine.readout.accelerometer_noise = 1e-12;
  fine.readout.gimbal_noise = 1e-12;
  mc::Study coarse = test::six_study(600.0, 60.0);
  coarse.readout = fine.readout;
  const Prepared p = prepare(coarse, {simulated(fine)});
  const Recording direct = simulated(coarse);
  ASSERT_EQ(p.recordings[0].rows(), direct.rows());
  EXPECT_TRUE(says(p, "3600 rows 1 s apart are taken as 60 of 60 s"));
  EXPECT_DOUBLE_EQ(p.study.readout.accelerometer_noise, 1e-12);
  for (const char* name :
       {"time", "acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_middle", "gimbal_inner"})
    for (std::size_t k = 0; k < direct.rows(); ++k)
      EXPECT_NEAR(p.recordings[0].find(name)->values[k], direct.find(name)->values[k], 2e-10)
          << name << " " << k;
}

TEST(Prepare, AMillionRowsBecomeFew) {
  mc::Study s = test::six_study(600.0, 60.0);
  Recording r = simulated(s), long_one;
  for (const Channel& c : r.channels) long_one.channels.push_back({c.name, c.unit, {}});
  constexpr std::size_t split = 16000;  // 60 rows become 960,000 of 3.75 ms
  for (std::size_t k = 0; k < r.rows(); ++k)
    for (std::size_t i = 1; i <= split; ++i) {
      for (std::size_t c = 0; c < r.channels.size(); ++c)
        long_one.channels[c].values.push_back(r.channels[c].values[k]);
      long_one.channels[0].values.back() = 0.0;
      long_one.channels[0].values[k * split + i - 1] =
          r.channels[0].values[k] -
          60.0 * (1.0 - static_cast<double>(i) / static_cast<double>(split));
      for (const std::size_t c : {3u, 4u, 5u, 6u, 7u, 8u})  // no two samples alike
        long_one.channels[c].values[k * split + i - 1] += 1e-9 * static_cast<double>(i % 7);
      long_one.lines.push_back(k * split + i + 1);
    }
  for (Position& position : s.plan.positions) position.sample = 60.0 / static_cast<double>(split);
  s.readout.accelerometer_noise = 5e-4;
  const Prepared p = prepare(s, {long_one});
  EXPECT_LE(p.recordings[0].rows(), 1500u + 6u);  // a rest in each position
  EXPECT_GE(p.recordings[0].rows(), 1200u);
  const double length = p.study.plan.positions[0].sample;
  EXPECT_NEAR(p.study.readout.accelerometer_noise,
              5e-4 * std::sqrt(60.0 / static_cast<double>(split) / length), 1e-12);
}

}  // namespace
}  // namespace drift::preparation::prepare_test
