// Effects of thirty prior sigmas: named, alone, with the size that they have.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "core/physics/term_library.hpp"
#include "tests/support/program.hpp"

namespace drift::far_beyond_prior_test {
namespace {

using namespace drift::test;

struct Case {
  const char* term;
  const char* parameter;
};

class FarBeyondPrior : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Diagnose, FarBeyondPrior,
                         ::testing::Values(Case{"cubic_g_drift", "D_III_z"},
                                           Case{"accelerometer_cross", "K_io_x"},
                                           Case{"sag", "C_sag_x"},
                                           Case{"encoder_harmonics", "enc_s1_middle"},
                                           Case{"gimbal_zero", "enc_zero_middle"}),
                         [](const auto& one) { return std::string(one.param.term); });

TEST_P(FarBeyondPrior, IsNamedWithItsSize) {
  const auto [term, parameter] = GetParam();
  const ScratchFolder folder;
  const std::string terms =
      "\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", \"torquer_scale\", "
      "\"accelerometer\"";
  const TermInfo& info = TermLibrary::terms[*TermLibrary::find_term(term)];
  std::string truth;
  double size = 0.0;
  for (std::size_t i = info.first; i < info.first + info.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    if (spec.kind != ParamKind::linear) continue;
    const bool this_one = spec.key.view() == parameter;
    if (this_one) size = 30.0 * spec.prior.sigma();
    truth += fmt::format("{} = \"{} {}\"\n", spec.key.view(), this_one ? size : 0.0,
                         spec.unit.symbol.view());
  }
  const std::string study = folder.write(
      "lab.toml",
      "schema = 1\n[site]\nlatitude = \"48.1 deg\"\n[plan]\npreset = \"twelve\"\nmode = \"free\"\n"
      "dwell = \"60 min\"\nsample = \"120 s\"\n[truth]\ncoupling = \"eq5\"\nterms = [" +
          terms + ", \"" + term + "\"]\n[truth.parameters]\n" + truth +
          "[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\nterms = [" + terms +
          "]\n[monte_carlo]\nseed = 31\n");
  const std::string recording = folder.file("r.csv"), out = folder.file("out");
  const Answer made = driftscope("simulate " + study + " -o " + recording);
  ASSERT_EQ(made.code, 0) << made.err;
  const Answer a =
      driftscope("diagnose " + study + " " + recording + " -o " + out + " --progress none");
  ASSERT_EQ(a.code, 0) << a.err;
  const auto json = nlohmann::json::parse(text_of(out + "/diagnosis.json"));
  EXPECT_EQ(json["verdict"], "named") << a.out;
  ASSERT_EQ(json["causes"].size(), 1u) << a.out;
  EXPECT_EQ(json["causes"][0]["term"], term) << a.out;
  for (const auto& p : json["causes"][0]["parameters"]) {
    EXPECT_NE(p["key"], "enc_n") << "nothing to a harmonic of the first order";
    if (p["key"] != parameter) continue;
    const double value = p["value"], sigma = p["sigma"];
    EXPECT_LT(std::abs(value - size), 3.0 * sigma) << a.out;
    // The refits believe what the fit believes: the interval is about the value (a skew of a
    // sigma).
    EXPECT_NEAR(p["interval_95"][0].get<double>(), value - 2.0 * sigma, sigma) << a.out;
    EXPECT_NEAR(p["interval_95"][1].get<double>(), value + 2.0 * sigma, sigma) << a.out;
  }
}

}  // namespace
}  // namespace drift::far_beyond_prior_test
