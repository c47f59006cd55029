// Latitude and gravity that stand above the rows of a file.
#include "core/recording/own/preamble.hpp"

#include <gtest/gtest.h>

#include "recording_fixture.hpp"

namespace drift::preamble_test {
namespace {

using namespace test;

/// What lines above a header say: "latitude@line gravity@line", "-" for nothing.
std::string said_by(const std::string& above) {
  const Folder folder;
  const std::string path = folder.write("own.csv", above + "time [s];position;acc_x [g]\n1;1;0\n");
  const PreambleSite site = preamble_site(path, find_layout(path, {}, RecordingKind::platform));
  const auto text = [](const std::optional<PreambleValue>& v) {
    return v ? v->value + "@" + std::to_string(v->line) : std::string("-");
  };
  return text(site.latitude) + " " + text(site.gravity);
}

TEST(Preamble, TakesLatitudeAndGravityInTheWordsOfLaboratories) {
  EXPECT_EQ(said_by("Lab 3\nlatitude: 45.75\ng = 9.8065\n"), "45.75 deg@2 9.8065 m/s^2@3");
  EXPECT_EQ(said_by("# lat = 45 deg\n# Gravity [m/s^2]: 9.81\n"), "45 deg@1 9.81 m/s^2@2");
  EXPECT_EQ(said_by("Geographische Breite: 45,75 Grad\n"), "45.75 deg@1 -");
  EXPECT_EQ(said_by("Breite;48,14 \u00B0\nErdbeschleunigung;9,8072;m/s\u00B2\n"),
            "48.14 deg@1 9.8072 m/s^2@2");
  EXPECT_EQ(said_by("Geographische Breite: 48.14\xB0\n"), "48.14 deg@1 -") << "Windows-1252";
  EXPECT_EQ(said_by("\"Latitude\",\"33.9 S\"\n% g0: 9.8\n"), "-33.9 deg@1 -");
  EXPECT_EQ(said_by("Latitud (\u00B0) = -33,5\nPesanteur 9.8061 m/s2\n"),
            "-33.5 deg@1 9.8061 m/s^2@2");
  EXPECT_EQ(said_by("lat 45.75\nLatitude: 45.75 deg N\n"), "45.75 deg@1 -");
}

TEST(Preamble, LeavesWhatMayBeSomethingElse) {
  for (const char* line : {"latitude: 45.75 rad",
                           "latitude: 91",
                           "latitude: 45 45 30",
                           "latitude: 45\u00B045'",
                           "latitude: 0",
                           "Breite: 45 mm",
                           "Breite [mm]: 45",
                           "platform latitude error: 0.5",
                           "translat = 45",
                           "lat2 = 45",
                           "latitude, longitude: 45.75, 4.85",
                           "latitude,45,75",
                           "g = 1",
                           "g = 9.9",
                           "g = 9.81 ms",
                           "mg = 9.81",
                           "g-sensitivity = 9.81",
                           "lat: -33 S",
                           "latitude 45.75 of the old laboratory",
                           "latitude:",
                           "latitude",
                           "45.75",
                           "latitude: 45.75\nlatitude: 46"})
    EXPECT_EQ(said_by(std::string(line) + "\n"), "- -") << line;
}

}  // namespace
}  // namespace drift::preamble_test
