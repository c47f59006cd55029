// One and the same test of a platform, kept by loggers of different habits: the same answer.
#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/sentence.hpp"
#include "tests/support/rows_at_any_distance.hpp"

namespace drift::diagnosis {
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
  double seconds = 0.0;
};

Answer diagnosed(const mc::Study& s, const Recording& r) {
  RecordingsOptions options;
  options.advising = Advising::left_out;
  options.diagnose.starts = 1;
  options.diagnose.whiteness_draws = 0;
  const auto began = std::chrono::steady_clock::now();
  Diagnosis d = diagnose_recordings(s, {r}, options);
  return {std::move(d),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()};
}

/// Every habit against rows a minute apart.
void expect_one_answer(double dwell) {
  const mc::Study s = study(dwell);
  const Recording fine = test::second_by_second(s);
  std::vector<Answer> all;
  for (const Rows rows : habits) {
    all.push_back(diagnosed(s, test::with_rows(fine, rows)));
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
      EXPECT_NEAR(p.value, q.value, 0.5 * q.sigma) << p.key << " of " << all.size();
      EXPECT_NEAR(p.sigma, q.sigma, 0.3 * q.sigma) << p.key << " of " << all.size();
      std::cout << all.size() << ": " << p.key << " = " << p.value << " +- " << p.sigma << ", "
                << all.back().seconds << " s\n";
    }
    EXPECT_LT(all.back().seconds, 3.0 * all.front().seconds + 1.0) << all.size();
  }
}

TEST(UnequalRowsDiagnosed, TheSameTestOfTenMinutesAPositionIsAnsweredAlike) {
  expect_one_answer(600.0);
}

TEST(UnequalRowsNightly, TheSameTestOfAnHourAPositionIsAnsweredAlike) {
  expect_one_answer(3600.0);
}

TEST(UnequalRowsDiagnosed, IdentifyAcceptsTheSameFilesAndEstimatesTheSame) {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  const Recording fine = test::second_by_second(s);
  std::vector<ParameterEstimate> first;
  for (const Rows rows : habits) {
    const auto id = identification::identify_recordings(s, {test::with_rows(fine, rows)}, 1);
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
}  // namespace drift::diagnosis
