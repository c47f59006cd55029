#include "mc/study/sweep.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/sim/truth.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::sweep_test {
namespace {

using namespace drift::test;

/// A function: another file's text need not be there yet when this one's globals are made.
std::string swept() {
  return small_study + R"toml([sweep]
"truth.coupling" = ["eq5", "eq6", "servo"]
"truth.parameters.eta" = ["20 arcsec", { normal = ["0 arcsec", "100 arcsec"] }]
)toml";
}

TEST(Sweep, IsEveryCombinationLastAxisFastest) {
  const auto points = mc::study_points(read_text(swept()));
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points[0].label, "truth.coupling = eq5, truth.parameters.eta = 20 arcsec");
  EXPECT_EQ(points[1].values[0].second, "eq5");
  EXPECT_EQ(points[2].values[0].second, "eq6");
  EXPECT_EQ(points[5].study.truth.coupling, Coupling::servo);
  EXPECT_EQ(points[5].study.truth.priors[TermLibrary::index("eta_y")].kind, Prior::Kind::normal);
  for (const auto& p : points) {
    EXPECT_TRUE(p.study.sweep.empty());
    EXPECT_EQ(p.study.monte_carlo.seed, 5u);
    EXPECT_EQ(p.study.filters.size(), 2u);
  }
}

TEST(Sweep, GivesIdsThatStayAndDiffer) {
  const auto first = mc::study_points(read_text(swept())),
             again = mc::study_points(read_text(swept()));
  std::set<std::string> ids;
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].id, again[k].id);
    EXPECT_EQ(first[k].id.size(), 16u);
    ids.insert(first[k].id);
  }
  EXPECT_EQ(ids.size(), first.size());
  // The text of a point is a study of its own: the same point again.
  const auto alone = mc::study_points(read_text(first[3].study.text));
  EXPECT_EQ(alone.front().id, first[3].id);
}

TEST(Sweep, WithoutSweepIsOnePointWithoutLabel) {
  const auto points = mc::study_points(read_text(small_study));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points[0].label.empty());
}

TEST(Sweep, SharesRandomNumbersBetweenPoints) {
  // Truth parameters that are not swept are the same in run k of every point.
  const auto points = mc::study_points(read_text(swept()));
  const Theta a = draw_truth(points[0].study.truth, 6, 5, 7).theta,
              b = draw_truth(points[5].study.truth, 6, 5, 7).theta;
  EXPECT_EQ(a[TermLibrary::index("D_I_z")], b[TermLibrary::index("D_I_z")]);
  EXPECT_NE(a[TermLibrary::index("eta_z")], b[TermLibrary::index("eta_z")]);
}

TEST(Sweep, DropsWhatOnlyAnotherCouplingUses) {
  std::string text = small_study +
                     "[truth.servo]\nfloat_restraint = \"0.1 "
                     "N*m/rad\"\n[sweep]\n\"truth.coupling\" = [\"eq5\", \"servo\"]\n";
  const auto points = mc::study_points(read_text(text));
  EXPECT_EQ(points[0].study.text.find("float_restraint"), std::string::npos);
  EXPECT_NE(points[1].study.text.find("float_restraint"), std::string::npos);
}

TEST(Sweep, RefusesValuesAndKeysThatMakeNoStudy) {
  const auto found = [](const std::string& sweep) {
    return mistakes(small_study + "[sweep]\n" + sweep);
  };
  ASSERT_EQ(found("\"truth.coupling\" = [\"eq5\", \"eq7\"]\n").size(), 1u);
  EXPECT_NE(found("\"truth.coupling\" = [\"eq5\", \"eq7\"]\n")[0].find("eq7"), std::string::npos);
  EXPECT_FALSE(found("\"monte_carlo.runs\" = [10, 20]\n").empty());
  EXPECT_FALSE(found("\"monte_carlo.seed\" = [1, 2]\n").empty());
  EXPECT_TRUE(found("\"monte_carlo.design\" = [\"random\", \"sobol\"]\n").empty());
  EXPECT_FALSE(found("\"plan.dwell\" = [\"60 furlong\"]\n").empty());
  // What is wrong with the key is said once, not for each of its values.
  EXPECT_EQ(found("\"monte_carlo.runs\" = [10, 20, 30]\n").size(), 1u);
  EXPECT_EQ(
      found("\"truth.parameters.eta_q\" = [\"1 arcsec\", \"2 arcsec\", \"3 arcsec\"]\n").size(),
      1u);
  EXPECT_EQ(found("\"plan.dwell\" = [\"60 furlong\", \"61 furlong\"]\n").size(), 2u);
}

TEST(Sweep, RefusesAValueThatComesTwice) {
  const auto found = mistakes(
      small_study +
      "[sweep]\n\"truth.parameters.eta\" = [\"20 arcsec\", \"30 arcsec\", \"20 arcsec\"]\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(
      found[0].find("study.toml:26:53: 'sweep.\"truth.parameters.eta\"' has \"20 arcsec\" twice"),
      std::string::npos)
      << found[0];
}

TEST(Sweep, RefusesOneValueInTwoUnits) {
  const auto found = mistakes(small_study + "[sweep]\n\"plan.dwell\" = [\"20 min\", \"1200 s\"]\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("has \"1200 s\" and \"20 min\""), std::string::npos) << found[0];
  EXPECT_TRUE(
      mistakes(small_study + "[sweep]\n\"plan.dwell\" = [\"20 min\", \"2400 s\"]\n").empty());
}

TEST(Sweep, ATableIsLaidOverItsSection) {
  // What it does not name stays: the other noise, the terms of the truth, the other parameters.
  const std::string base = small_study + "[readout]\naccelerometer_noise = \"50 ug\"\n" +
                           "[truth.parameters]\nD_F_y = \"0.25 deg/h\"\neta_x = { uniform = "
                           "[\"0 arcsec\", \"9 arcsec\"] }\n";
  const auto noise = mc::study_points(read_text(
      base +
      "[sweep]\nreadout = [{ gimbal_noise = \"1 arcsec\" }, { gimbal_noise = \"9 arcsec\" }]\n"));
  for (const auto& p : noise) EXPECT_DOUBLE_EQ(p.study.readout.accelerometer_noise, 50e-6);
  EXPECT_DOUBLE_EQ(noise[1].study.readout.gimbal_noise, 9.0 * drift::detail::deg / 3600.0);
  const auto truths = mc::study_points(
      read_text(base + "[sweep]\ntruth = [{ coupling = \"eq5\" }, { coupling = \"eq6\" }]\n"));
  EXPECT_EQ(truths[1].study.truth.coupling, Coupling::eq6);
  EXPECT_EQ(truths[1].study.truth.active, truths[0].study.truth.active);
  EXPECT_EQ(truths[1].study.truth.active, read_text(base).truth.active);
  const auto values =
      mc::study_points(read_text(
          base + "[sweep]\n\"truth.parameters\" = [{ D_F_x = \"1 deg/h\" }, { D_F_x = \"2 deg/h\", "
                 "eta_x = { normal = [\"0 arcsec\", \"5 arcsec\"] } }]\n"));
  for (const auto& p : values)
    EXPECT_EQ(p.study.truth.priors[TermLibrary::index("D_F_y")].kind, Prior::Kind::fixed);
  // A distribution is one value.
  EXPECT_EQ(values[1].study.truth.priors[TermLibrary::index("eta_x")].kind, Prior::Kind::normal);
}

TEST(Sweep, RefusesAKeyThatTwoLinesSet) {
  const auto found = [](const std::string& sweep) {
    return mistakes(small_study + "[sweep]\n" + sweep);
  };
  const std::string noise = "\"readout.gimbal_noise\" = [\"7 arcsec\", \"70 arcsec\"]\n";
  const auto both = found(noise + "readout = [{ gimbal_noise = \"1 arcsec\" }]\n");
  ASSERT_EQ(both.size(), 1u);
  EXPECT_NE(both[0].find("sets readout.gimbal_noise, and so does 'sweep.\"readout.gimbal_noise\"'"),
            std::string::npos)
      << both[0];
  EXPECT_TRUE(found(noise + "readout = [{ accelerometer_noise = \"1 ug\" }]\n").empty());
}

TEST(Sweep, RefusesAKeyThatTwoLinesSetByNameAndByNumber) {
  const auto found = [](const std::string& text, const std::string& sweep) {
    return mistakes(text + "[sweep]\n" + sweep);
  };
  const std::string couplings = " = [\"eq5\", \"eq6\"]\n";
  const auto filters = found(
      small_study, "\"filter.right.coupling\"" + couplings + "\"filter.0.coupling\"" + couplings);
  ASSERT_EQ(filters.size(), 1u);
  EXPECT_NE(filters[0].find("study.toml:27:1: 'sweep.\"filter.0.coupling\"' sets "
                            "filter.0.coupling, and so does 'sweep.\"filter.right.coupling\"'"),
            std::string::npos)
      << filters[0];
  EXPECT_TRUE(found(small_study,
                    "\"filter.right.coupling\"" + couplings + "\"filter.1.coupling\"" + couplings)
                  .empty());
  std::string listed = small_study;
  listed.replace(listed.find("preset = \"six\"\n"), 15, "");
  listed.insert(listed.find("[truth]"),
                "[[plan.position]]\nname = \"up\"\naxes = \"x=N y=W z=U\"\n");
  const std::string dwells = " = [\"10 min\", \"20 min\"]\n";
  EXPECT_EQ(
      found(listed, "\"plan.position.0.dwell\"" + dwells + "\"plan.position.up.dwell\"" + dwells)
          .size(),
      1u);
  EXPECT_EQ(found(small_study,
                  "\"filter.right\" = [{ coupling = \"eq6\" }, { starts = 3 }]\n"
                  "\"filter.0.coupling\"" +
                      couplings)
                .size(),
            1u);
}

TEST(Sweep, KeepsItsOrderWhereTheStudyIsWrittenDown) {
  const std::string text = small_study +
                           "[sweep]\nreadout = [{ gimbal_noise = \"1 arcsec\" }, { gimbal_noise = "
                           "\"9 arcsec\" }]\n\"plan.dwell\" = [\"20 min\", \"40 min\"]\n";
  const mc::Study study = read_text(text);
  const auto points = mc::study_points(study), again = mc::study_points(read_text(study.text));
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k].label, again[k].label);
    EXPECT_EQ(points[k].id, again[k].id);
  }
}

TEST(Sweep, NamesThePointOfValuesThatDoNotGoTogether) {
  // Each alone is right with the base study; together the dwell is no whole number of samples.
  const std::string text = small_study +
                           "[sweep]\n\"plan.dwell\" = [\"10 min\", \"20 min\"]\n\"plan.sample\" = "
                           "[\"2 min\", \"4 min\"]\n";
  try {
    mc::study_points(read_text(text));
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::config);
    EXPECT_NE(error.messages()[0].find("plan.dwell = 10 min, plan.sample = 4 min"),
              std::string::npos)
        << error.messages()[0];
  }
}

TEST(MonteCarloSection, ReadsDesignEstimatorAndStop) {
  EXPECT_EQ(read_text(small_study + "design = \"latin_hypercube\"\n").monte_carlo.design,
            mc::DesignKind::latin_hypercube);
  std::string text = small_study +
                     "healthy_sigma = 0.3\nstop = { quantity = \"rmse.eta_x\", half_width = 0.02, "
                     "confidence = 0.9 }\n";
  const mc::MonteCarlo mc = read_text(text).monte_carlo;
  EXPECT_EQ(mc.design, mc::DesignKind::random);
  EXPECT_EQ(mc.estimator, mc::EstimatorKind::iterated);
  EXPECT_EQ(mc.healthy_sigma, 0.3);
  ASSERT_TRUE(mc.stop);
  EXPECT_EQ(mc.stop->quantity, "rmse.eta_x");
  EXPECT_EQ(mc.stop->half_width, 0.02);
  EXPECT_EQ(mc.stop->confidence, 0.9);
  for (const char* bad :
       {"stop = { quantity = \"rmse.eta_q\" }\n", "stop = { quantity = \"luck\" }\n",
        "stop = { half_width = 0.1 }\n",
        "stop = { quantity = \"silent_failure_rate\", half_width = 0.0 }\n", "design = \"grid\"\n"})
    EXPECT_EQ(mistakes(small_study + bad).size(), 1u) << bad;
}

TEST(MonteCarloSection, AStopRuleMustBeAbleToEnd) {
  const auto found = [](const std::string& lines) { return mistakes(small_study + lines); };
  const auto unknown = found("stop = { quantity = \"rmse.K1_x\" }\n");  // no filter has the term
  ASSERT_EQ(unknown.size(), 1u);
  EXPECT_NE(unknown[0].find("study.toml:25:21: 'monte_carlo.stop.quantity' = \"rmse.K1_x\" waits "
                            "for a parameter that no filter"),
            std::string::npos)
      << unknown[0];
  EXPECT_NE(unknown[0].find("one of D_F_x, D_F_y, D_F_z, D_I_x"), std::string::npos) << unknown[0];
  EXPECT_TRUE(found("stop = { quantity = \"rmse.K0_x\" }\n").empty());
  for (const char* design : {"latin_hypercube", "sobol"}) {
    const auto refused = found(
        fmt::format("design = \"{}\"\nstop = {{ quantity = \"silent_failure_rate\" }}\n", design));
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_NE(refused[0].find(
                  "study.toml:25:10: 'monte_carlo.design' does not go with [monte_carlo.stop]"),
              std::string::npos)
        << refused[0];
  }
}

TEST(MonteCarloSection, WholeNumbersOutOfRangeAreNotToldToLoseTheirQuotes) {
  const auto found = mistakes(small_study + "[sweep]\n\"filter.right.starts\" = [0]\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("(expected a whole number from 1 to 1000). Choose one in that range"),
            std::string::npos)
      << found[0];
}

}  // namespace
}  // namespace drift::sweep_test
