#include "core/config/nearest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/physics/parameters_config.hpp"
#include "tests/core/config/typos.hpp"

namespace drift::config::nearest_test {
namespace {

TEST(Nearest, DistanceCountsSlipsOfTheKeyboard) {
  EXPECT_DOUBLE_EQ(typing_distance("dwell", "dwell"), 0.0);
  EXPECT_DOUBLE_EQ(typing_distance("dwel", "dwell"), 1.0);    // a letter left out
  EXPECT_DOUBLE_EQ(typing_distance("dewll", "dwell"), 1.0);   // two swapped
  EXPECT_DOUBLE_EQ(typing_distance("dwelll", "dwell"), 0.8);  // one doubled
  EXPECT_DOUBLE_EQ(typing_distance("dwrll", "dwell"), 0.9);   // r is next to e
  EXPECT_DOUBLE_EQ(typing_distance("dwpll", "dwell"), 1.0);   // p is not
  EXPECT_DOUBLE_EQ(typing_distance("DWell", "dwell"), 0.5);   // two of the wrong case
  EXPECT_DOUBLE_EQ(typing_distance("", "dwell"), 5.0);
}

TEST(Nearest, WhatIsNothingLikeAnyKeyGetsNoSuggestion) {
  const std::vector<std::string_view> keys = {"runs", "seed", "allowed_failures"};
  EXPECT_TRUE(nearest("zzzzzz", keys).empty());
  EXPECT_TRUE(nearest(std::string(100000, 'r'), keys).empty());
  EXPECT_EQ(suggestion("zzzzzz", keys, "Give up"), "Give up");
  EXPECT_EQ(suggestion("sead", keys), "Did you mean 'seed'?");
}

TEST(Nearest, KeysThatAreEquallyCloseAreAllNamed) {
  const std::vector<std::string_view> keys = {"D_I_x", "D_I_y", "D_I_z", "eta_x"};
  EXPECT_EQ(nearest("D_I_", keys), (std::vector<std::string_view>{"D_I_x", "D_I_y", "D_I_z"}));
  EXPECT_EQ(suggestion("D_I_", keys), "Did you mean 'D_I_x' or 'D_I_y' or 'D_I_z'?");
}

TEST(Nearest, AFurtherWordOrANumberIsNoSlip) {
  const std::pair<const char*, const char*> slips[] = {{"temprature", "temperature"},
                                                       {"tempreatrue", "temperature"},
                                                       {"Temperature", "temperature"},
                                                       {"temperature_rtae", "temperature_rate"},
                                                       {"gimball_otter", "gimbal_outer"},
                                                       {"f_w", "f_x"},
                                                       {"tt", "t"},
                                                       {"T", "t"}};
  for (const auto& [typed, meant] : slips) EXPECT_TRUE(is_slip(typed, meant)) << typed;
  const std::pair<const char*, const char*> others[] = {{"temperature_raw", "temperature_rate"},
                                                        {"temperature_raw", "temperature"},
                                                        {"oil_temperature", "temperature"},
                                                        {"temperature_2", "temperature"},
                                                        {"temperature2", "temperature"},
                                                        {"oil_2", "oil_1"},
                                                        {"t1", "t"},
                                                        {"B", "A"},
                                                        {"AB", "A"},
                                                        {"oil", "pi"}};
  for (const auto& [typed, meant] : others) EXPECT_FALSE(is_slip(typed, meant)) << typed;
}

/// Every slip of every kind at every place of every parameter key. Some leave nothing to tell by
/// ("D__x" may be D_F_x, D_I_x, D_O_x, D_S_x): where the plain edit distance, computed by another
/// program, has another key as close, the suggestion cannot know; everywhere else it shall.
TEST(Nearest, MisspeltParametersAreRecognised) {
  const auto keys = parameter_keys();
  int all = 0, right = 0, decidable = 0, decided = 0;
  for (const auto key : keys)
    for (const auto& typo : test::typos(std::string(key))) {
      if (std::find(keys.begin(), keys.end(), typo) != keys.end()) continue;  // no mistake to see
      const auto best = nearest(typo, keys);
      const bool hit = !best.empty() && best.front() == key;
      ++all;
      right += hit;
      const int own = test::edit_distance(typo, std::string(key));
      const bool clear = std::all_of(keys.begin(), keys.end(), [&](std::string_view other) {
        return other == key || test::edit_distance(typo, std::string(other)) > own;
      });
      if (!clear) continue;
      ++decidable;
      decided += hit;
    }
  std::printf("[ measured ] parameters: top-1 of %d decidable slips %.1f %%, of all %d %.1f %%\n",
              decidable, 100.0 * decided / decidable, all, 100.0 * right / all);
  EXPECT_GT(decidable, 500);
  EXPECT_GE(decided, 0.95 * decidable);
}

}  // namespace
}  // namespace drift::config::nearest_test
