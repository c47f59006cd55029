#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/strapdown/report.hpp"
#include "analysis/strapdown/identify.hpp"
#include "core/base/check.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown_identify_test {
namespace {

using strapdown::Trial;
using strapdown::Verdict;
using test::set;
using test::strapdown_recording;

/// The seed of a MEMS unit with drift and scale errors, without misalignment.
Theta straight() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"D_F_x", 900},
                                                             {"D_F_y", -2500},
                                                             {"D_F_z", 1400},
                                                             {"s_x", 8000},
                                                             {"s_y", -5000},
                                                             {"s_z", 6000},
                                                             {"K0_x", 9000},
                                                             {"K0_y", -14000},
                                                             {"K1_x", 12000},
                                                             {"K1_y", -7000}})
    set(theta, key, value);
  return theta;
}

Theta tilted() {
  Theta theta = straight();
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"eta_x", 2500},
                                                             {"eta_y", -1800},
                                                             {"eta_z", 900},
                                                             {"xi_x", -1200},
                                                             {"xi_y", 3000},
                                                             {"xi_z", -2200}})
    set(theta, key, value);
  return theta;
}

Theta tilted_with_g_drift() {
  Theta theta = tilted();
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"D_I_x", 160},
                                                             {"D_I_y", -20},
                                                             {"D_I_z", 40},
                                                             {"D_O_x", 300},
                                                             {"D_O_y", -250},
                                                             {"D_O_z", 180},
                                                             {"D_S_x", -220},
                                                             {"D_S_y", 350},
                                                             {"D_S_z", 120}})
    set(theta, key, value);
  return theta;
}

const strapdown::StrapdownParameter* find(const strapdown::StrapdownResult& result,
                                          std::string_view key) {
  const auto at = std::find_if(result.parameters.begin(), result.parameters.end(),
                               [&](const auto& p) { return p.key == key; });
  return at == result.parameters.end() ? nullptr : &*at;
}

TEST(StrapdownIdentify, NamesWhatIsThereAndNothingElse) {
  const Theta truth = tilted_with_g_drift();
  const auto result =
      strapdown::identify_strapdown(strapdown_recording({.dwells = 40, .seed = 3}, truth), {});
  EXPECT_EQ(result.search.dwells.size(), 40u);
  EXPECT_EQ(result.rotations, 39u);
  ASSERT_EQ(result.accepted.size(), 2u);
  EXPECT_EQ(result.accepted[0].name, "bias + scale + misalignment + g-drift");
  for (const auto& p : result.parameters) {
    const std::size_t index = *TermLibrary::find(p.key);
    double expected = truth[index] / TermLibrary::specs[index].unit.to_si;
    if (TermLibrary::specs[index].group.view() == "D_I") expected -= 60.0;  // mean of 160, -20, 40
    EXPECT_LT(std::abs(p.value - expected), 3.6 * p.sigma) << p.key;
  }
  EXPECT_NEAR(
      find(result, "D_I_x")->value + find(result, "D_I_y")->value + find(result, "D_I_z")->value,
      0.0, 1e-9);
}

TEST(StrapdownIdentify, EquationSixFailsOnATiltedSensor) {
  const auto result =
      strapdown::identify_strapdown(strapdown_recording({.dwells = 30}, tilted()), {});
  ASSERT_EQ(result.contest.size(), 1u);
  EXPECT_GT(result.contest[0].z, 5.0);
  EXPECT_GT(result.contest[0].eq6.held_out, 3.0 * result.contest[0].eq5.held_out);
  for (const Trial& t : result.gyro_trials) {
    if (t.equation == "eq6") {
      EXPECT_EQ(t.verdict, Verdict::rejected) << t.name;
    }
  }
}

TEST(StrapdownIdentify, MisalignmentThatIsNotThereIsNotClaimed) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto recording =
        strapdown_recording({.dwells = 20, .rest = 3.5, .seed = seed}, straight());
    const auto result =
        strapdown::identify_strapdown(recording, {.repeats = 2, .equations = {Coupling::eq5}});
    EXPECT_EQ(result.accepted[0].name, "bias + scale") << seed;
    EXPECT_EQ(find(result, "eta_x"), nullptr);
    EXPECT_TRUE(std::any_of(result.unobservable.begin(), result.unobservable.end(),
                            [](const auto& u) { return u.what == "eta, xi"; }));
    EXPECT_TRUE(result.contest.empty());
  }
}

TEST(StrapdownIdentify, SaysWhatItCannotSeeWithoutANumber) {
  const auto result = strapdown::identify_strapdown(
      strapdown_recording({.dwells = 16, .rest = 3.0}, tilted()), {.repeats = 1});
  std::string all;
  for (const auto& u : result.unobservable) all += u.what + "\n";
  for (const char* what : {"isotropic", "Earth rate", "azimuth", "temperature", "lambda"})
    EXPECT_NE(all.find(what), std::string::npos) << what;
  const auto json = report::to_json(result);
  for (const auto& u : json.at("unobservable"))
    for (const auto& [key, value] : u.items()) EXPECT_TRUE(value.is_string()) << key;
}

TEST(StrapdownIdentify, IsTheSameForTheSameSeed) {
  const auto recording = strapdown_recording({.dwells = 16, .rest = 3.0}, tilted());
  const strapdown::StrapdownOptions options{.repeats = 2, .seed = 9};
  const auto one = strapdown::identify_strapdown(recording, options),
             two = strapdown::identify_strapdown(recording, options);
  EXPECT_EQ(report::to_json(one).dump(), report::to_json(two).dump());
  EXPECT_EQ(report::to_text(report::strapdown_report({}, one)),
            report::to_text(report::strapdown_report({}, two)));
  auto other = options;
  other.seed = 10;
  EXPECT_NE(report::to_json(one).dump(),
            report::to_json(strapdown::identify_strapdown(recording, other)).dump());
}

TEST(StrapdownIdentify, TooFewDwellsAreRefused) {
  const auto recording = strapdown_recording({.dwells = 4}, straight());
  try {
    strapdown::identify_strapdown(recording, {});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    EXPECT_NE(e.messages()[0].find("4 dwells"), std::string::npos);
  }
}

TEST(StrapdownIdentify, FewDwellsLeaveLargeModelsUntried) {
  const auto result = strapdown::identify_strapdown(
      strapdown_recording({.dwells = 8, .rest = 3.0}, straight()), {.repeats = 1});
  EXPECT_TRUE(std::any_of(result.accelerometer_trials.begin(), result.accelerometer_trials.end(),
                          [](const Trial& t) { return t.verdict == Verdict::skipped; }));
}

TEST(StrapdownIdentify, OnlyEquationsFiveAndSixApply) {
  const auto recording = strapdown_recording({.dwells = 8}, straight());
  for (const auto& equations : {std::vector<Coupling>{}, std::vector{Coupling::lambda}}) try {
      strapdown::identify_strapdown(recording, {.equations = equations});
      FAIL() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.code(), ExitCode::config);
    }
}

}  // namespace
}  // namespace drift::strapdown_identify_test
