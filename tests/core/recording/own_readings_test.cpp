// How columns and cells of a user's own file are taken where names and values must tell.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "recording_fixture.hpp"

namespace drift::own_readings_test {
namespace {

using namespace test;

TEST(OwnReadings, AxesOfColumnsToldByTheirValuesAreThoseOfTheirNames) {
  const Folder folder;
  const auto channels = [&](const char* header) {
    const GuessedFile file = guess_file(folder.write(
        "own.csv",
        std::string("t [s];") + header + "\n1;0,98;0,1;0,17\n2;0,17;0,98;0,1\n3;0,1;0,17;0,98\n"));
    std::string text;
    for (const GuessedColumn& c : file.columns) text += c.channel + " ";
    return text;
  };
  EXPECT_EQ(channels("Sensor Z [g];Sensor X [g];Sensor Y [g]"), "time acc_z acc_x acc_y ");
  EXPECT_EQ(channels("Sensor 3 [g];Sensor 1 [g];Sensor 2 [g]"), "time acc_x acc_y acc_z ");
}

/// What the first columns of a log, two rows of them, and three of accelerometers are taken for.
std::string channels_of(const char* header, const std::string& first, const std::string& second) {
  const Folder folder;
  const GuessedFile file =
      guess_file(folder.write("own.csv", fmt::format("{};ax [g];ay [g];az [g]\n{};0,98;0,1;0,17\n"
                                                     "{};0,17;0,98;0,1\n",
                                                     header, first, second)));
  std::string text;
  for (const GuessedColumn& c : file.columns)
    text += (c.channel.empty() ? "-" : c.channel + c.unit) + " ";
  return text;
}
const std::string acc = "acc_xg acc_yg acc_zg ";

/// "Data" is a date in Italian, and neither a name of the time nor one of a position.
TEST(OwnReadings, TheOneColumnOfTimesOfAClockIsTheTime) {
  EXPECT_EQ(channels_of("Data", "2026-03-12T08:30:30.000", "2026-03-12T08:31:00.000"),
            "time " + acc);
  EXPECT_EQ(channels_of("Data e ora", "12/03/2026 08:30:30,5", "12/03/2026 08:31:00,5"),
            "time " + acc);
  EXPECT_EQ(channels_of("Inizio;Fine", "08:30:30;08:31:00", "08:31:00;08:31:30"), "- - " + acc);
  EXPECT_EQ(channels_of("Data", "primo", "secondo"), "position " + acc);
}

TEST(OwnReadings, UnitsOfTheHeadingDecideWhatAColumnIsNot) {
  const Folder folder;
  const char *first = "22:12:00;21,5", *second = "22:14:00;21,6";
  EXPECT_EQ(channels_of("clock;T [\u00B0C]", first, second), "time temperature\u00B0C " + acc);
  EXPECT_EQ(channels_of("clock;t (K)", "22:12:00;294,1", "22:14:00;294,2"),
            "time temperatureK " + acc);
  EXPECT_EQ(channels_of("Zeit / s;T / K", "1;294,1", "2;294,2"), "times temperatureK " + acc);
  EXPECT_EQ(channels_of("Zeit in min;T in \u00B0C", "1;21,1", "2;21,2"),
            "timemin temperature\u00B0C " + acc);
  EXPECT_EQ(channels_of("Zeit / s;Gyro x / deg/s", "1;3", "2;4"), "times gyro_xdeg/s " + acc);
  EXPECT_EQ(channels_of("Zeit / s;an / aus", "1;3", "2;4"), "times - " + acc);
  EXPECT_EQ(channels_of("clock;T_degC", first, second), "time temperaturedegC " + acc);
  // Without a unit "T" is what a clock leaves of it.
  EXPECT_EQ(channels_of("T;Uhrzeit", "21,5;22:12:00", "21,6;22:14:00"), "- time " + acc);
  EXPECT_EQ(channels_of("T;clock", "21,5;22:12:00", "21,6;22:14:00"), "- time " + acc);
  EXPECT_EQ(channels_of("T;n", "1;3", "2;4"), "time? - " + acc);
  EXPECT_EQ(channels_of("t [s];Pos [deg]", "1;1", "2;2"), "times - " + acc);
  EXPECT_EQ(channels_of("Temp [s];n", "1;3", "2;4"), "times - " + acc);
  EXPECT_EQ(channels_of("t [s];gx [m/s^2]", "1;3", "2;4"), "times - " + acc);
  EXPECT_EQ(channels_of("t [s];gyro_x_c", "1;3", "2;4"), "times gyro_x? " + acc) << "a word";
  EXPECT_EQ(channels_of("t [s];gx_counts", "1;3", "2;4"), "times gyro_x? " + acc);
  EXPECT_EQ(channels_of("t [s];T_K", "1;294,1", "2;294,2"), "times temperatureK " + acc);
  EXPECT_EQ(channels_of("t [s];Temp [K]", "1;21,1", "2;21,2"), "times temperaturedegC " + acc)
      << "nothing is at 21 K";
  EXPECT_EQ(channels_of("unix_ms;n", "1773532680000;1", "1773532681000;2"), "timems - " + acc);
  EXPECT_EQ(channels_of("epoch;n", "1773532680;1", "1773532681;2"), "times - " + acc);
  const GuessedFile words = guess_file(
      folder.write("c.csv", "t [s];acc_x_c;acc_y_c;acc_z_c\n1;0,98;0,1;0,17\n2;0,17;0,98;0,1\n"));
  EXPECT_EQ(words.columns[1].unit, "g") << "corrected, not in degrees Celsius";
}

TEST(OwnReadings, AUnitStandsBehindASlashWithoutBlanksToo) {
  EXPECT_EQ(channels_of("t/s;T/\u00B0C", "1;21,1", "2;21,2"), "times temperature\u00B0C " + acc);
  EXPECT_EQ(channels_of("t/min;T/K", "1;294,1", "2;294,2"), "timemin temperatureK " + acc);
  EXPECT_EQ(channels_of("t/s;Gyro x/deg/s", "1;3", "2;4"), "times gyro_xdeg/s " + acc);
  EXPECT_EQ(channels_of("t/s;gyro_x/(deg/h)", "1;3", "2;4"), "times gyro_xdeg/h " + acc);
  EXPECT_EQ(channels_of("t/s;T/[K]", "1;294,1", "2;294,2"), "times temperatureK " + acc);
  // A slash within a unit, or between words, divides no name from its unit.
  for (const char* header : {"omega deg/h", "deg/h", "\u00B0/h", "an/aus", "v m/s", "v_m/s",
                             "gx_deg/s", "a_m/s^2", "/s"})
    EXPECT_FALSE(header_cell(header).unit) << header << header_cell(header).name;
  EXPECT_EQ(header_cell("a_x/(m/s^2)").name, "a_x");
  EXPECT_EQ(header_cell("a_x/m/s^2").unit, "m/s^2");
  EXPECT_EQ(header_cell("Phi_m/deg").unit, "deg");
}

TEST(OwnReadings, AHeadingIsNamedWithoutAColumnOfPositions) {
  for (const char* name : {"Table heading", "Heading", "Case heading", "table_heading"})
    EXPECT_EQ(channels_of((std::string("t [s];") + name).c_str(), "1;0", "2;45"),
              "times case_headingdeg " + acc)
        << name;
  EXPECT_EQ(channels_of("t [s];Case heading [rad]", "1;0", "2;0,8"),
            "times case_headingrad " + acc);
  EXPECT_EQ(channels_of("t [s];Tischwinkel", "1;0", "2;0"), "times case_headingdeg " + acc);
  EXPECT_EQ(channels_of("t [s];Tischwinkel", "1;0", "2;0,8"), "times case_heading? " + acc);
  EXPECT_EQ(channels_of("t [s];Heading [m]", "1;0", "2;45"), "times - " + acc);
  EXPECT_EQ(channels_of("t [s];gyro_x [deg/s];Heading", "1;3;0", "2;4;45"),
            "times gyro_xdeg/s - " + acc)
      << "a navigator's own";
}

TEST(OwnReadings, UnitsOfOtherLanguagesAndGalileosAreKnown) {
  const auto si = [](const char* text) { return parse_recording_unit(text).value().to_si; };
  EXPECT_TRUE(same_unit(parse_recording_unit("\u00B0K").value(), "K"_unit));
  EXPECT_DOUBLE_EQ(si("Gal"), 0.01);
  EXPECT_DOUBLE_EQ(si("mGal"), 1e-5);
  EXPECT_DOUBLE_EQ(si("gradi"), detail::deg);
  EXPECT_DOUBLE_EQ(si("gradi"), detail::deg);
  EXPECT_DOUBLE_EQ(si("gradi/Std"), detail::deg / 3600.0);
  EXPECT_DOUBLE_EQ(si("ore"), 3600.0);
  EXPECT_DOUBLE_EQ(si("giorni"), 86400.0);
  EXPECT_DOUBLE_EQ(si("giri"), 360.0 * detail::deg);
}

TEST(OwnReadings, AMinusOfAWordProcessorIsAMinus) {
  EXPECT_EQ(parse_cell("\u22121,5", DecimalMark::automatic).value, -1.5);
  EXPECT_EQ(parse_cell("2.5e\u22123", DecimalMark::automatic).value, 2.5e-3);
  EXPECT_EQ(parse_cell("\u2212", DecimalMark::automatic).kind, ParsedCell::Kind::text);
}

TEST(OwnReadings, RemarksAreNoPositions) {
  const Folder folder;
  const auto position = [&](const std::vector<std::string>& texts) {
    std::string rows;
    for (std::size_t i = 0; i < texts.size(); ++i)
      rows += fmt::format("{},{},0,0,1\n", i + 1, texts[i]);
    const GuessedFile file =
        guess_file(folder.write("own.csv", "t [s],Was,ax [g],ay [g],az [g]\n" + rows));
    return file.columns[1].channel;
  };
  EXPECT_EQ(position({"up", "up", "down", "down"}), "position");
  EXPECT_EQ(position({"ok", "Start", "ok", "ok"}), "") << "a position is held once";
  EXPECT_EQ(position({"Start", "", "", "Ende"}), "") << "and has a name in every row";
}

TEST(OwnReadings, AUnitThatIsNotKnownIsSaidOnce) {
  const Folder folder;
  try {  // a gyro's counts are beyond reason as rad/s
    read_recording(
        folder.write("imu.csv",
                     "time [s],gyro_x [LSB],gyro_y [LSB],gyro_z [LSB],acc_x [g],acc_y [g],acc_z "
                     "[g]\n1,6550,2,3,0,0,1\n2,-6550,2,3,0,0,1\n3,1,2,3,0,0,1\n"),
        RecordingKind::strapdown, gravity);
    FAIL() << "read";
  } catch (const InputError& e) {
    EXPECT_EQ(e.messages().size(), 1u) << e.what();
    EXPECT_NE(std::string(e.what()).find("unknown unit 'LSB'"), std::string::npos) << e.what();
  }
}

TEST(OwnReadings, NoReadingIsAHundredTimesGravity) {
  const Folder folder;
  try {  // -999 m/s^2 stands for a missing one
    read_recording(
        folder.write("imu.csv",
                     "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y "
                     "[g],acc_z [g]\n1,0,0,0,0,0,1\n2,0,0,0,-101.9,0,0\n3,0,0,0,0,0,1\n"),
        RecordingKind::strapdown, gravity);
    FAIL() << "read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("-101.9"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace drift::own_readings_test
