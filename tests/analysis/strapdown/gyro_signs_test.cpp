// Columns of the wrong sign: what mends them, and what tells it from its mirror image.
#include "analysis/strapdown/gyro_signs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "analysis/strapdown/case_study.hpp"
#include "analysis/strapdown/findings.hpp"
#include "core/base/check.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::gyro_signs_test {
namespace {

using Names = std::initializer_list<const char*>;

mc::Study study_at(const char* latitude) {
  return mc::read_study_text(test::strapdown_study(latitude, "9.8 m/s^2"), "study.toml");
}

/// A unit of which the gyros see the Earth, or do not.
Recording made(EarthRate earth) {
  test::StrapdownScript s;
  s.dwells = 12;
  s.rest = 10.0;
  s.turn = 8.0;
  s.gyro_noise = earth == EarthRate::seen ? 3e-6 : 1e-2;
  s.acc_noise = 1e-4;
  s.omega_ie_l = study_at("34 deg").site.omega_ie_l();
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 0.3);
  return test::strapdown_recording(s, theta);
}

Recording reversed(Recording r, Names names) {
  for (const char* name : names)
    for (double& v : std::ranges::find(r.channels, name, &Channel::name)->values) v = -v;
  return r;
}

std::string refusal(const Recording& recording, const char* latitude = "34 deg") {
  try {
    case_study(study_at(latitude), recording);
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    return e.messages().front();
  }
  return "";
}

/// The line of a study that reverses these columns.
std::string line(Names names) {
  std::string map;
  for (const char* name : names)
    map += std::string(map.empty() ? "" : ", ") + name + " = \"-" + name + "\"";
  return "[recording] columns = { " + map + " }";
}

/// Where each of the lines is said; each is, after the one before.
void expect_lines(const std::string& said, std::initializer_list<Names> lines) {
  std::size_t from = 0;
  for (const Names names : lines) {
    const std::size_t at = said.find(line(names), from);
    ASSERT_NE(at, std::string::npos) << line(names) << "\n" << said;
    from = at + 1;
  }
  std::size_t said_lines = 0;
  for (std::size_t at = said.find("columns = {"); at != std::string::npos;
       at = said.find("columns = {", at + 1))
    ++said_lines;
  EXPECT_EQ(said_lines, lines.size()) << said;
}

const std::string by_earth = "The Earth's rate at rest tells it from its mirror image",
                  mirror = "One makes the mirror image of what the other makes",
                  same_unit = "Both make the same unit";

TEST(GyroSigns, OneReversedAccelerometerIsToldByTheEarthsRateFromItsMirrorImage) {
  const Recording right = made(EarthRate::seen);
  EXPECT_EQ(refusal(right), "");
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) {
    const std::string said = refusal(reversed(right, {name}));
    expect_lines(said, {{name}});
    EXPECT_NE(said.find(by_earth), std::string::npos) << said;
    EXPECT_EQ(refusal(reversed(reversed(right, {name}), {name})), "");
  }
}

/// Obeyed, it is the unit that the study says: at the mirrored latitude it is the other one.
TEST(GyroSigns, OfTwoMirrorImagesItIsThatOfTheStudysLatitude) {
  const Recording wrong = reversed(made(EarthRate::seen), {"acc_x"});
  expect_lines(refusal(wrong, "34 deg"), {{"acc_x"}});
  const std::string south = refusal(wrong, "-34 deg");
  expect_lines(south, {{"gyro_y", "gyro_z"}, {"acc_y", "acc_z"}});
  EXPECT_NE(south.find(same_unit), std::string::npos) << south;
}

TEST(GyroSigns, FrontRightDownBesideFrontLeftUpIsMendedOnEitherSide) {
  const Recording right = made(EarthRate::seen);
  for (const Names names : {Names{"gyro_y", "gyro_z"}, Names{"acc_y", "acc_z"}}) {
    const std::string said = refusal(reversed(right, names));
    expect_lines(said, {{"gyro_y", "gyro_z"}, {"acc_y", "acc_z"}});
    EXPECT_NE(said.find(same_unit), std::string::npos) << said;
  }
  expect_lines(refusal(reversed(right, {"gyro_x", "gyro_y"})),
               {{"gyro_x", "gyro_y"}, {"acc_x", "acc_y"}});
}

TEST(GyroSigns, WithoutTheEarthBothMirrorImagesAreSaidThePlainerFirst) {
  const Recording right = made(EarthRate::hidden);
  EXPECT_EQ(refusal(right), "");
  for (const Names names : {Names{"acc_x"}, Names{"gyro_y", "gyro_z"}, Names{"acc_y", "acc_z"}}) {
    const std::string said = refusal(reversed(right, names));
    expect_lines(said, {{"acc_x"}, {"gyro_y", "gyro_z"}});
    EXPECT_NE(said.find(mirror), std::string::npos) << said;
    EXPECT_EQ(said.find(by_earth), std::string::npos) << said;
  }
}

/// No accelerometers make up for an odd number of gyros.
TEST(GyroSigns, AnOddNumberOfReversedGyrosIsOfGyrosAlone) {
  for (const EarthRate earth : {EarthRate::seen, EarthRate::hidden}) {
    const Recording right = made(earth);
    for (const Names names :
         {Names{"gyro_x"}, Names{"gyro_y"}, Names{"gyro_z"}, Names{"gyro_x", "gyro_y", "gyro_z"}}) {
      const std::string said = refusal(reversed(right, names));
      expect_lines(said, {names});
      for (const std::string& words : {by_earth, mirror, same_unit})
        EXPECT_EQ(said.find(words), std::string::npos) << said;
    }
  }
}

/// No change of one triad makes right-handed axes of left-handed ones.
TEST(GyroSigns, OfLeftHandedAxesOneIsReversedInBoth) {
  const Recording right = made(EarthRate::seen);
  for (const Names names : {Names{"gyro_z", "acc_z"}, Names{"gyro_y", "acc_y"}}) {
    const Recording wrong = reversed(right, names);
    const std::string said = refusal(wrong);
    EXPECT_NE(said.find("the axes are left-handed"), std::string::npos) << said;
    EXPECT_NE(said.find(line({"gyro_z", "acc_z"})), std::string::npos) << said;
    EXPECT_EQ(refusal(reversed(wrong, {"gyro_z", "acc_z"})), "");
  }
}

/// A median alone takes all gyros for reversed where the turns about one axis stay wrong.
TEST(GyroSigns, AllGyrosAreReversedOnlyWhereNoTurnStaysWrong) {
  const std::vector<Dwell> none;
  const auto errors_as = [](std::vector<double> of_all) {
    return [of_all](const ColumnsAs& as) {
      const bool all = std::ranges::count(as.gyros.sign, -1.0) == 3 && as.gyros.from[0] == 0 &&
                       as.gyros.from[1] == 1 && as.gyros.from[2] == 2;
      return all ? of_all : std::vector<double>{2.0, 2.0, 0.3, 0.3};
    };
  };
  const Site site = study_at("34 deg").site;
  const std::vector<double> declared{2.0, 2.0, 0.3, 0.3};
  EXPECT_EQ(mistaken_columns(none, site, declared, errors_as({0.01, 0.01, 0.01, 0.7})), "");
  expect_lines(mistaken_columns(none, site, declared, errors_as({0.01, 0.01, 0.01, 0.01})),
               {{"gyro_x", "gyro_y", "gyro_z"}});
}

}  // namespace
}  // namespace drift::strapdown::gyro_signs_test
