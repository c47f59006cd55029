// Harder trials, asked for by number: strata of their own that change no other trial.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "analysis/blind/design.hpp"
#include "analysis/blind/generate.hpp"
#include "analysis/blind/noise_faults.hpp"
#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "analysis/blind/source.hpp"
#include "tests/support/program.hpp"

namespace drift::blind::further_trials_test {
namespace {

const std::string short_study =
    "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"twelve\"\ndwell = \"15 "
    "min\"\n"
    "sample = \"180 s\"\n[environment]\ntemperature = \"20 degC\"\ntemperature_amplitude = \"0.4 "
    "degC\"\nfield_n = \"0.25 gauss\"\nfield_w = \"0 gauss\"\nfield_u = \"-0.4 gauss\"\n[readout]\n"
    "accelerometer_noise = \"5 ug\"\ngimbal_noise = \"5 arcsec\"\n[truth]\ncoupling = \"eq5\"\n"
    "[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\n[monte_carlo]\nseed = 5\n[blind]\n"
    "trials = 4\nplans = [\"twelve\"]\ncouplings = [\"eq5\"]\nsizes = [8]\nmost_prior_sigmas = "
    "100\n[blind.further]\nother_equation = 1\nnoisy_single = 1\nnoisy_covariate = 1\n";

/// The study, its trials, and one of them made.
struct Made {
  test::ScratchFolder scratch;
  mc::Study study = mc::read_study(scratch.write("blind.toml", short_study));
  std::vector<TrialPlan> plans = design_trials(study.blind, 5);
  MadeTrial trial(std::size_t k) const {
    const mc::Study nominal =
        mc::read_study(scratch.write("nominal.toml", TrialSource(study).nominal_text(plans[k])));
    return TrialSource(study).make(nominal, plans[k]);
  }
};

TEST(BlindFurther, TrialsComeAfterTheOthersAndChangeNoneOfThem) {
  mc::BlindSpec spec;
  spec.trials = 50;
  const auto before = design_trials(spec, 7);
  spec.further = {3, 4, 5};
  const auto after = design_trials(spec, 7);
  ASSERT_EQ(after.size(), before.size() + 12);
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_EQ(after[k].number, k + 1);
    EXPECT_EQ(is_further(after[k].stratum), k >= before.size());
    if (k >= before.size()) continue;
    EXPECT_EQ(after[k].stratum, before[k].stratum);
    EXPECT_EQ(after[k].plan, before[k].plan);
    EXPECT_EQ(after[k].size, before[k].size);
    EXPECT_EQ(after[k].index, before[k].index);
  }
  EXPECT_EQ(after.back().stratum, Stratum::noisy_covariate);
}

TEST(BlindStudy, OfAFurtherTrialTheKeySaysWhatIsHarder) {
  const Made made;
  ASSERT_EQ(made.plans.size(), 7u);
  const KeyEntry equation = made.trial(4).key, noisy = made.trial(5).key,
                 covariate = made.trial(6).key;
  EXPECT_EQ(equation.nominal, "eq6");  // of a truth under eq. (5)
  EXPECT_EQ(equation.effects.front().term, closure_term);
  EXPECT_EQ(equation.effects.front().parameters.front().value, 0.0);
  EXPECT_GT(equation.total_size, 1.0);
  EXPECT_NE(noisy.effects.front().words.find(", beside "), std::string::npos);
  EXPECT_NEAR(noisy.effects.front().size, 8.0, 0.1);
  const auto term = TermLibrary::find_term(covariate.effects.front().term);
  ASSERT_TRUE(term);
  const Needs& needs = TermLibrary::terms[*term].needs;
  EXPECT_TRUE(needs.covariates != 0);
}

TEST(BlindFurther, TrialsAreAnsweredAndScoredWithTheOthers) {
  // They were made and sealed, and never diagnosed: what counts trials knew of the shares' alone.
  test::ScratchFolder scratch;
  const mc::Study study = mc::read_study(scratch.write("blind.toml", short_study));
  const std::string folder = scratch.file("out");
  make_trials(study, folder, {2});
  EXPECT_EQ(trials_state(folder).trials, 7u);
  EXPECT_FALSE(std::filesystem::exists(folder + "/making"));
  ASSERT_TRUE(
      answer_trials(folder, [](const std::string&, const std::string&) { return Answer{}; }, {2}));
  const auto scores = score_folder(folder);
  ASSERT_EQ(scores.size(), 7u);
  for (const TrialScore& s : scores) EXPECT_FALSE(s.answer.failed) << s.answer.failure;
  std::filesystem::remove(folder + "/trials/0007/recording.csv");
  restore_trials(study, folder, true);
  EXPECT_TRUE(is_there(folder, 7));
}

TEST(BlindFurther, ACovariateIsRecordedWithNoiseThatMeetsAtTheEndsOfIntervals) {
  Timeline timeline;
  for (int k = 0; k < 400; ++k) {
    Interval i;
    i.around1[covariate("temperature")] = k % 2 ? 1.0 : -1.0;
    timeline.intervals.push_back(i);
  }
  const Timeline noisy = with_noisy_covariates(timeline, 1, 1);
  double square = 0.0;
  for (std::size_t k = 0; k < noisy.intervals.size(); ++k) {
    const double off = noisy.intervals[k].around1[covariate("temperature")] -
                       timeline.intervals[k].around1[covariate("temperature")];
    square += off * off / 400.0;
    if (k > 0) {
      EXPECT_EQ(noisy.intervals[k].around0[covariate("temperature")],
                noisy.intervals[k - 1].around1[covariate("temperature")]);
    }
  }
  // 0.1 to 0.5 of the rms of 1; the rms of 400 draws is known to 3.5 %, four of which are allowed.
  EXPECT_GT(std::sqrt(square), 0.086);
  EXPECT_LT(std::sqrt(square), 0.57);
}

TEST(BlindFurther, TheNoiseOfCovariatesIsThatOfTheSeedWhateverOthersThereAre) {
  CovariateSpec further = covariate("temperature");
  further.name = "pressure";
  further.number = known_covariates.size();
  further.first = covariate_components;  // where a column of a study's own would be
  further.stream = 1000;
  std::vector<CovariateSpec> all(known_covariates.begin(), known_covariates.end());
  all.insert(all.begin(), further);
  Timeline timeline;
  for (int k = 0; k < 50; ++k) {
    Interval i;
    i.around1[covariate("temperature")] = i.around1[further] = k % 2 ? 1.0 : -1.0;
    i.around1.vector(covariate("field")) = Vec3(0.3, 0.0, -0.4);
    timeline.intervals.push_back(i);
  }
  const Timeline known = with_noisy_covariates(timeline, 5, 3),
                 more = with_noisy_covariates(timeline, 5, 3, all);
  // Of temperature and field as it was drawn for the trials that are published: in turns.
  Stream stream(5, 3, Purpose::design, choice_stream + 1);
  const double temperature = 0.1 * std::pow(5.0, stream.uniform()),
               field = 0.5 * 0.01 * std::pow(5.0, stream.uniform());
  for (std::size_t k = 0; k < known.intervals.size(); ++k) {
    const Covariates &was = timeline.intervals[k].around1, &is = known.intervals[k].around1;
    const double off = temperature * stream.normal();
    EXPECT_NEAR(is[covariate("temperature")] - was[covariate("temperature")], off, 1e-13);
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(is.vector(covariate("field"))[a] - was.vector(covariate("field"))[a],
                  field * stream.normal(), 1e-13);
    for (std::size_t place = 0; place < covariate_components; ++place)
      EXPECT_EQ(more.intervals[k].around1.value[place], is.value[place]) << place;
    EXPECT_NE(more.intervals[k].around1[further], was[further]);
    EXPECT_EQ(is[further], was[further]);
  }
}

}  // namespace
}  // namespace drift::blind::further_trials_test
