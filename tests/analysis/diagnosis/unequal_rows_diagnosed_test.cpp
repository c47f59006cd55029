// One and the same test of a platform, kept by loggers of different habits: the same answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/rows_at_any_distance.hpp"

namespace drift::diagnosis::unequal_rows_diagnosed_test {
namespace {

using test::Rows;

constexpr Rows habits[] = {Rows::each_minute, Rows::each_second,  Rows::seconds_in_slews,
                           Rows::jittered,    Rows::minutes_lost, Rows::seconds_lost};

/// The platform obeys eq. (6), the nominal model eq. (5).
mc::Study study(double dwell) {
  return test::slewing_study(dwell, Coupling::eq6, Coupling::eq5);
}

/// What one way of recording comes to.
struct Answer {
  Diagnosis d;
  double seconds = 0.0;  ///< of one processor
};

Answer diagnosed(const mc::Study& s, const Recording& r) {
  RecordingsOptions options;
  options.advising = Advising::left_out;
  options.diagnose.starts = 1;
  options.diagnose.whiteness_draws = 0;
  options.diagnose.threads = 1;
  const std::clock_t began = std::clock();
  Diagnosis d = diagnose_recordings(s, {r}, options);
  return {std::move(d), static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC};
}

/// How far an estimate may be from that of rows a minute apart: half a sigma where all that was
/// measured is there, and where rows are lost by what is lost with them (the difference of an
/// estimate from a part of the data has the variance that the sigma grows by).
double room(double sigma_of_all, double sigma) {
  const double grown = std::sqrt(std::max(0.0, sigma * sigma - sigma_of_all * sigma_of_all));
  return std::max(0.5 * sigma_of_all, 2.5 * grown);
}

/// Some habits against the first of them.
void expect_one_answer(double dwell, const std::vector<Rows>& some) {
  const mc::Study s = study(dwell);
  const Recording fine = test::second_by_second(s);
  std::vector<Answer> all;
  for (const Rows rows : some) {
    all.push_back(diagnosed(s, test::with_rows(fine, rows, s.readout.gimbal_noise)));
    const Diagnosis& d = all.back().d;
    const Diagnosis& first = all.front().d;
    ASSERT_EQ(d.verdict, Verdict::named) << all.size() << ": " << report::sentence(d);
    ASSERT_EQ(d.causes.size(), 1u) << all.size() << ": " << report::sentence(d);
    EXPECT_EQ(d.causes[0].term, "frame_closure");
    ASSERT_EQ(d.causes[0].parameters.size(), first.causes[0].parameters.size());
    for (std::size_t k = 0; k < d.causes[0].parameters.size(); ++k) {
      const auto& p = d.causes[0].parameters[k];
      const auto& q = first.causes[0].parameters[k];
      EXPECT_EQ(p.key, q.key);
      EXPECT_NEAR(p.value, q.value, room(q.sigma, p.sigma)) << p.key << " of " << all.size();
      EXPECT_NEAR(p.sigma, q.sigma, 0.3 * q.sigma) << p.key << " of " << all.size();
      std::cout << all.size() << ": " << p.key << " = " << p.value << " +- " << p.sigma << ", "
                << all.back().seconds << " s\n";
    }
    EXPECT_LT(all.back().seconds, 3.0 * all.front().seconds) << all.size();
  }
}

TEST(UnequalRowsDiagnosed, TheSameTestOfTenMinutesAPositionIsAnsweredAlike) {
  expect_one_answer(600.0, {Rows::each_minute, Rows::seconds_in_slews});
}

TEST(UnequalRowsNightly, TheSameTestOfAnHourAPositionIsAnsweredAlike) {
  expect_one_answer(3600.0, {std::begin(habits), std::end(habits)});
}

TEST(UnequalRowsDiagnosed, IdentifyAcceptsTheSameFilesAndEstimatesTheSame) {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  const Recording fine = test::second_by_second(s);
  std::vector<ParameterEstimate> first;
  for (const Rows rows : habits) {
    const auto id = identification::identify_recordings(
        s, {test::with_rows(fine, rows, s.readout.gimbal_noise)}, 1);
    const auto& found = id.runs.front().batch.estimate.parameters;
    if (first.empty()) first = found;
    ASSERT_EQ(found.size(), first.size());
    double squares = 0.0, farthest = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double off = (found[k].value - first[k].value) / first[k].sigma;
      squares += off * off;
      farthest = std::max(farthest, std::abs(off));
    }
    std::cout << "habit " << static_cast<int>(rows) << ": farthest " << farthest << " sigma, rms "
              << std::sqrt(squares / static_cast<double>(found.size())) << "\n";
    EXPECT_LT(std::sqrt(squares / static_cast<double>(found.size())), 0.5);
  }
}

}  // namespace
}  // namespace drift::diagnosis::unequal_rows_diagnosed_test
