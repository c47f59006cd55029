#include <gtest/gtest.h>

#include "analysis/blind/rivals/export_trials.hpp"
#include "analysis/blind/rivals/rival.hpp"
#include "analysis/blind/rivals/score_rivals.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "core/base/rng.hpp"
#include "core/base/sha256.hpp"
#include "tests/support/program.hpp"

namespace drift::blind::rivals_test {
namespace {

using test::ScratchFolder;
using test::text_of;

/// Twenty candidates of one column each with unit information; nothing is confounded.
RivalTest twenty(std::uint64_t seed) {
  constexpr int K = 20, bins = 60;
  RivalTest t;
  search::Fitted& e = t.examined;
  Stream stream(seed, 0, Purpose::test);
  e.projected = {MatX::Identity(K, K), VecX(K), VecX::Ones(K)};
  for (int k = 0; k < K; ++k) e.projected.g[k] = stream.normal();
  diagnosis::InputEstimate input;
  input.gain = 1.0;
  input.sigma = VecX::Ones(bins);
  input.smoother = MatX::Identity(bins, bins);
  input.cross.resize(bins, K);
  input.value.resize(bins);
  for (double& x : input.cross.reshaped()) x = stream.normal();
  for (double& x : input.value) x = stream.normal();
  t.inputs = {input};
  for (int k = 0; k < K; ++k) {
    e.set.candidates.push_back({"term" + std::to_string(k), "", "", {0}, {}});
    t.columns.push_back({k, static_cast<std::size_t>(k)});
  }
  return t;
}

TEST(Rivals, ForwardSelectionTakesWhatIsThereAndNothingOfNoise) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    alarms += forward_selection(twenty(seed), 0.02).alarm;
  EXPECT_LE(alarms, 11);  // 4 expected; above 11 once in 1000
  RivalTest t = twenty(3);
  t.examined.projected.g[7] += 9.0;
  t.examined.projected.g[12] -= 8.0;
  EXPECT_EQ(forward_selection(t, 0.02).named, (std::vector<std::size_t>{7, 12}));
}

TEST(Rivals, ForwardSelectionDoesNotTakeWhatTheChosenOneExplains) {
  RivalTest t = twenty(4);
  t.examined.projected.C(7, 12) = t.examined.projected.C(12, 7) = 0.9;
  t.examined.projected.g.setZero();
  t.examined.projected.g[7] = 10.0;
  t.examined.projected.g[12] = 9.0;  // its likeness to the other, and nothing else
  EXPECT_EQ(forward_selection(t, 0.02).named, (std::vector<std::size_t>{7}));
}

TEST(Rivals, SparseRegressionsFindTheColumnsThatMakeTheRates) {
  RivalTest t = twenty(5);
  diagnosis::InputEstimate& input = t.inputs.front();
  input.value += 4.0 * input.cross.col(2) - 3.0 * input.cross.col(9);
  for (const auto method : {thresholded_least_squares, lasso}) {
    const RivalAnswer said = method(t, 0.02);
    EXPECT_TRUE(said.alarm);
    for (const std::size_t k : {2u, 9u})
      EXPECT_NE(std::ranges::find(said.named, k), said.named.end());
    EXPECT_LE(said.named.size(), 5u);
  }
  EXPECT_EQ(thresholded_least_squares(t, 0.02).named, (std::vector<std::size_t>{2, 9}));
}

/// Six trials, one of every stratum.
const char* const six_trials =
    "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"twelve\"\ndwell = \"15 "
    "min\"\n"
    "sample = \"180 s\"\n[environment]\ntemperature = \"20 degC\"\ntemperature_amplitude = \"0.4 "
    "degC\"\nfield_n = \"0.25 gauss\"\nfield_w = \"0 gauss\"\nfield_u = \"-0.4 "
    "gauss\"\n[readout]\naccelerometer_noise = \"5 ug\"\ngimbal_noise = "
    "\"5 arcsec\"\n[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = \"nominal\"\ncoupling = "
    "\"eq5\"\n"
    "[monte_carlo]\nseed = 5\n[blind]\ntrials = 6\nplans = [\"twelve\"]\ncouplings = [\"eq5\"]\n"
    "sizes = [30]\npair_size = 30\nmost_prior_sigmas = 100\n[blind.shares]\nnull = 1\n"
    "wrong_noise = 1\nsingle = 1\npair = 1\noutside = 1\nlocal = 1\n";

TEST(Rivals, AreScoredOnEveryTrialAndTheTrialsGoToOthersWithoutTheKey) {
  const ScratchFolder scratch;
  const mc::Study study = mc::read_study(scratch.write("blind.toml", six_trials));
  const std::string folder = scratch.file("out"), others = scratch.file("others");
  const std::string hash = make_trials(study, folder, {1}).value();

  EXPECT_EQ(export_trials(folder, others), 6u);
  EXPECT_EQ(sha256_hex(text_of(others + "/sealed/key.json")), hash);
  EXPECT_NE(text_of(others + "/key.sha256").find(hash), std::string::npos);
  for (const char* file : {"study.toml", "recording.csv"})
    EXPECT_EQ(text_of(others + "/trials/0004/" + file), text_of(folder + "/trials/0004/" + file));

  const std::vector<RivalScore> scores = score_rivals(folder, 0.02, 2);
  ASSERT_EQ(scores.size(), rivals().size());
  for (const RivalScore& s : scores) {
    EXPECT_EQ(s.false_alarms.n, 1u) << s.name;
    EXPECT_EQ(s.noise_alarms.n, 1u) << s.name;
    EXPECT_EQ(s.detected.n, 4u) << s.name;
    EXPECT_EQ(s.right.n, 1u) << s.name;
    EXPECT_LE(s.right.k + s.among.k + s.wrong.k, 1u) << s.name;
    // Effects of 30 sigma: whoever projects sees them.
    if (s.name.starts_with("forward")) {
      EXPECT_GE(s.detected.k, 3u);
    }
  }
}

}  // namespace
}  // namespace drift::blind::rivals_test
