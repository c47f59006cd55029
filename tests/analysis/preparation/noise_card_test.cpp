#include "analysis/preparation/noise_card.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"
#include "core/estimate/strapdown/dwells.hpp"
#include "core/stats/trend.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::noise_card_test {
namespace {

using preparation::ChannelNoise, preparation::NoiseCard, preparation::NoNoise,
    preparation::noise_card, preparation::RestingRows;
using stats::AllanNoise;

void expect_white(const ChannelNoise& c, double sample_sigma, double interval) {
  const stats::AllanCoefficient& n = c.fit[AllanNoise::white];
  ASSERT_TRUE(n.found) << c.channel;
  EXPECT_NEAR(n.value, sample_sigma * std::sqrt(interval), 4.0 * n.sigma) << c.channel;
  EXPECT_LT(n.sigma, 0.1 * n.value) << c.channel;
  EXPECT_TRUE(c.fit.fits) << c.channel << " " << c.fit.misfit;
}

TEST(NoiseCard, OfSensorsOnACaseIsWhatTheDwellsHold) {
  const test::StrapdownScript script{.dwells = 12, .rest = 8.0};
  const Recording r = test::strapdown_recording(script, Theta::Zero());
  const auto search = strapdown::find_dwells(strapdown::signals_of(r), {});
  std::vector<RestingRows> rests;
  for (const auto& d : search.dwells) rests.push_back({d.first, d.last});
  const NoiseCard card = noise_card(r, RecordingKind::strapdown, rests);
  ASSERT_EQ(card.missing, NoNoise::there_is_one);
  ASSERT_EQ(card.channels.size(), 6u);
  EXPECT_EQ(card.stretches, search.dwells.size());
  EXPECT_NEAR(card.interval, script.interval, 1e-9);
  for (const ChannelNoise& c : card.channels) {
    expect_white(c, c.channel.starts_with("gyro") ? script.gyro_noise : script.acc_noise,
                 script.interval);
    EXPECT_GT(c.quietest, 0.0);
    EXPECT_LT(c.noisiest, 1.3 * c.quietest) << c.channel;  // all dwells are alike
    EXPECT_FALSE(c.spectrum.frequency.empty());
  }
}

/// Three positions of 150 rows: Earth rate turns the platform in each, and in slews between.
Recording platform(double noise) {
  const double rate = 7.292115e-5, sample = 30.0;  // [rad/s], [s]
  Recording r;
  r.source = "made";
  for (const char* name : {"time", "position", "phase", "acc_x", "acc_y", "acc_z"})
    r.channels.push_back({name,
                          name[0] == 'a'   ? unit::g
                          : name[0] == 't' ? unit::s
                                           : unit::one,
                          {}});
  Stream random(1, 0, Purpose::test);
  double t = 0.0;
  for (int position = 1; position <= 3; ++position)
    for (int k = 0; k < 160; ++k) {
      t += sample;
      const double turned = rate * sample * k, row[] = {t,
                                                        static_cast<double>(position),
                                                        k < 10 ? 1.0 : 0.0,
                                                        std::sin(turned + position),
                                                        std::cos(turned + position),
                                                        0.5 * std::cos(turned)};
      for (std::size_t c = 0; c < 6; ++c)
        r.channels[c].values.push_back(row[c] + (c >= 3 ? noise * random.normal() : 0.0));
    }
  return r;
}

TEST(NoiseCard, OfAPlatformIsWhatIsLeftWhenTheCourseOfEachDwellIsTakenOff) {
  const Recording r = platform(5e-6);
  const auto rests = preparation::resting_rows(r);
  ASSERT_EQ(rests.size(), 3u);
  EXPECT_EQ(rests[1].first, 170u);
  EXPECT_EQ(rests[1].last, 319u);
  const NoiseCard card = noise_card(r, RecordingKind::platform, rests);
  ASSERT_EQ(card.channels.size(), 3u);
  for (const ChannelNoise& c : card.channels) {
    expect_white(c, 5e-6, 30.0);
    EXPECT_LE(c.fit.points.back().tau, 150 * 30.0 / 20.0);
  }
}

TEST(NoiseCard, IsolatedSamplesAreNoNoise) {
  Recording r = platform(5e-6);
  const auto rests = preparation::resting_rows(r);
  r.channels[3].values[50] = 9.9;                                     // a cell in another unit
  for (const int k : {200, 201, 260}) r.channels[4].values[k] = 0.0;  // dropouts, two in a row
  const NoiseCard card = noise_card(r, RecordingKind::platform, rests);
  ASSERT_EQ(card.channels.size(), 3u);
  for (const ChannelNoise& c : card.channels) expect_white(c, 5e-6, 30.0);
  EXPECT_EQ(card.channels[0].isolated, 1u);
  EXPECT_EQ(card.channels[1].isolated, 3u);
  EXPECT_EQ(card.channels[2].isolated, 0u);
}

TEST(NoiseCard, OfGaussianNoiseNoSampleIsIsolatedMoreOftenThanStated) {
  // One channel in a thousand loses a sample; more than five of 600 have a chance of 5e-5.
  std::size_t touched = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    Stream random(seed, 0, Purpose::test);
    std::vector<stats::Stretch> dwells(12, stats::Stretch(40));
    for (stats::Stretch& dwell : dwells)
      for (double& x : dwell) x = random.normal();
    touched += stats::without_trend_and_isolated(std::move(dwells), 4, 1e-3).isolated > 0;
  }
  EXPECT_LE(touched, 5u);
}

TEST(NoiseCard, OfNoiseWithLongTailsTheFarEndsGoInAFewTurns) {
  // 200,000 samples of which every hundredth is drawn ten times as wide: a fit for every one of
  // them would take hours.
  std::vector<stats::Stretch> dwells(4, stats::Stretch(50'000));
  Stream random(3, 0, Purpose::test);
  std::size_t wide = 0;
  for (stats::Stretch& dwell : dwells)
    for (std::size_t k = 0; k < dwell.size(); ++k) {
      dwell[k] = (k % 100 == 0 ? 10.0 : 1.0) * random.normal();
      wide += std::abs(dwell[k]) > 7.0;
    }
  const auto rests = stats::without_trend_and_isolated(std::move(dwells), 4, 1e-3);
  EXPECT_GE(rests.isolated, wide);  // all beyond seven sigma, and some nearer
  EXPECT_LE(rests.isolated, 2000u);
}

TEST(NoiseCard, AGapEndsAStretchAndUnequalRowsAreRefused) {
  Recording r = platform(5e-6);
  const auto rests = preparation::resting_rows(r);
  for (std::size_t k = 240; k < r.rows(); ++k) r.channels[0].values[k] += 3600.0;
  EXPECT_EQ(noise_card(r, RecordingKind::platform, rests).stretches, 4u);
  r.channels[3].values[50] = std::nan("");  // not measured: two stretches of this channel
  EXPECT_EQ(noise_card(r, RecordingKind::platform, rests).channels.size(), 3u);

  Recording shaken = platform(5e-6);
  Stream random(2, 0, Purpose::test);
  for (double& t : shaken.channels[0].values) t += 20.0 * (random.uniform() - 0.5);
  const NoiseCard none = noise_card(shaken, RecordingKind::platform, rests);
  EXPECT_EQ(none.missing, NoNoise::unequal_rows);
  EXPECT_TRUE(none.channels.empty());
}

TEST(NoiseCard, RestsOfAnotherIntervalAreLeftOut) {
  // Rests of 150 rows every 25, 30 and 30 s: together they had one of 28.3 s, which none has.
  Recording r = platform(5e-6);
  std::vector<double>& time = r.channels[0].values;
  for (std::size_t k = 0; k < 160; ++k) time[k] += 5.0 * static_cast<double>(159 - k);
  const auto rests = preparation::resting_rows(r);
  const NoiseCard card = noise_card(r, RecordingKind::platform, rests);
  EXPECT_NEAR(card.interval, 30.0, 1e-9);
  EXPECT_EQ(card.stretches, 2u);
  EXPECT_NEAR(card.total, 300 * 30.0, 1e-6);
  EXPECT_EQ(card.other_spacing, 150u);
  EXPECT_EQ(card.left_out, 150u);
  ASSERT_EQ(card.channels.size(), 3u);
  for (const ChannelNoise& c : card.channels) expect_white(c, 5e-6, 30.0);
  // Rows every 20 s beside those every 30 and 60 s are even in their rests.
  for (std::size_t k = 0; k < 160; ++k) time[k] = 4800.0 - 20.0 * static_cast<double>(159 - k);
  for (std::size_t k = 320; k < 480; ++k) time[k] += 30.0 * static_cast<double>(k - 320);
  EXPECT_EQ(noise_card(r, RecordingKind::platform, rests).missing, NoNoise::there_is_one);
}

TEST(NoiseCard, MissingRowsAndSamplesDoNotAddToTheScatter) {
  const auto scatter = [](const Recording& r) {
    return preparation::scatter_at_rest(r, preparation::resting_rows(r), accelerometer_channels);
  };
  const Recording all = platform(5e-6);
  // Of nine variances, each known to sqrt(2/145) = 12 %, the median is known to 5 %: of sigma four
  // times half of that.
  EXPECT_NEAR(scatter(all), 5e-6, 0.1 * 5e-6);
  Recording rows = all, samples = all;
  for (std::size_t k = all.rows(); k-- > 0;) {
    const std::size_t of_rest = k % 160;
    if (of_rest != 30 && of_rest != 31 && of_rest != 70 && of_rest != 110 && of_rest != 140)
      continue;
    for (std::size_t c = 0; c < 6; ++c) {
      if (c >= 3) samples.channels[c].values[k] = std::nan("");
      auto& values = rows.channels[c].values;
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  // Five squares fewer of 145 move a variance by sqrt(2 * 5) / 145 = 2.2 %, of nine none by four
  // times that, and sigma by half. (Earth rate moves what is read by 400 sigma from row to row.)
  EXPECT_NEAR(scatter(rows), scatter(all), 0.05 * scatter(all));
  EXPECT_DOUBLE_EQ(scatter(samples), scatter(rows));
}

TEST(NoiseCard, AStuckChannelAndRestsTooShortHaveNone) {
  Recording r = platform(5e-6);
  for (double& v : r.channels[3].values) v = 0.25;
  const auto rests = preparation::resting_rows(r);
  // What the polynomial leaves of a constant is rounding, not noise.
  const NoiseCard card = noise_card(r, RecordingKind::platform, rests);
  for (const ChannelNoise& c : card.channels)
    EXPECT_TRUE(c.channel != "acc_x" || c.fit[AllanNoise::white].value < 1e-12) << c.channel;
  EXPECT_EQ(noise_card(r, RecordingKind::platform, {{10, 20}}).missing, NoNoise::too_short);
  EXPECT_EQ(noise_card(r, RecordingKind::platform, {}).missing, NoNoise::too_short);
}

}  // namespace
}  // namespace drift::noise_card_test
