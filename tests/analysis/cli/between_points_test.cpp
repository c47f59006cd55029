// Recordings that a newcomer's trial made: a step between two points of the library's grid, and an
// effect that no term describes.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace drift::between_points_test {
namespace {

using namespace drift::test;
using Json = nlohmann::json;

struct Diagnosed {
  Json json;
  std::string said;
};

/// A recording of twelve positions with `more` in the truth, diagnosed without it.
Diagnosed diagnosed(const std::string& more, const std::string& terms, int seed) {
  const std::string base =
      "\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", \"torquer_scale\", "
      "\"accelerometer\"";
  const auto study = [&](const std::string& truth) {
    return "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"twelve\"\nmode = "
           "\"free\"\ndwell = \"60 min\"\nsample = \"180 s\"\n[truth]\ncoupling = \"eq6\"\nterms = "
           "[" +
           base + truth + "]\n[[filter]]\nname = \"nominal\"\ncoupling = \"eq6\"\nterms = [" +
           base + "]\n[monte_carlo]\nseed = " + std::to_string(seed) + "\n";
  };
  const ScratchFolder folder;
  const std::string truth = folder.write("truth.toml", study(terms) + more),
                    nominal = folder.write("nominal.toml", study("")),
                    recording = folder.file("r.csv"), out = folder.file("out");
  const Answer made = driftscope("simulate " + truth + " -o " + recording);
  EXPECT_EQ(made.code, 0) << made.err;
  const Answer a =
      driftscope("diagnose " + nominal + " " + recording + " -o " + out + " --progress none");
  EXPECT_EQ(a.code, 0) << a.err;
  return {Json::parse(text_of(out + "/diagnosis.json")), a.out};
}

TEST(BetweenPoints, AStepThatIsAtNoneIsNamed) {
  const auto [json, said] = diagnosed(
      "[truth.parameters]\ndD_I_x = \"0.05 deg/h/g\"\ndD_I_y = \"0 deg/h/g\"\n"
      "dD_I_z = \"0 deg/h/g\"\ndD_t0 = \"7.3 h\"\n",
      ", \"mass_unbalance_step\"", 31);
  EXPECT_EQ(json["verdict"], "named") << said;
  ASSERT_EQ(json["causes"].size(), 1u) << said;
  EXPECT_EQ(json["causes"][0]["term"], "mass_unbalance_step") << said;
  EXPECT_EQ(json["causes"][0]["axis"], "x") << said;
  for (const Json& p : json["causes"][0]["parameters"])
    EXPECT_LT(std::abs(p["value"].get<double>() - (p["key"] == "dD_t0" ? 7.3 : 0.05)),
              3.0 * p["sigma"].get<double>())
        << said;
}

TEST(BetweenPointsNightly, WithoutANameTheMisfitIsWhereTheFormActs) {
  const auto [json, said] = diagnosed(
      "[[term]]\nkey = \"bump\"\ntitle = \"bump\"\nacts_on = \"accelerometer.z\"\nequation = "
      "\"A*step(t-26000)*step(27500-t)\"\nparameters = { A = { unit = \"ug\", prior = 25 } }\n"
      "[truth.parameters]\nbump_A = \"40 ug\"\n",
      ", \"bump\"", 3);
  EXPECT_EQ(json["verdict"], "unexplained") << said;
  ASSERT_TRUE(json["proposal"].is_object() || json["proposal"].is_string()) << said;
  const auto sentence = json["sentence"].get<std::string>();
  EXPECT_NE(sentence.find("it sits in the accelerometer z."), std::string::npos) << sentence;
  ASSERT_TRUE(json["proposal"].is_object()) << said;
  EXPECT_NE(said.find("Next: look for what acts as " +
                      json["proposal"]["acts_on"].get<std::string>() + " += "),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace drift::between_points_test
