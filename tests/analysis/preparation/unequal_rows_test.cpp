// Rows at any distance from each other: what becomes of them before anything is estimated.
#include <gtest/gtest.h>

#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/sim/predict.hpp"
#include "tests/support/rows_at_any_distance.hpp"

namespace drift::preparation::unequal_rows_test {
namespace {

using test::Rows;
using test::with_rows;

/// Ten minutes a position and no noise to speak of; the truth is at its prior means.
mc::Study study() {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  s.truth.active = test::only({"D_F"});
  s.readout.accelerometer_noise = 1e-12;
  s.readout.gimbal_noise = 1e-12;
  return s;
}

const Recording& fine() {
  static const Recording r = test::second_by_second(study());
  return r;
}

bool says(const Prepared& p, std::string_view text) {
  return std::ranges::any_of(
      p.remarks, [&](const std::string& r) { return r.find(text) != std::string::npos; });
}

std::string refusal(const Recording& r) {
  try {
    prepare(study(), {r});
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    return error.what();
  }
  return "";
}

/// Largest difference between what the rows say and what the truth would show over the intervals
/// that they are given: [g], [rad].
struct Misfit {
  double acc = 0.0, gimbal = 0.0;
  std::size_t measured = 0;  ///< accelerometer scalars
};

Misfit misfit(const Prepared& p) {
  const RecordedTest made = recorded_test(p.study, p.recordings);
  const TruthDraw draw = draw_truth(study().truth, made.timeline.chains, 1, 0);
  const Measurements truth = predict(made.timeline, study().truth.model(), draw.theta,
                                     {draw.psi0_l.begin(), draw.psi0_l.end()}, p.study.readout);
  Misfit m;
  for (Eigen::Index i = 0; i < truth.acc.cols(); ++i)
    for (int a = 0; a < 3; ++a) {
      if (const double e = made.measured.acc(a, i) - truth.acc(a, i); std::isfinite(e)) {
        m.acc = std::max(m.acc, std::abs(e));
        ++m.measured;
      }
      if (const double e = angle_difference(made.measured.gimbal(a, i), truth.gimbal(a, i));
          std::isfinite(e))
        m.gimbal = std::max(m.gimbal, std::abs(e));
    }
  return m;
}

class AnyRows : public ::testing::TestWithParam<Rows> {};
INSTANTIATE_TEST_SUITE_P(UnequalRows, AnyRows,
                         ::testing::Values(Rows::each_second, Rows::each_minute,
                                           Rows::seconds_in_slews, Rows::jittered,
                                           Rows::minutes_lost, Rows::seconds_lost));

TEST_P(AnyRows, SayWhatHappenedInTheirOwnIntervals) {
  const Recording r = with_rows(fine(), GetParam());
  const Prepared p = prepare(study(), {r});
  const Misfit m = misfit(p);
  EXPECT_LT(m.acc, 3e-6) << "3 ug: what bridging a hole in a slew may cost";
  EXPECT_LT(m.gimbal, 0.05 * test::arcsec);
  const std::size_t minutes = with_rows(fine(), Rows::each_minute).rows();
  EXPECT_LT(p.recordings[0].rows(), minutes * 5 / 4);
  EXPECT_GT(p.recordings[0].rows(), minutes * 4 / 5);
  EXPECT_GT(m.measured, 3 * minutes * 7 / 10);
  double weight = 0.0;  // never more than the minutes that were recorded
  for (const double n : p.recordings[0].samples) weight += n;
  EXPECT_LE(weight, 1.01 * static_cast<double>(minutes));
}

/// Gimbals that say nowhere when a command changed are no missing rows.
TEST(UnequalRows, GimbalsOfTheWrongSignOrUnitAreNoMissingRows) {
  const Recording right = with_rows(fine(), Rows::seconds_in_slews);
  EXPECT_EQ(refusal(right), "");
  for (const auto& [name, times, words] :
       std::initializer_list<std::tuple<const char*, double, const char*>>{
           {"gimbal_inner", -1.0, "gimbal_inner = \"-gimbal_inner\""},
           {"gimbal_outer", -1.0, "gimbal_outer = \"-gimbal_outer\""},
           {"gimbal_", detail::deg, "are in another unit"}}) {
    Recording wrong = right;
    for (Channel& c : wrong.channels)
      if (c.name.starts_with(name))
        for (double& angle : c.values) angle *= times;
    const std::string said = refusal(wrong);
    EXPECT_NE(said.find(words), std::string::npos) << name << said;
    EXPECT_EQ(said.find("are missing before"), std::string::npos) << said;
  }
}

TEST(UnequalRows, AreNotReadAsMissing) {
  const Prepared p = prepare(study(), {with_rows(fine(), Rows::seconds_in_slews)});
  EXPECT_FALSE(says(p, "missing"));
  EXPECT_TRUE(says(p, "rows at several distances are taken as"));
}

TEST(UnequalRows, RowsThatAreLongEnoughStayAsTheyAre) {
  const Recording r = with_rows(fine(), Rows::jittered);
  const Prepared p = prepare(study(), {r});
  EXPECT_EQ(p.recordings[0].rows(), r.rows());
  EXPECT_EQ(p.recordings[0].find("acc_y")->values[5], r.find("acc_y")->values[5]);
  const auto& time = r.find("time")->values;
  EXPECT_DOUBLE_EQ(p.recordings[0].samples[5], (time[5] - time[4]) / 60.0);
}

TEST(UnequalRows, ARowLongerThanThePlansIsTheMeanOfSoMuchMore) {
  Recording r = with_rows(fine(), Rows::each_minute);
  std::size_t rows = 0;  // of the first dwell: from the third on two become one
  while (r.find("position")->values[rows] == 1.0 && r.find("phase")->values[rows] == 0.0) ++rows;
  ASSERT_GT(rows, 9u);
  for (std::size_t k = rows / 2 * 2 - 2; k >= 2; k -= 2) {
    for (Channel& c : r.channels) {
      if (c.name.starts_with("acc_")) c.values[k + 1] = 0.5 * (c.values[k] + c.values[k + 1]);
      c.values.erase(c.values.begin() + static_cast<std::ptrdiff_t>(k));
    }
    r.lines.erase(r.lines.begin() + static_cast<std::ptrdiff_t>(k));
  }
  const Prepared p = prepare(study(), {r});
  ASSERT_EQ(p.recordings[0].rows(), r.rows());
  EXPECT_DOUBLE_EQ(p.recordings[0].samples[1], 1.0);
  EXPECT_DOUBLE_EQ(p.recordings[0].samples[4], 2.0);
  EXPECT_LT(misfit(p).acc, 1e-6);
}

TEST(UnequalRows, WhenASlewBeganIsReadOffTheGimbalsWhereRowsAreMissingAndRefusedWithoutThem) {
  const Recording minutes = with_rows(fine(), Rows::each_minute);
  const auto& phase = minutes.find("phase")->values;
  std::size_t slew = 1;  // the first row of the first slew
  while (phase[slew] == 0.0) ++slew;
  for (const std::size_t lost : {slew - 1, slew}) {
    Recording r = minutes;
    for (Channel& c : r.channels) c.values.erase(c.values.begin() + static_cast<long>(lost));
    r.lines.erase(r.lines.begin() + static_cast<long>(lost));
    const Prepared p = prepare(study(), {r});
    EXPECT_TRUE(says(p, "1 row is missing within positions, in 1 gap")) << lost;
    const Misfit m = misfit(p);
    EXPECT_LT(m.gimbal, 0.05 * test::arcsec) << lost;
    EXPECT_LT(m.acc, 1e-7) << lost;
    std::erase_if(r.channels, [](const Channel& c) { return c.name.starts_with("gimbal_"); });
    EXPECT_NE(refusal(r).find("no gimbal angles tell when the command changed"), std::string::npos)
        << lost;
  }
}

/// Of rows of a second those that end at these, accelerometers averaged.
Recording ending_at(const Recording& seconds, const std::vector<std::size_t>& ends) {
  Recording out;
  for (const Channel& c : seconds.channels) {
    Channel thin{c.name, c.unit, {}};
    std::size_t from = 0;
    for (const std::size_t end : ends) {
      double sum = 0.0;
      for (std::size_t k = from; k < end; ++k) sum += c.values[k];
      thin.values.push_back(c.name.starts_with("acc_") ? sum / static_cast<double>(end - from)
                                                       : c.values[end - 1]);
      from = end;
    }
    out.channels.push_back(std::move(thin));
  }
  for (std::size_t k = 0; k < ends.size(); ++k) out.lines.push_back(k + 2);
  return out;
}

TEST(UnequalRows, ARecordingMayBeginOnTheWay) {
  // What drift did before it began nobody knows: the gimbals say where the platform was.
  Recording r = with_rows(fine(), Rows::each_minute);
  const auto& position = r.find("position")->values;
  const long first = std::ranges::find(position, 5.0) - position.begin();
  ASSERT_EQ(r.find("phase")->values[static_cast<std::size_t>(first)], 1.0);
  for (Channel& c : r.channels) c.values.erase(c.values.begin(), c.values.begin() + first);
  r.lines.erase(r.lines.begin(), r.lines.begin() + first);
  const Prepared p = prepare(study(), {r});
  EXPECT_EQ(p.absent_positions, (std::vector<int>{1, 2, 3, 4}));
  // At the truth nothing is left but what drift of a degree an hour does in one row, and the
  // attitude error that the whole test began with.
  EXPECT_LT(misfit(p).gimbal, 1000.0 * test::arcsec);
}

TEST(UnequalRows, AShortRowLostBesideASlewIsSeenByHowFarThePlatformTurned) {
  // Rows of 60 s, the last of a dwell of 20: lost, it is no gap by its length.
  const auto without_one = [&](std::size_t first_of_slew) {
    const auto& phase = fine().find("phase")->values;
    std::vector<std::size_t> ends;
    for (std::size_t first = 0; first < fine().rows();) {
      std::size_t end = first + 1;
      while (end < fine().rows() && phase[end] == phase[first]) ++end;
      const bool slew = phase[first] == 1.0;
      for (std::size_t at = first + (slew ? first_of_slew : 60); at + 30 < end; at += 60)
        ends.push_back(at);
      if (!slew) ends.push_back(end - 20);
      if (first > 0) ends.push_back(end);  // of the first dwell it is lost
      first = end;
    }
    return ending_at(fine(), ends);
  };
  const Prepared p = prepare(study(), {without_one(60)});
  EXPECT_TRUE(says(p, "1 row is missing within positions, in 1 gap"));
  EXPECT_LT(misfit(p).gimbal, 0.05 * test::arcsec);
  EXPECT_NE(refusal(without_one(25)).find("no time at which a row would have stood"),
            std::string::npos);
}

TEST(UnequalRows, TheFirstRowOfACagedPositionIsAsLongAsItsDwellSays) {
  mc::Study s = study();
  for (Position& p : s.plan.positions) p.entry = Entry::caged;
  mc::Study each_second = s;
  for (Position& p : each_second.plan.positions) p.sample = 1.0;
  const Timeline timeline = lay_out(each_second.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  const Recording seconds = make_recording(
      timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured, s.readout);
  for (const bool jittered : {false, true}) {
    std::vector<std::size_t> ends;
    for (std::size_t first = 0; first < seconds.rows(); first += 600)
      for (std::size_t at = jittered ? 60 : 120; at <= 600; at += 60) {
        const std::size_t jitter = (7 * first / 600 + 5 * at / 60) % 7;
        ends.push_back(first + at + (jittered && at < 600 ? jitter : 3) - 3);
      }
    const Prepared p = prepare(s, {ending_at(seconds, ends)});
    EXPECT_EQ(says(p, "the first row of 12 caged positions is longer"), !jittered);
    EXPECT_LT(misfit(p).gimbal, 0.05 * test::arcsec) << jittered;
    EXPECT_LT(misfit(p).acc, 1e-7) << jittered;
  }
}

TEST(UnequalRows, AWayToTheNextPositionThatIsMissingAltogetherIsRefused) {
  Recording r = with_rows(fine(), Rows::each_minute);
  std::vector<bool> lost;
  for (std::size_t k = 0; k < r.rows(); ++k)
    lost.push_back(r.find("position")->values[k] == 2.0 && r.find("phase")->values[k] == 1.0);
  const auto cut = [&](auto& v) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
      if (!lost[k]) v[kept++] = v[k];
    v.resize(kept);
  };
  for (Channel& c : r.channels) cut(c.values);
  cut(r.lines);
  EXPECT_NE(refusal(r).find("the whole way from one position to the next"), std::string::npos);
}

TEST(UnequalRows, NoiseIsWeightedByWhatARowAverages) {
  const Prepared p = prepare(study(), {with_rows(fine(), Rows::seconds_in_slews)});
  const Recording& r = p.recordings[0];
  const RecordedTest made = recorded_test(p.study, p.recordings);
  for (std::size_t k = 1; k < r.rows(); ++k) {
    const Interval& i = made.timeline.intervals[k];
    const double averaged = i.slew ? 60.0 / i.length() : 1.0;
    EXPECT_NEAR(i.accelerometer_noise(5e-6), 5e-6 * std::sqrt(averaged), 1e-12) << k;
  }
}

TEST(UnequalRows, RecordingsOfDifferentIntervalsAreTakenTogether) {
  mc::Study s = study();
  for (Position& p : s.plan.positions) p.entry = Entry::caged;
  const auto each = [&](double sample) {
    mc::Study other = s;
    for (Position& p : other.plan.positions) p.sample = sample;
    const Timeline t = lay_out(other.plan, other.site);
    const TruthDraw draw = draw_truth(other.truth, t.chains, 1, 0);
    return make_recording(t, Simulator(other.truth, s.readout).run(t, draw, 1, 0).measured,
                          s.readout);
  };
  const Prepared p = prepare(s, {each(60.0), each(1.0), each(20.0)});
  EXPECT_EQ(p.recordings[0].rows(), 120u);
  EXPECT_EQ(p.recordings[1].rows(), 120u);
  EXPECT_EQ(p.recordings[2].rows(), 120u);
  for (std::size_t k = 0; k < 120; ++k)
    EXPECT_NEAR(p.recordings[1].find("acc_x")->values[k], p.recordings[0].find("acc_x")->values[k],
                2e-10);
}

}  // namespace
}  // namespace drift::preparation::unequal_rows_test
