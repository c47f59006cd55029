#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::version_test {
namespace {

using namespace drift::test;

TEST(Program, TermsAndVersionAnswer) {
  const Answer all = driftscope("terms");
  EXPECT_EQ(all.code, 0);
  for (const char* key : {"fixed_drift", "g_drift", "g2_drift", "gyro_misalignment",
                          "torquer_scale", "accelerometer", "frame_closure"})
    EXPECT_NE(all.out.find(key), std::string::npos) << key;
  const std::string heat =
      driftscope("terms torquer_heating").out;  // memory, and a profiled time constant
  for (const char* text : {"heat_i h_i", "3 states", "heat_tau", "profiled over 8, 12, 20, 30",
                           "physics.md 4, no. 21"})
    EXPECT_NE(heat.find(text), std::string::npos) << text;
  constexpr const char* limit =
      "of each recording; what drift turns the gimbals by beside it is left out\n";
  EXPECT_NE(driftscope("terms stiction").out.find(limit), std::string::npos);
  EXPECT_EQ(heat.find(limit), std::string::npos);
  EXPECT_NE(driftscope("terms M_y").out.find("field_n, field_w, field_u [gauss]"),
            std::string::npos);
  EXPECT_NE(driftscope("terms eta_x").out.find("toward the spin axis"), std::string::npos);
  const auto j = nlohmann::json::parse(driftscope("version --json").out);
  EXPECT_TRUE(j.contains("driftscope") && j.contains("compiler") &&
              j["libraries"].contains("SUNDIALS"));
}

}  // namespace
}  // namespace drift::version_test
