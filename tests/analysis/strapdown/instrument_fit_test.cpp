// Chi-square of each instrument: as large as its degrees of freedom, and larger where one of them
// has more noise than is seen within dwells.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::instrument_fit_test {
namespace {

constexpr int dwells = 30;

mc::Study study() {
  return mc::read_study_text(test::strapdown_study("45 deg", "9.8 m/s^2"), "study.toml");
}

Recording made(std::uint64_t seed) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  return test::strapdown_recording(
      {.dwells = dwells, .rest = 4.0, .gyro_noise = 1e-4, .seed = seed}, theta);
}

/// Scale factors of all accelerometers that are +-part, from dwell to dwell; they change in turns.
Recording unsteady(Recording r, double part) {
  constexpr std::size_t period = 650, rest = 400, half_a_turn = 125;
  for (Channel& c : r.channels)
    if (c.name.starts_with("acc_"))
      for (std::size_t k = 0; k < c.values.size(); ++k) {
        const std::size_t dwell = (k + period - rest - half_a_turn) / period;
        c.values[k] *= 1.0 + (dwell % 2 == 0 ? part : -part);
      }
  return r;
}

CaseIdentification identified(const Recording& r) {
  const mc::Study s = study();
  return identify_case(s, case_study(s, r));
}

const InstrumentFit* of(const CaseIdentification& id, Instrument which) {
  for (const InstrumentFit& fit : id.fits.front().instruments)
    if (fit.of == which) return &fit;
  return nullptr;
}

TEST(InstrumentFit, OfAUnitAsItIsModelledNoneIsLargerThanNoiseMakesIt) {
  double chi2[2] = {0.0, 0.0}, dof[2] = {0.0, 0.0};
  for (const std::uint64_t seed : {11, 12, 13, 14}) {
    const CaseIdentification id = identified(made(seed));
    int k = 0;
    for (const Instrument which : {Instrument::gravity, Instrument::direction}) {
      const InstrumentFit* fit = of(id, which);
      ASSERT_NE(fit, nullptr);
      chi2[k] += fit->chi2;
      dof[k++] += fit->dof;
    }
    // Of 30 dwells gravity has nine parameters of the accelerometers at most; turns tell of them.
    EXPECT_GT(of(id, Instrument::gravity)->dof, dwells - 9.0);
    EXPECT_LT(of(id, Instrument::gravity)->dof, dwells - 6.0);
    EXPECT_EQ(of(id, Instrument::read_in_turn), nullptr);
  }
  const double room[] = {4.5 * std::sqrt(2.0 / dof[0]), 4.5 * std::sqrt(2.0 / dof[1])};  // 7e-6
  EXPECT_NEAR(chi2[0] / dof[0], 1.0, room[0]) << dof[0];
  // The noise of turns is an upper bound where nobody knows North.
  EXPECT_LT(chi2[1] / dof[1], 1.0 + room[1]) << dof[1];
}

TEST(InstrumentFit, NoiseThatShowsFromDwellToDwellAloneIsSaidOfTheAccelerometers) {
  // Half a dwell has 200 samples of 1.5 mg: 106 ug. A dwell's mean has 75 ug of that, and 110 ug:
  // 3.15 times the variance.
  const CaseIdentification id = identified(unsteady(made(11), 1.1e-4));
  const InstrumentFit* gravity = of(id, Instrument::gravity);
  ASSERT_NE(gravity, nullptr);
  EXPECT_GT(gravity->per_dof(), 2.0);
  EXPECT_LT(gravity->per_dof(), 4.5);
  EXPECT_TRUE(too_large(*gravity, id.fits.front().instruments));
  EXPECT_GT(of(id, Instrument::direction)->chance(), 1e-4);
  const report::Report said = report::case_report(study(), id);
  EXPECT_NE(fmt::format("{}", fmt::join(said.brief.more.texts(), "\n"))
                .find("Sigmas: gravity in dwells scatters more than noise"),
            std::string::npos)
      << fmt::format("{}", fmt::join(said.brief.more.texts(), "\n"));
  const auto json = nlohmann::json::parse(said.document.second);
  const auto& instruments = json["filters"][0]["instruments"];
  ASSERT_GE(instruments.size(), 2u);
  EXPECT_EQ(instruments[0]["instrument"], "gravity in dwells");
  EXPECT_TRUE(instruments[0]["too_large"].get<bool>());
  EXPECT_NEAR(instruments[0]["sigmas_too_small_by"].get<double>(), std::sqrt(gravity->per_dof()),
              1e-12);
}

TEST(InstrumentFit, OneOfTwentyIsSharedOutAmongThem) {
  // Of 20 degrees 31.4 is passed by 0.05, 37.6 by 0.01.
  const InstrumentFit one{Instrument::gravity, 33.0, 20.0};
  EXPECT_TRUE(too_large(one, {one}));
  EXPECT_FALSE(too_large(one, {one, one, one}));
  EXPECT_TRUE(too_large({Instrument::gravity, 37.6, 20.0}, {one, one, one}));
}

}  // namespace
}  // namespace drift::strapdown::instrument_fit_test
