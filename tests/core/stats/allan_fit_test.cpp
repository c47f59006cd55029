#include "core/stats/allan_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/stats/proportion.hpp"
#include "tests/core/stats/allan_series.hpp"

namespace drift::stats::allan_fit_test {
namespace {

using test::AllanTruth, test::made_stretch;

// Dwells of a recording: two long ones, and short ones that only add to short averaging times.
const std::vector<std::size_t> dwells{1500, 1200, 400, 300, 250, 100, 90, 12};

std::vector<AllanFit> fits_of(const AllanTruth& truth, int runs, std::uint64_t seed) {
  const AllanFitter fitter(dwells, 1.0);
  std::vector<AllanFit> all;
  for (int run = 0; run < runs; ++run) {
    Stream random(seed, static_cast<std::uint64_t>(run), Purpose::test);
    std::vector<Stretch> stretches;
    for (const std::size_t length : dwells)
      stretches.push_back(made_stretch(truth, length, random));
    all.push_back(fitter.fit(stretches));
  }
  return all;
}

/// The share of fits of which `holds` is true lies where chance puts one of probability `p`: the
/// interval of 99.9 % reaches it.
void expect_share(const std::vector<AllanFit>& fits, double p, auto&& holds) {
  std::size_t k = 0;
  for (const AllanFit& f : fits) k += holds(f) ? 1 : 0;
  const Proportion share = proportion(k, fits.size(), 0.999);
  EXPECT_LE(share.low, p) << k << " of " << fits.size();
  EXPECT_GE(share.high, p) << k << " of " << fits.size();
}

bool within(const AllanCoefficient& c, double truth) {
  return c.found ? std::abs(c.value - truth) < 1.96 * c.sigma : truth <= c.upper;
}

TEST(AllanFit, SigmasAndIntervalsHoldForWhiteNoiseAlone) {
  const auto fits = fits_of({}, 300, 1);
  expect_share(fits, 0.95, [](const AllanFit& f) { return within(f[AllanNoise::white], 1.0); });
  for (std::size_t i = 0; i < fits.front().points.size(); i += 3)
    expect_share(fits, 0.95, [&](const AllanFit& f) {
      const double truth = 1.0 / std::sqrt(f.points[i].tau);
      return f.points[i].low < truth && truth < f.points[i].high;
    });
  // Of each noise that is not there a hundredth is claimed at most.
  for (const AllanNoise noise : AllanFitter::all_noises) {
    if (noise == AllanNoise::white) continue;
    std::size_t claimed = 0;
    for (const AllanFit& f : fits) claimed += f[noise].found ? 1 : 0;
    EXPECT_LE(proportion(claimed, fits.size(), 0.999).low, allan_significance);
  }
  std::size_t misfits = 0;
  for (const AllanFit& f : fits) misfits += f.fits ? 0 : 1;
  EXPECT_LE(proportion(misfits, fits.size(), 0.999).low, 0.001);
}

TEST(AllanFit, SigmasHoldWhereSeveralNoisesAreClear) {
  const AllanTruth truth{.quantisation = 2.0, .white = 1.0, .rate_walk = 0.1, .ramp = 0.0};
  const auto fits = fits_of(truth, 300, 2);
  expect_share(fits, 0.95,
               [](const AllanFit& f) { return within(f[AllanNoise::quantisation], 2.0); });
  expect_share(fits, 0.95, [](const AllanFit& f) { return within(f[AllanNoise::white], 1.0); });
  expect_share(fits, 0.95, [](const AllanFit& f) { return within(f[AllanNoise::rate_walk], 0.1); });
}

TEST(AllanFit, ARampIsFoundWithItsSigma) {
  const auto fits = fits_of({.white = 1.0, .ramp = 0.003}, 200, 3);
  expect_share(fits, 0.95, [](const AllanFit& f) { return within(f[AllanNoise::ramp], 0.003); });
}

TEST(AllanFit, WhiteNoiseHoldsWhereASlowOneIsOnlySuspectedAndItsKindIsLeftOpen) {
  // At K = 0.03 these dwells show that there is something slow, and often not what.
  const auto fits = fits_of({.white = 1.0, .rate_walk = 0.03}, 300, 4);
  expect_share(fits, 0.95, [](const AllanFit& f) { return within(f[AllanNoise::white], 1.0); });
  std::size_t wrong = 0;
  for (const AllanFit& f : fits)
    for (const AllanNoise noise : {AllanNoise::flicker, AllanNoise::ramp})
      wrong += f[noise].found && f[noise].rivals.empty() ? 1 : 0;
  EXPECT_LE(proportion(wrong, fits.size(), 0.999).low, 2.0 * allan_significance);
}

TEST(AllanFit, UpperLimitsHold) {
  const auto fits = fits_of({.white = 1.0, .rate_walk = 0.004}, 300, 5);
  std::size_t below = 0;
  for (const AllanFit& f : fits) below += within(f[AllanNoise::rate_walk], 0.004) ? 1 : 0;
  EXPECT_GE(proportion(below, fits.size(), 0.999).high, 0.95);
  EXPECT_GT(fits.front()[AllanNoise::rate_walk].upper, 0.004);
  EXPECT_LT(fits.front()[AllanNoise::rate_walk].upper, 0.1);  // and say something
}

TEST(AllanFit, WhatTheFiveNoisesCannotMakeIsAMisfitAndWidensSigmas) {
  const AllanFitter fitter(dwells, 1.0);
  Stream random(6, 0, Purpose::test);
  std::vector<Stretch> plain, shaken;
  for (const std::size_t length : dwells) {
    plain.push_back(made_stretch({}, length, random));
    shaken.push_back(plain.back());
    for (std::size_t k = 0; k < length; ++k)
      shaken.back()[k] += std::sin(0.4 * static_cast<double>(k));  // something vibrates
  }
  const AllanFit a = fitter.fit(plain), b = fitter.fit(shaken);
  EXPECT_TRUE(a.fits);
  EXPECT_FALSE(b.fits);
  EXPECT_GT(b.misfit, 5.0);
}

TEST(AllanFit, UnitsOfTimeAreThoseOfTheInterval) {
  Stream random(7, 0, Purpose::test);
  const std::vector<Stretch> one{
      made_stretch({.quantisation = 2.0, .rate_walk = 0.1}, 2000, random)};
  const std::vector<std::size_t> lengths{2000};
  const AllanFit second = AllanFitter(lengths, 1.0).fit(one),
                 tenth = AllanFitter(lengths, 0.1).fit(one);
  const double root = std::sqrt(0.1);
  EXPECT_NEAR(tenth[AllanNoise::quantisation].value, 0.1 * second[AllanNoise::quantisation].value,
              1e-9);
  EXPECT_NEAR(tenth[AllanNoise::white].value, root * second[AllanNoise::white].value, 1e-9);
  EXPECT_NEAR(tenth[AllanNoise::rate_walk].value, second[AllanNoise::rate_walk].value / root, 1e-9);
  EXPECT_NEAR(tenth.points[3].tau, 0.1 * second.points[3].tau, 1e-12);
}

TEST(AllanFit, ARampThatNoiseHardlyTouchesHasIntervalsAndNoErrorIsThrown) {
  // Of R = 1 beside N the variance of tau samples is R^2 tau^2 / 2, and its estimates differ by
  // about R N tau^1/2 each: 2 f^2 / spread is of the order (R / N)^2, 1e10 and more here.
  for (const double white : {1e-3, 1e-5}) {
    Stream random(11, 0, Purpose::test);
    const AllanFitter fitter(dwells, 1.0);
    std::vector<Stretch> stretches;
    for (const std::size_t length : dwells)
      stretches.push_back(made_stretch({.white = white, .ramp = 1.0}, length, random));
    const AllanFit fit = fitter.fit(stretches);
    for (const AllanPoint& p : fit.points) {
      EXPECT_LE(p.low, p.deviation) << p.tau;
      EXPECT_GE(p.high, p.deviation) << p.tau;
      EXPECT_LT(p.high / p.low, 1.1) << p.tau;
    }
    EXPECT_NEAR(fit[AllanNoise::ramp].value, 1.0, 1e-3);
  }
}

}  // namespace
}  // namespace drift::stats::allan_fit_test
