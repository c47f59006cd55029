// The study that `driftscope rank --improve` leaves, as a user goes on with it.
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace drift::rank_improved_test {
namespace {

using namespace drift::test;
using Json = nlohmann::json;

Json parsed(const Answer& a) {
  EXPECT_EQ(a.code, 0) << a.err;
  return Json::parse(a.out);
}

TEST(RankImproved, WritesAStudyToGoOnWith) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", cheap_study()), out = folder.file("out"),
                    improved = out + "/improved.toml";
  const std::string line = "rank " + file + " --progress none --improve 1";
  Answer a = driftscope(line);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("Next: the same command with -o DIR writes"), std::string::npos) << a.out;
  a = driftscope(line + " -o " + out);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("improved.toml"), std::string::npos) << a.out;
  EXPECT_EQ(driftscope("check " + improved).code, 0);
  const Json before = parsed(driftscope("rank " + file + " --json")),
             after = parsed(driftscope("rank " + improved + " --json")),
             promise = Json::parse(text_of(out + "/rank.json"))["improvement"];
  EXPECT_NEAR(after["plan"]["hours"].get<double>(),
              before["plan"]["hours"].get<double>() + promise["hours_added"].get<double>(), 1e-9);
  // A ranking that proposes nothing does not leave that of another one beside it.
  EXPECT_EQ(driftscope("rank " + file + " -o " + out).code, 0);
  EXPECT_FALSE(std::filesystem::exists(improved));
  EXPECT_FALSE(std::filesystem::exists(out + "/proposed_positions.toml"));
}

}  // namespace
}  // namespace drift::rank_improved_test
