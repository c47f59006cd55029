// What a recording on a case lacks in a model of bias and scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "core/base/check.hpp"
#include "tests/analysis/report/xml_check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::consumer_diagnose_test {
namespace {

using diagnosis::Diagnosis;
using search::Cause;

mc::Study nominal() {
  return mc::read_study(std::string(DRIFT_SOURCE_DIR) + "/configs/diagnose_xsens.toml");
}

const Cause* cause(const Diagnosis& d, std::string_view term) {
  const auto at = std::ranges::find(d.causes, term, &Cause::term);
  return at == d.causes.end() ? nullptr : &*at;
}

/// A case with fixed drift and scale, and misalignment of some size [arcsec].
Recording made(double size, std::uint64_t seed) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  test::set(theta, "s_x", 4000.0);
  test::set(theta, "eta_x", size);
  test::set(theta, "xi_y", -size);
  test::set(theta, "eta_z", 0.7 * size);
  return test::strapdown_recording({.dwells = 20, .rest = 4.0, .seed = seed}, theta);
}

Diagnosis diagnosed(const mc::Study& study, const Recording& recording) {
  return diagnose_case(study, identify_case(study, case_study(study, recording)));
}

/// The rows in which a gyro of a recording is not what it was, of all [first, end).
Recording with_gyro(Recording r, std::size_t first, std::size_t end, double value) {
  const auto gyro = std::ranges::find(r.channels, "gyro_x", &Channel::name);
  for (std::size_t k = first; k < end; ++k) gyro->values[k] = value;
  return r;
}

TEST(ConsumerDiagnose, AGyroThatStandsStillInATurnIsLeftOutAsIfItWereMissing) {
  const Recording whole = made(0.0, 7);
  // A rest of 4 s at 100 Hz, then a turn: half a second in the middle of the second one.
  const std::size_t first = 400 + 250 + 400 + 100, end = first + 50;
  const double there = whole.find("gyro_x")->values[first];
  const CaseIdentification stuck = identify_case(nominal(), with_gyro(whole, first, end, there)),
                           missing =
                               identify_case(nominal(), with_gyro(whole, first, end, nan_value));
  const std::vector<std::string> of_stuck = stuck.study.all_remarks(),
                                 of_missing = missing.study.all_remarks();
  ASSERT_EQ(of_stuck.size(), 2u);  // and that the turn is left out
  EXPECT_NE(of_stuck[0].find(" stands still for 50 samples"), std::string::npos);
  ASSERT_EQ(of_missing.size(), 1u);
  EXPECT_EQ(of_missing[0], of_stuck[1]);
  EXPECT_EQ(stuck.fits.front().fit.estimate.statistic, missing.fits.front().fit.estimate.statistic);
  EXPECT_LT(stuck.fits.front().fit.estimate.statistic_per_dof(), 1.5);
}

TEST(ConsumerDiagnose, RecoversTheMisalignmentThatTheRecordingWasMadeWithAndWritesItDown) {
  const Diagnosis d = diagnosed(nominal(), made(3000.0, 5));
  EXPECT_EQ(d.verdict, diagnosis::Verdict::named) << report::sentence(d);
  const Cause* c = cause(d, "gyro_misalignment");
  ASSERT_NE(c, nullptr) << report::sentence(d);
  EXPECT_EQ(d.causes.size(), 1u) << report::sentence(d);
  for (const auto& p : c->parameters) {
    const double truth = p.key == "eta_x"   ? 3000.0
                         : p.key == "xi_y"  ? -3000.0
                         : p.key == "eta_z" ? 2100.0
                                            : 0.0;
    EXPECT_NEAR(p.value, truth, 4.0 * p.sigma) << p.key;
  }
  // A family and its members are one thing, no twins.
  for (const search::Confusable& like : c->confusable_with) EXPECT_NE(like.term, c->term);
  for (const diagnosis::Twins& twins : d.inseparable) EXPECT_NE(twins.one.term, twins.other.term);
  double total = 0.0;
  for (const auto& s : d.where.channels) total += s.share;
  EXPECT_NEAR(total, 1.0, 1e-12);
  ASSERT_EQ(d.errors.size(), 3u);
  EXPECT_LT(d.errors[1].after, 0.5 * d.errors[1].before);
  // Words of sensors on a case.
  std::string words = report::sentence(d);
  for (const auto& r : d.remarks) words += report::in_words(r) + "\n";
  for (const char* of_a_platform : {"gimbal", "torqu", "platform axis", "held-out positions"})
    EXPECT_EQ(words.find(of_a_platform), std::string::npos) << of_a_platform << "\n" << words;
  for (const char* what : {"isotropic g-sensitivity", "Earth rate", "temperature", "azimuth"})
    EXPECT_NE(words.find(what), std::string::npos) << what;

  const test::ScratchFolder folder;
  report::write_results(nominal(), d, {{"made"}, ""}, folder.file("out"));
  const mc::Study again = mc::read_study(folder.file("out") + "/patched.toml");
  EXPECT_EQ(again.filters.front().active, d.patched.active);
  EXPECT_TRUE(again.filters.front().active[TermLibrary::index("eta_x")]);
  EXPECT_EQ(again.kind, RecordingKind::strapdown);
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_EQ(json["causes"][0]["term"], "gyro_misalignment");
  EXPECT_TRUE(json["fit"]["in_sample"]["chi2_per_dof_before"].is_number());
  EXPECT_EQ(test::xml_problem(test::text_of(folder.file("out") + "/report.html"), {"meta"}),
            std::nullopt);
  // A nominal model that holds this is consistent with the recording.
  EXPECT_EQ(diagnosed(again, made(3000.0, 5)).verdict, diagnosis::Verdict::consistent);
}

TEST(ConsumerDiagnose, NothingMissingIsConsistentAndANominalEq6IsFoundOut) {
  EXPECT_EQ(diagnosed(nominal(), made(0.0, 6)).verdict, diagnosis::Verdict::consistent);
  mc::Study six = nominal();
  for (const char* group : {"eta", "xi"})
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
      if (TermLibrary::specs[p].group.view() == group) {
        six.filters.front().active.set(p);
        six.filters.front().priors[p] = TermLibrary::specs[p].prior_si();
      }
  six.filters.front().coupling = Coupling::eq6;
  const Diagnosis d = diagnosed(six, made(3000.0, 5));
  ASSERT_NE(cause(d, "frame_closure"), nullptr) << report::sentence(d);
  EXPECT_TRUE(cause(d, "frame_closure")->parameters.empty());
  EXPECT_EQ(d.patched.coupling, Coupling::eq5);
}

}  // namespace
}  // namespace drift::strapdown::consumer_diagnose_test
