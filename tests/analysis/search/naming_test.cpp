// Statistics of detection and naming on synthetic linear tests with Gaussian noise, where theory
// says what must come out. Every tolerance is three standard errors of the count or mean it bounds.
#include <gtest/gtest.h>

#include "analysis/search/pairs.hpp"
#include "core/base/rng.hpp"
#include "tests/support/white_problem.hpp"

namespace drift::search::naming_test {
namespace {

constexpr Eigen::Index rows = 120, parameters = 8, candidates = 12;

double three_errors(double p, int n) {
  return 3.0 * std::sqrt(p * (1.0 - p) / n);
}

/// Columns with common parts, so that parameters absorb and candidates resemble each other.
struct Synthetic {
  MatX theta, extra;
  inference::CandidateSet set;

  Synthetic() {
    Stream random(77, 0, Purpose::test);
    const auto fill = [&](Eigen::Index n) {
      MatX m(rows, n);
      for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = random.normal();
      return m;
    };
    theta = fill(parameters);
    extra = fill(candidates) +
            2.0 * theta * fill(rows).topLeftCorner(parameters, candidates) / std::sqrt(parameters);
    extra.col(1) = 0.8 * extra.col(0) + 0.6 * extra.col(1);
    for (int k = 0; k < candidates; ++k)
      set.candidates.push_back(
          {"term" + std::to_string(k), "", "", {static_cast<std::size_t>(k)}, {{{k}, {}}}});
  }
  /// Scores of data with parameters from their prior and candidate amplitudes a.
  inference::Projector test(std::uint64_t run, const VecX& a) const {
    Stream random(78, run, Purpose::test);
    VecX r(rows), x(parameters);
    for (double& v : x) v = random.normal();
    for (double& v : r) v = random.normal();
    r += theta * x + extra * a;
    return {drift::test::white_problem(theta, extra, r), {}};
  }
};

const Synthetic& synthetic() {
  static const Synthetic s;
  return s;
}

/// Amplitude of candidate k that leaves `size` sigmas after projection.
VecX amplitude(Eigen::Index k, double size) {
  const inference::Projected p = synthetic().test(0, VecX::Zero(candidates)).candidates();
  return size / std::sqrt(p.C(k, k)) * VecX::Unit(candidates, k);
}

const std::vector<inference::PositionScan> no_scans;

inference::MaxNull the_null() {
  const inference::Projector p = synthetic().test(0, VecX::Zero(candidates));
  const Field field(synthetic().set, p.candidates(), no_scans);
  return {field.projected.C, field.all_contrasts(), 4000, 1};
}

double largest(const Field& field) {
  double top = 0.0;
  for (std::size_t k = 0; k < field.contrasts.size(); ++k)
    top = std::max(top, score(field, k).strength);
  return top;
}

TEST(Naming, FamilyWiseFalseAlarmsAreAsManyAsAllowed) {
  constexpr int n = 2000;
  constexpr double alpha = 0.05;
  const double k = the_null().threshold(alpha);
  int alarms = 0;
  for (int run = 0; run < n; ++run) {
    const inference::Projector p = synthetic().test(run, VecX::Zero(candidates));
    alarms += largest({synthetic().set, p.candidates(), no_scans}) > k;
  }
  // The threshold itself is estimated from 4000 draws: its error adds to that of the count.
  EXPECT_NEAR(alarms / static_cast<double>(n), alpha,
              std::hypot(three_errors(alpha, n), three_errors(alpha, 4000)));
}

TEST(Naming, PowerIsThatOfANormalScore) {
  constexpr int n = 1000;
  constexpr double size = 4.0;
  const inference::MaxNull null = the_null();
  const double k = null.threshold(0.05), z = std::sqrt(stats::quantile_of_strength(k, 1));
  int found = 0;
  for (int run = 0; run < n; ++run) {
    const inference::Projector p = synthetic().test(run, amplitude(3, size));
    const Field field(synthetic().set, p.candidates(), no_scans);
    found += score(field, 3).strength > k;
  }
  const double power =
      0.5 * std::erfc((z - size) / std::sqrt(2.0)) + 0.5 * std::erfc((z + size) / std::sqrt(2.0));
  EXPECT_NEAR(found / static_cast<double>(n), power, three_errors(power, n));
}

TEST(Naming, ExpectedParameterChangeHasUnitPull) {
  constexpr int n = 1000;
  double mean = 0.0, square = 0.0;
  const VecX a = amplitude(3, 6.0);
  for (int run = 0; run < n; ++run) {
    const inference::Projected p = synthetic().test(run, a).candidates();
    const double pull = (p.g[3] / p.C(3, 3) - a[3]) * std::sqrt(p.C(3, 3));
    mean += pull / n;
    square += pull * pull / n;
  }
  EXPECT_NEAR(mean, 0.0, 3.0 / std::sqrt(n));
  EXPECT_NEAR(square, 1.0, 3.0 * std::sqrt(2.0 / n));
}

TEST(Naming, TheTruthIsInTheAdequateSetAsOftenAsPromised) {
  // Under the true d every conditional score is central chi-square, whatever the cosine.
  constexpr int n = 1000;
  const double k = the_null().threshold(0.05);
  const VecX a = amplitude(0, 8.0);
  int covered = 0, single_and_wrong = 0;
  for (int run = 0; run < n; ++run) {
    const inference::Projector p = synthetic().test(run, a);
    const Field field(synthetic().set, p.candidates(), no_scans);
    std::vector<std::size_t> adequate;
    for (std::size_t d = 0; d < synthetic().set.candidates.size(); ++d)
      if (remainder(field, {{d, 0}}).library <= k) adequate.push_back(d);
    covered += !adequate.empty() && adequate.front() == 0;
    single_and_wrong += adequate.size() == 1 && adequate.front() != 0;
  }
  EXPECT_GE(covered / static_cast<double>(n), 0.95 - three_errors(0.95, n));
  EXPECT_LE(single_and_wrong / static_cast<double>(n), 0.01 + three_errors(0.01, n));
}

TEST(Naming, ACancellingPairIsFoundThoughNoSingleScoreShowsIt) {
  constexpr int n = 200;
  const inference::Projected unit = synthetic().test(0, VecX::Zero(candidates)).candidates();
  const double rho = unit.C(0, 1) / std::sqrt(unit.C(0, 0) * unit.C(1, 1));
  ASSERT_GT(rho, 0.6);  // else the pair does not cancel
  const VecX a = amplitude(0, 10.0) - amplitude(1, 10.0);
  const double expected = 200.0 * (1.0 - rho);  // a' C a
  double mean = 0.0;
  int pair_first = 0;
  for (int run = 0; run < n; ++run) {
    const inference::Projector p = synthetic().test(run, a);
    const Field field(synthetic().set, p.candidates(), no_scans);
    const auto pairs = strongest_pairs(field, 1);
    pair_first += pairs.front().a.candidate + pairs.front().b.candidate == 1;
    const auto both = inference::make_contrast(field.projected.C, field.projected.raw, {0, 1});
    mean += both.T(field.projected.g) / n;
  }
  EXPECT_NEAR(mean, expected + 2.0,
              3.0 * std::sqrt((4.0 * expected + 4.0) / n));  // non-central chi-square
  EXPECT_GT(pair_first, n * 9 / 10);
}

}  // namespace
}  // namespace drift::search::naming_test
