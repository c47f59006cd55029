#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/sha256.hpp"
#include "tests/support/program.hpp"

namespace drift::blind_small_test {
namespace {

using test::text_of;
using Json = nlohmann::json;

/// The twenty trials of configs/blind_small.toml through the program, as a user runs them. The
/// bounds are loose: of 7 nulls, each with a false alarm of at most 5 %, three or more alarm with
/// probability sum_{k>=3} C(7,k) .05^k .95^(7-k) = 0.0038; a diagnosis that does not see the
/// effects but alarms at its 5 % finds five or more of 13 with probability sum_{k>=5} C(13,k) .05^k
/// .95^(13-k) = 3e-4. The short dwells leave mostly slow effects to hide, which look like a random
/// walk of the drift: the power is that of configs/blind.toml, not of this.
TEST(BlindSmallNightly, OfTwentyTrialsNoMoreAlarmAndNoFewerAreSeenThanByChance) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  const test::Answer a = test::driftscope("blind " + test::config("blind_small.toml") + " -o '" +
                                          folder + "' --progress none");
  ASSERT_EQ(a.code, 0) << a.err;
  const Json blind = Json::parse(text_of(folder + "/blind.json"));
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
  EXPECT_GE(detected, 5u);
}

TEST(BlindSmall, TrialsAreSealedAnsweredScoredAndKept) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.file("out");
  const std::string command = "blind " + test::config("blind_small.toml") + " -o '" + folder +
                              "' --full --trials 3 --progress none";
  const test::Answer first = test::driftscope(command);
  ASSERT_EQ(first.code, 0) << first.err;

  const std::string key_hash = sha256_hex(text_of(folder + "/key.json"));
  const auto sealed = first.err.find("Key sealed in"), answered = first.err.find("Answers sealed");
  ASSERT_NE(sealed, std::string::npos);
  ASSERT_NE(answered, std::string::npos);
  EXPECT_LT(sealed, answered);
  EXPECT_NE(first.err.find(key_hash, sealed), std::string::npos);
  for (const char* part : {"Targets", "95 % interval", key_hash.c_str()})
    EXPECT_NE(first.out.find(part), std::string::npos) << part;

  const Json blind = Json::parse(text_of(folder + "/blind.json"));
  EXPECT_EQ(blind.at("key_sha256"), key_hash);
  EXPECT_EQ(blind.at("answers_sha256"), sha256_hex(text_of(folder + "/answers.json")));
  EXPECT_EQ(blind.at("trials"), 3);
  EXPECT_EQ(blind.at("failed"), 0);
  EXPECT_EQ(blind.at("scores").size(), 3u);
  EXPECT_NE(text_of(folder + "/report.html").find("<svg"), std::string::npos);

  // Finished answers are kept: the same command again opens the same key on the same answers.
  const test::Answer again = test::driftscope(command);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(Json::parse(text_of(folder + "/blind.json")).at("answers_sha256"),
            blind.at("answers_sha256"));

  // A key that was changed after it was sealed is not scored.
  scratch.write("out/key.json", text_of(folder + "/key.json") + " ");
  const test::Answer changed = test::driftscope(command);
  EXPECT_EQ(changed.code, 8);
  EXPECT_NE(changed.err.find("was changed after it was sealed"), std::string::npos) << changed.err;
}

}  // namespace
}  // namespace drift::blind_small_test
