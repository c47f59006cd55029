#include <gtest/gtest.h>

#include "tests/mc/study/study_file.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::published_config_test {
namespace {

using namespace drift::test;

const std::string head =
    "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[[published]]\n";

TEST(Published, ValuesAndSigmasAreReadInInternalUnits) {
  const mc::Study study =
      read_text(head +
                "name = \"paper\"\nfilter = \"eq6\"\n"
                "eta_x = { values = [\"268.15 arcsec\", \"-157 arcsec\"], sigmas = "
                "[\"15 arcsec\", \"16 arcsec\"] }\n"
                "D_I_z = { values = [\"1.45 deg/h/g\"] }\n");
  ASSERT_EQ(study.published.size(), 1u);
  const mc::Published& p = study.published.front();
  EXPECT_EQ(p.name, "paper");
  EXPECT_EQ(p.filter, "eq6");
  ASSERT_EQ(p.values.size(), 2u);
  for (const auto& v : p.values) {
    if (v.param == param("eta_x")) {
      EXPECT_DOUBLE_EQ(v.values.at(0), 268.15 * arcsec);
      EXPECT_DOUBLE_EQ(v.sigmas.at(1), 16.0 * arcsec);
    } else {
      EXPECT_EQ(v.param, param("D_I_z"));
      EXPECT_TRUE(v.sigmas.empty());
    }
  }
}

TEST(Published, MistakesAreLocated) {
  const auto message = [](const std::string& body) -> std::string {
    try {
      read_text(head + body);
    } catch (const InputError& e) {
      EXPECT_EQ(e.code(), ExitCode::config);
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(message("D_I_z = { values = [\"1 deg/h/g\"] }\n").find("name"), std::string::npos);
  EXPECT_NE(message("name = \"a\"\nD_I_z = { values = [\"1 arcsec\"] }\n").find("study.toml:8"),
            std::string::npos);
  EXPECT_NE(message("name = \"a\"\nD_I_z = { values = \"1 deg/h/g\" }\n").find("list"),
            std::string::npos);
  EXPECT_NE(message("name = \"a\"\nD_I_zz = { values = [\"1 deg/h/g\"] }\n").find("D_I_z"),
            std::string::npos);
  EXPECT_NE(
      message("name = \"a\"\nD_I_z = { values = [\"1 deg/h/g\"], sigmas = [] , sigma = [] }\n")
          .find("sigma"),
      std::string::npos);
  EXPECT_NE(message("name = \"a\"\nD_I_z = { values = [\"1 deg/h/g\", \"2 deg/h/g\"], sigmas = "
                    "[\"1 deg/h/g\"] }\n")
                .find("as many"),
            std::string::npos);
}

}  // namespace
}  // namespace drift::published_config_test
