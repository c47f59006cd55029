#include "core/plan/plan_config.hpp"

#include <gtest/gtest.h>

#include "tests/support/plan_text.hpp"

namespace drift::plan_config_test {
namespace {

using Read = test::PlanRead;

Read read(const std::string& text) {
  return test::read_plan_text(text);
}

TEST(PlanConfig, EveryPresetIsKnown) {
  for (const auto name : preset_names) {
    const Read r = read("preset = \"" + std::string(name) + "\"\ndwell = \"20 min\"\n");
    EXPECT_TRUE(r.mistakes.empty()) << name;
    EXPECT_EQ(r.config.plan.preset, name);
    ASSERT_FALSE(r.config.plan.positions.empty());
    EXPECT_DOUBLE_EQ(r.config.plan.positions.front().dwell, 1200.0);
  }
}

TEST(PlanConfig, ModeAndEntryOfThePlanHoldForAllPositionsOfAPreset) {
  const Read r = read("preset = \"six\"\nmode = \"level\"\nentry = \"torqued\"\n");
  ASSERT_EQ(r.config.plan.positions.size(), 6u);
  for (const auto& p : r.config.plan.positions) EXPECT_EQ(p.mode, CommandLaw::level);
  EXPECT_EQ(r.config.plan.positions.back().entry, Entry::torqued);
}

TEST(PlanConfig, PositionsTakeWhatTheyDoNotSayFromThePlan) {
  const Read r = read(
      "dwell = \"10 min\"\nsample = \"10 s\"\nentry = \"torqued\"\n"
      "[[plan.position]]\naxes = \"x=N y=W z=U\"\n"
      "[[plan.position]]\naxes = \"x=U y=N z=W\"\nsample = \"20 s\"\n");
  EXPECT_TRUE(r.mistakes.empty());
  ASSERT_EQ(r.config.plan.positions.size(), 2u);
  EXPECT_EQ(r.config.plan.positions[0].entry, Entry::caged);  // nothing to slew from
  EXPECT_EQ(r.config.plan.positions[1].entry, Entry::torqued);
  EXPECT_DOUBLE_EQ(r.config.plan.positions[0].sample, 10.0);
  EXPECT_DOUBLE_EQ(r.config.plan.positions[1].sample, 20.0);
  EXPECT_DOUBLE_EQ(r.config.plan.positions[1].dwell, 600.0);
  EXPECT_TRUE(r.config.plan.positions[0].R_lp.isIdentity(1e-12));
}

TEST(PlanConfig, ADwellIsAWholeNumberOfSamples) {
  const auto bad = [](const std::string& dwell, const std::string& sample) {
    return !read("preset = \"six\"\ndwell = \"" + dwell + "\"\nsample = \"" + sample + "\"\n")
                .mistakes.empty();
  };
  EXPECT_FALSE(bad("60 min", "60 s"));
  EXPECT_FALSE(bad("0.1 s", "0.01 s"));  // 10 in decimals, 9.999... in binary
  EXPECT_FALSE(bad("7 min", "0.7 s"));
  EXPECT_FALSE(bad("60 s", "1 min"));
  EXPECT_TRUE(bad("60 min", "7 s"));
  EXPECT_TRUE(bad("30 s", "60 s"));
  EXPECT_TRUE(bad("1 h", "0.007 s"));
  EXPECT_TRUE(bad("1000 h", "0.001 s"));  // more than a recording can hold
}

TEST(PlanConfig, TheDwellThatIsProposedIsTaken) {
  const auto proposed = [](const std::string& dwell, const std::string& sample) {
    const auto text = [&](const std::string& d) {
      return "preset = \"six\"\ndwell = \"" + d + "\"\nsample = \"" + sample + "\"\n";
    };
    const Read r = read(text(dwell));
    EXPECT_EQ(r.mistakes.size(), 1u) << dwell;
    if (r.mistakes.empty()) return std::string();
    const std::string& said = r.mistakes[0];
    const auto from = said.find("such as \"");
    EXPECT_NE(from, std::string::npos) << said;
    if (from == std::string::npos) return std::string();
    const auto begin = from + std::string_view("such as \"").size();
    const std::string found = said.substr(begin, said.find('"', begin) - begin);
    const Read again = read(text(found));
    EXPECT_TRUE(again.mistakes.empty()) << found << ": " << again.mistakes[0];
    return found;
  };
  EXPECT_EQ(proposed("100000 min", "60 min"), "99960 min");  // 6001200 s would be out of range
  EXPECT_EQ(proposed("60 min", "7 s"), "3598 s");
  EXPECT_EQ(proposed("100 min", "60 min"), "120 min");
  EXPECT_EQ(proposed("30 s", "60 s"), "1 min");
  EXPECT_EQ(proposed("0.001 min", "0.041 s"), "0.082 s");  // one sample would be too short
  EXPECT_EQ(proposed("20000.0005 s", "0.001 s"), "10000 s");
}

TEST(PlanConfig, ADwellThatNoPositionHasNeedsNoWholeNumberOfSamples) {
  const std::string plan = "sample = \"60.0012 s\"\n",
                    position = "[[plan.position]]\naxes = \"x=N y=W z=U\"\n";
  EXPECT_TRUE(read(plan + position + "dwell = \"3600.072 s\"\n").mistakes.empty());
  EXPECT_FALSE(read(plan + position).mistakes.empty()) << "here the 60 min of [plan] are held";
  EXPECT_FALSE(
      read(plan + "dwell = \"60 min\"\n" + position + "dwell = \"3600.072 s\"\n").mistakes.empty())
      << "a dwell that is written down is meant";
}

TEST(PlanConfig, WhatPositionsTakeOverIsFoundWrongOnce) {
  const std::string two =
      "[[plan.position]]\naxes = \"x=N y=W z=U\"\n"
      "[[plan.position]]\naxes = \"x=W y=S z=U\"\n";
  const Read r = read("dwell = \"25 min\"\nsample = \"45 s\"\n" + two);
  ASSERT_EQ(r.mistakes.size(), 1u);
  EXPECT_NE(r.mistakes[0].find("'plan.dwell' = 1500 s is 33.3333 samples"), std::string::npos);
  // Its own dwell, or a default of [plan] that nothing else holds, is a position's own mistake.
  EXPECT_EQ(read("dwell = \"30 min\"\nsample = \"45 s\"\n" + two + "dwell = \"25 min\"\n")
                .mistakes.size(),
            1u);
  EXPECT_EQ(read("sample = \"7 s\"\n" + two).mistakes.size(), 2u);
}

TEST(PlanConfig, KeysOfTheOtherKindOfTestAreRefused) {
  for (const char* text :
       {"kind = \"strapdown\"\npreset = \"six\"\n", "kind = \"strapdown\"\ndwell = \"1 min\"\n",
        "preset = \"six\"\nstatic_min = \"2 s\"\n",
        "preset = \"six\"\naccelerometers_in_turns = true\n"}) {
    const auto mistakes = read(text).mistakes;
    ASSERT_EQ(mistakes.size(), 1u) << text;
    EXPECT_TRUE(mistakes[0].starts_with("t.toml:3:")) << mistakes[0];
  }
}

}  // namespace
}  // namespace drift::plan_config_test
