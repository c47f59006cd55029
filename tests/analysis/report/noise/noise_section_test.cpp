#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/noise/limits.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/noise/noise_units.hpp"
#include "tests/analysis/report/xml_check.hpp"
#include "tests/core/stats/allan_series.hpp"

namespace drift::noise_section_test {
namespace {

using preparation::ChannelNoise, preparation::NoiseCard, preparation::NoNoise;
using stats::AllanNoise;

constexpr double deg = 3.14159265358979323846 / 180.0, hour = 3600.0;  // [rad], [s]

/// A gyro of 0.5 deg/sqrt(h) and 200 deg/h/sqrt(h), an accelerometer of 50 ug/sqrt(Hz), at 10 Hz.
NoiseCard card_of(double rate_walk = 200.0) {
  NoiseCard card;
  card.missing = NoNoise::there_is_one;
  card.kind = RecordingKind::strapdown;
  card.interval = 0.1;
  card.stretches = 1;
  card.longest = card.total = 2000.0;
  Stream random(1, 0, Purpose::test);
  const std::vector<std::size_t> lengths{20000};
  const stats::AllanFitter fitter(lengths, card.interval);
  const double root = std::sqrt(card.interval);
  const auto add = [&](const char* name, const test::AllanTruth& per_sample) {
    const std::vector<stats::Stretch> one{test::made_stretch(per_sample, lengths[0], random)};
    card.channels.push_back({name, fitter.fit(one), stats::welch(one, card.interval)});
  };
  add("gyro_x", {.white = 0.5 * deg / std::sqrt(hour) / root,
                 .rate_walk = rate_walk * deg / hour / std::sqrt(hour) * root});
  add("acc_x", {.white = 50e-6 / root});
  return card;
}

double value_of(const nlohmann::json& channel, const char* key) {
  for (const auto& c : channel["coefficients"])
    if (c["key"] == key && c["found"]) return c["value"];
  return 0.0;
}

TEST(NoiseSection, NumbersStandInTheUnitsOfTheField) {
  const auto json = report::to_json(card_of(), 9.80665);
  const auto &gyro = json["channels"][0], &acc = json["channels"][1];
  EXPECT_NEAR(value_of(gyro, "N"), 0.5, 0.02);
  EXPECT_NEAR(value_of(gyro, "K"), 200.0, 40.0);
  EXPECT_NEAR(value_of(acc, "N"), 50.0, 2.0);
  EXPECT_EQ(value_of(acc, "K"), 0.0);
  EXPECT_EQ(gyro["unit"], "deg/h");
  // White: N / sqrt(tau), 0.5 deg/sqrt(h) over 0.1 s.
  EXPECT_NEAR(gyro["allan"][0]["deviation"].get<double>(), 0.5 * std::sqrt(hour / 0.1), 6.0);
  const std::string text = report::text_of({report::noise_section(card_of(), 9.80665)});
  EXPECT_NE(text.find("N [deg/sqrt(h)]"), std::string::npos) << text;
  EXPECT_NE(text.find("N [m/s/sqrt(h)]"), std::string::npos) << text;
  EXPECT_NE(text.find("<"), std::string::npos) << text;  // an upper limit
}

/// At the limit of a fit that knows nothing of it a slow noise would tower over all that was
/// measured: no part is more than the sum.
TEST(NoiseSection, NoLimitIsAboveAllThatWasMeasured) {
  NoiseCard card = card_of();
  stats::AllanFit& fit = card.channels[1].fit;
  stats::AllanCoefficient& slow = fit.coefficients[static_cast<std::size_t>(AllanNoise::rate_walk)];
  ASSERT_FALSE(slow.found);
  slow.upper = 1e10;
  const double limit = report::limit_of(fit, AllanNoise::rate_walk);
  double closest = 1e10;  // how near it comes to what was measured
  for (const stats::AllanPoint& p : fit.points) {
    EXPECT_LE(limit * std::sqrt(p.tau / 3.0), p.high * (1.0 + 1e-12));
    closest = std::min(closest, p.high / (limit * std::sqrt(p.tau / 3.0)));
  }
  EXPECT_NEAR(closest, 1.0, 1e-12);
  const auto json = report::to_json(card, 9.80665);
  const double size = report::noise_units(report::Sensor::accelerometer, 9.80665)[3].size;
  EXPECT_NEAR(json["channels"][1]["coefficients"][3]["upper_95"].get<double>() * size, limit,
              1e-9 * limit);
  const std::string text = report::text_of({report::noise_section(card, 9.80665)});
  EXPECT_NE(text.find("all noises together show"), std::string::npos) << text;
  slow.upper = 0.5 * limit;  // a fit that knows more
  EXPECT_EQ(report::limit_of(fit, AllanNoise::rate_walk), 0.5 * limit);
}

TEST(NoiseSection, ThePictureIsWellFormedWithPointsFitsAndSpectra) {
  const std::string svg = report::allan_picture(card_of());
  EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
  for (const char* words : {"Gyros: Allan deviation", "Accelerometers: Allan deviation",
                            "Spectral density", "averaging time [s]", "[ug/sqrt(Hz)]"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos);  // the parts of the gyro's fit
}

TEST(NoiseSection, OnlyWhatIsSureIsToBePasted) {
  const std::string sure = report::noise_keys(card_of());
  EXPECT_NE(sure.find("[readout]\naccelerometer_noise = \"15"), std::string::npos) << sure;
  EXPECT_NE(sure.find("angle_random_walk = \"0."), std::string::npos) << sure;
  EXPECT_NE(sure.find("drift_random_walk"), std::string::npos) << sure;
  const std::string white = report::noise_keys(card_of(0.0));
  EXPECT_EQ(white.find("drift_random_walk"), std::string::npos) << white;
  NoiseCard open = card_of();
  open.channels[0].fit.coefficients[static_cast<std::size_t>(AllanNoise::rate_walk)].rivals = {
      AllanNoise::flicker};
  EXPECT_EQ(report::noise_keys(open).find("drift_random_walk"), std::string::npos);
  EXPECT_NE(report::text_of({report::noise_section(open, 9.8)}).find(" or B"), std::string::npos);
  EXPECT_EQ(report::noise_keys({}), "");
}

TEST(NoiseSection, RowsOfAnotherIntervalAreSaidToBeLeftOut) {
  NoiseCard card = card_of();
  const auto words = [&] { return report::text_of({report::noise_section(card, 9.8)}); };
  EXPECT_EQ(words().find("another interval"), std::string::npos);
  card.other_spacing = 96;
  EXPECT_NE(words().find("96 rows at rest with another interval are left out"), std::string::npos)
      << words();
  EXPECT_EQ(report::to_json(card, 9.8)["rows_of_other_intervals"], 96);
}

TEST(NoiseSection, WithoutACardTheReasonIsSaid) {
  NoiseCard none;
  none.missing = NoNoise::unequal_rows;
  EXPECT_NE(report::text_of({report::noise_section(none, 9.8)}).find("unequal distances"),
            std::string::npos);
  EXPECT_TRUE(report::to_json(none, 9.8).is_null());
}

}  // namespace
}  // namespace drift::noise_section_test
