#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/sha256.hpp"
#include "tests/support/program.hpp"

namespace drift {
namespace {

using test::text_of;
using Json = nlohmann::json;

/// The twenty trials of configs/blind_small.toml through the program, as a user runs them.
///
/// What holds by design is asserted exactly. Of the statistics only what a working diagnosis misses less
/// than once in two hundred seeds: of 7 nulls, each with a false alarm of at most 5 %, three or more
/// alarm with probability sum_{k>=3} C(7,k) .05^k .95^(7-k) = 0.0038; of 13 effects of 8 sigma and more,
/// each found with probability 0.9 at least, seven or more are missed with probability 1e-4.
TEST(BlindSmall, TwentyTrialsAreSealedAnsweredScoredAndKept) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  const std::string command = "blind " + test::config("blind_small.toml") + " -o '" + folder + "' --progress none";
  const test::Answer first = test::driftscope(command);
  ASSERT_EQ(first.code, 0) << first.err;

  const std::string key_hash = sha256_hex(text_of(folder + "/key.json"));
  const auto sealed = first.out.find("Key sealed in"), answered = first.out.find("Answers sealed"),
             targets = first.out.find("Targets");
  ASSERT_NE(sealed, std::string::npos);
  EXPECT_LT(sealed, answered);
  EXPECT_LT(answered, targets);
  EXPECT_NE(first.out.find(key_hash, sealed), std::string::npos);
  EXPECT_NE(first.out.find("95 % interval"), std::string::npos);

  const Json blind = Json::parse(text_of(folder + "/blind.json"));
  EXPECT_EQ(blind.at("key_sha256"), key_hash);
  EXPECT_EQ(blind.at("answers_sha256"), sha256_hex(text_of(folder + "/answers.json")));
  EXPECT_EQ(blind.at("trials"), 20);
  EXPECT_EQ(blind.at("failed"), 0);
  std::size_t nulls = 0, alarms = 0, effects = 0, detected = 0;
  for (const Json& t : blind.at("scores")) {
    const std::string stratum = t.at("stratum");
    const bool null = stratum == "null" || stratum == "wrong_noise";
    nulls += null;
    effects += !null;
    alarms += t.at("false_alarm").get<bool>();
    detected += !null && t.at("detected").get<bool>();
  }
  EXPECT_EQ(nulls, 7u);
  EXPECT_EQ(effects, 13u);
  EXPECT_LE(alarms, 2u);
  EXPECT_GE(detected, 7u);
  EXPECT_NE(text_of(folder + "/report.html").find("<svg"), std::string::npos);

  // Finished answers are kept: the same command again opens the same key on the same answers.
  const test::Answer again = test::driftscope(command);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(Json::parse(text_of(folder + "/blind.json")).at("answers_sha256"), blind.at("answers_sha256"));

  // A key that was changed after it was sealed is not scored.
  scratch.write("out/key.json", text_of(folder + "/key.json") + " ");
  const test::Answer changed = test::driftscope(command);
  EXPECT_EQ(changed.code, 8);
  EXPECT_NE(changed.err.find("was changed after it was sealed"), std::string::npos) << changed.err;
}

}  // namespace
}  // namespace drift
