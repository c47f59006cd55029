#include <gtest/gtest.h>

#include "core/config/load.hpp"
#include "core/recording/own/format_config.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/own/text_decoding.hpp"
#include "recording_fixture.hpp"
#include "recording_format_of.hpp"

namespace drift::own_file_test {
namespace {

using namespace test;

std::string mistake(const std::string& text, RecordingKind kind = RecordingKind::platform) {
  try {
    format_of(text, kind);
  } catch (const InputError& e) {
    EXPECT_EQ(e.messages().size(), 1u) << e.what();
    return e.what();
  }
  return "";
}

const std::string imu_header =
    "gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z [g]\n";
const std::string still = ",0.1,0.2,0.3,0,0,1\n";

TEST(RecordingUnit, IsReadInTheSpellingsOfPeople) {
  const struct {
    const char* text;
    double size;
    const char* dimension;
  } cases[] = {{"m/s2", 1.0, "m/s^2"},
               {"m/s\u00B2", 1.0, "m/s^2"},
               {"m/s^2", 1.0, "m/s^2"},
               {"m s^-2", 1.0, "m/s^2"},
               {"\u00B5g", 1e-6, "g"},
               {"\u03BCg", 1e-6, "g"},
               {"us", 1e-6, "s"},
               {"ms", 1e-3, "s"},
               {"sec", 1.0, "s"},
               {"\u00B0/s", detail::deg, "rad/s"},
               {"dps", detail::deg, "rad/s"},
               {"deg/sec", detail::deg, "rad/s"},
               {"0.1 arcsec", 0.1 * detail::deg / 3600.0, "rad"},
               {"0,1 arcsec", 0.1 * detail::deg / 3600.0, "rad"},
               {"2^2", 0.0, ""},
               {"1/us", 1e6, "Hz"},
               {"\u00B0C", 1.0, "K"},
               {"\u00B0F", 1.0 / 1.8, "K"},
               {"gon", 0.9 * detail::deg, "rad"},
               {"Grad", 0.0, ""},  // degrees in German, gon in French
               {"LSB", 0.0, ""},
               {"", 0.0, ""},
               {"-1 g", 0.0, ""},
               {"G", 0.0, ""}};
  for (const auto& c : cases) {
    const auto unit = parse_recording_unit(c.text);
    ASSERT_EQ(unit.has_value(), c.size > 0.0) << c.text;
    if (!unit) continue;
    EXPECT_NEAR(unit->to_si / c.size, 1.0, 1e-15) << c.text;
    EXPECT_EQ(unit->dim, parse_unit(c.dimension)->dim) << c.text;
    const auto again = parse_recording_unit(unit->symbol.view());
    ASSERT_TRUE(again) << c.text;
    EXPECT_EQ(again->to_si, unit->to_si) << c.text << ": what is written reads back";
  }
}

TEST(OwnFile, NamesAreGuessedInSomeLanguages) {
  const std::pair<const char*, const char*> names[] = {{"Horodatage", "time"},
                                                       {"Zeit", "time"},
                                                       {"Temp\u00E9rature", "temperature"},
                                                       {"Cardan ext.", "gimbal_outer"},
                                                       {"Cardan m\u00E9d.", "gimbal_middle"},
                                                       {"Cardan int.", "gimbal_inner"},
                                                       {"Rahmen innen", "gimbal_inner"},
                                                       {"\u00C1ngulo_ext", "gimbal_outer"},
                                                       {"Giunto_est", "gimbal_outer"},
                                                       {"Posici\u00F3n", "position"},
                                                       {"Orden X", "cmd_x"},
                                                       {"Acel. Z", "acc_z"},
                                                       {"Hora", "time"},
                                                       {"Outer gimbal", "gimbal_outer"},
                                                       {"marco exterior", "gimbal_outer"},
                                                       {"int", ""},
                                                       {"Remarque", ""}};
  for (const auto& [name, channel] : names) EXPECT_EQ(guessed_channel(name), channel) << name;
}

TEST(OwnFile, Utf16IsDecodedWhereverItIsCut) {
  const std::string bytes("A\0\xE4\0\x3D\xD8\x00\xDE\xAC\x20", 10);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    Utf16Decoder decoder(Utf16Decoder::Order::little);
    std::string text = decoder.decode(bytes.substr(0, cut));
    text += decoder.decode(bytes.substr(cut));
    EXPECT_EQ(text, "A\u00E4\U0001F600\u20AC") << cut;
  }
}

TEST(OwnFile, ACounterThatWrapsIsTime) {
  const Folder folder;
  const std::string path = folder.write(
      "imu.csv", "n," + imu_header + "250" + still + "254" + still + "2" + still + "10" + still);
  const auto format = format_of("counter = \"n\"\nwrap = 256\ntick = \"10 ms\"\n");
  const Recording r = read_recording(path, format, RecordingKind::strapdown, gravity);
  const double expected[] = {2.50, 2.54, 2.58, 2.66};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(r.find("time")->values[i], expected[i], 1e-12);
  const auto without = format_of("counter = \"n\"\ntick = \"10 ms\"\n");
  try {
    read_recording(path, without, RecordingKind::strapdown, gravity);
    FAIL() << "a counter that goes back was read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("goes back from 254 to 2"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("recording.wrap"), std::string::npos) << e.what();
  }
}

TEST(OwnFile, ARateStandsForTime) {
  const Folder folder;
  const std::string path = folder.write("imu.csv", "n," + imu_header + "7" + still + "9" + still);
  const Recording r = read_recording(path, format_of("rate = \"50 Hz\"\nignore = [\"n\"]\n"),
                                     RecordingKind::strapdown, gravity);
  EXPECT_EQ(r.find("time")->values, (std::vector<double>{0.02, 0.04}));
  EXPECT_EQ(r.find("n"), nullptr);
}

TEST(OwnFile, IncrementsBecomeRatesOverTheUsualInterval) {
  const Folder folder;
  std::string text =
      "time [s],gyro_x [deg],gyro_y [deg],gyro_z [deg],acc_x [m/s],acc_y [m/s],acc_z [m/s]\n";
  for (const char* t : {"0.5", "1", "1.5", "4", "4.5"})
    text += std::string(t) + ",1,2,-3,0,0,4.903325\n";
  const std::string path = folder.write("imu.csv", text);
  const Recording r =
      read_recording(path, format_of("kind = \"increments\"\n"), RecordingKind::strapdown, gravity);
  for (int i = 0; i < 5;
       ++i) {  // rows are missing before the fourth: its interval is the usual one
    EXPECT_NEAR(r.find("gyro_z")->values[i], -6.0 * detail::deg, 1e-15) << i;
    EXPECT_NEAR(r.find("acc_z")->values[i], 1.0, 1e-12) << i;
  }
  const Reading a = answer(path, RecordingKind::strapdown);
  EXPECT_EQ(a.code, 4);
  EXPECT_NE(a.text.find("kind = \"increments\""), std::string::npos) << a.text;
}

TEST(OwnFile, Hdf5AndMatTakeTheSameMapping) {
  const Folder folder;
  Recording own = platform_recording();
  for (Channel& c : own.channels)
    if (c.name == "gimbal_outer") c.name = "Phi_a";
  const auto format = format_of(
      "columns = { gimbal_outer = \"-Phi_a\" }\noffset = { gimbal_outer = \"90 deg\" }\n"
      "positions = { \"2\" = \"x up\" }\n",
      RecordingKind::platform);
  for (const char* name : {"own.h5", "own.mat", "own.csv"}) {
    write_recording(own, folder / name);
    const Recording r = read_recording(folder / name, format, RecordingKind::platform, gravity);
    for (std::size_t i = 0; i < r.rows(); ++i)
      EXPECT_NEAR(r.find("gimbal_outer")->values[i],
                  90.0 * detail::deg - own.find("Phi_a")->values[i], 1e-14);
    EXPECT_EQ(r.find("position")->values.back(), 2.0);
  }
}

TEST(OwnFile, ACovariateNeverEndsACommand) {
  const Folder folder;
  const std::string path = folder.write("rec.csv",
                                        "time [s],position,acc_x [g],acc_y [g],acc_z "
                                        "[g],oil,\u00D6l temp [Grad],temperature [F],note\n"
                                        "1,1,0,0,1,3,4,70,start\n2,1,0,0,1,n/a,5,71,\n");
  const Recording r = read_recording(path, RecordingKind::platform, gravity);
  EXPECT_EQ(r.find("oil")->values[0], 3.0);
  EXPECT_TRUE(std::isnan(r.find("oil")->values[1]));
  EXPECT_NE(r.find("Oel_temp"), nullptr);
  ASSERT_NE(r.find("temperature"), nullptr);
  EXPECT_NEAR(r.find("temperature")->values[1], (71.0 - 32.0) / 1.8, 1e-12);
  EXPECT_EQ(r.find("note"), nullptr);
  EXPECT_EQ(r.remarks.texts().size(), 5u) << testing::PrintToString(r.remarks.texts());
}

TEST(OwnFile, AUnitThatTheFileContradictsIsRefusedUnlessItIsWrittenOut) {
  const Folder folder;
  const struct {
    const char *in_file, *in_study;
    double first;  // [degC] of 70; NaN: refused
  } cases[] = {{"K", "degC", NAN},        {"\u00B0F", "degC", NAN},       {"Grad", "degC", 70.0},
               {"\u00B0C", "degC", 70.0}, {"\u00B0F", "", 38.0 / 1.8},    {"K", "", 70.0 - 273.15},
               {"K", "K", 70.0 - 273.15}, {"K) [degC", "overruled", 70.0}};
  for (const auto& c : cases) {
    const bool overruled = std::string(c.in_study) == "overruled";
    const std::string in_file = overruled ? "K" : c.in_file;
    const std::string path =
        folder.write("rec.csv", "time [s],position,acc_x [g],acc_y [g],acc_z [g],T (" + in_file +
                                    ")\n1,1,0,0,1,70\n2,1,0,0,1,71\n");
    const std::string own = overruled ? "T (K) [degC]"
                            : std::string(c.in_study).empty()
                                ? "T"
                                : "T [" + std::string(c.in_study) + "]";
    const auto format =
        format_of("columns = { temperature = \"" + own + "\" }", RecordingKind::platform);
    try {
      const Recording r = read_recording(path, format, RecordingKind::platform, gravity);
      ASSERT_FALSE(std::isnan(c.first)) << own << " of a file in " << in_file;
      EXPECT_NEAR(r.find("temperature")->values[0], c.first, 1e-12) << own;
    } catch (const InputError& e) {
      EXPECT_TRUE(std::isnan(c.first)) << own << ": " << e.what();
      ASSERT_EQ(e.messages().size(), 1u) << e.what();
      for (const std::string& said : {in_file, std::string("[degC]"), std::string("overrule it")})
        EXPECT_NE(std::string(e.what()).find(said), std::string::npos) << e.what();
    }
  }
}

TEST(OwnFile, ATemperatureThatNothingIsMappedToIsSaidWithTheLineToWrite) {
  const Folder folder;
  for (const char* header : {"Temp\xE9rature (\xB0"
                             "C)",
                             "T bo\xEEtier [degC]", "temp_2"}) {
    const std::string path =
        folder.write("rec.csv", "time [s],position,acc_x [g],acc_y [g],acc_z [g]," +
                                    std::string(header) + "\n1,1,0,0,1,20\n2,1,0,0,1,21\n");
    const auto format = format_of("columns = { acc_x = \"acc_x\" }", RecordingKind::platform);
    const Recording r = read_recording(path, format, RecordingKind::platform, gravity);
    EXPECT_EQ(r.find("temperature"), nullptr);
    EXPECT_NE(r.unmapped_temperature.find("write temperature = \""), std::string::npos)
        << header << testing::PrintToString(r.remarks.texts());
    auto of_terms = format;  // a term of the study follows it by the name that it has now
    of_terms.of_terms = {r.channels.at(5).name};
    EXPECT_EQ(read_recording(path, of_terms, RecordingKind::platform, gravity).unmapped_temperature,
              "");
  }
}

TEST(OwnFile, ATemperatureThatNothingSurvivesIsInAnotherUnit) {
  const Folder folder;
  const auto text = [&](const char* unit, double value) {
    return fmt::format("time [s],{},temperature [{}]\n1{}{}\n2{}{}\n",
                       imu_header.substr(0, imu_header.size() - 1), unit,
                       still.substr(0, still.size() - 1) + ",", value,
                       still.substr(0, still.size() - 1) + ",", value);
  };
  const auto read = [&](const char* unit, double value) {
    return read_recording(folder.write("t.csv", text(unit, value)), RecordingKind::strapdown,
                          gravity);
  };
  EXPECT_NEAR(read("K", 295.0).find("temperature")->values[0], 21.85, 1e-9);
  EXPECT_EQ(read("degC", 71.0).find("temperature")->values[0], 71.0);
  try {
    read("degC", 295.0);
    ADD_FAILURE() << "295 degC was read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("[K]"), std::string::npos) << e.what();
  }
}

TEST(OwnFile, MistakesInTheSectionAreNamed) {
  const struct {
    const char *text, *says;
  } cases[] = {
      {"columms = { acc_x = \"Ax [g]\" }", "Did you mean 'columns'?"},
      {"columns = { acc_X = \"Ax [g]\" }", "Did you mean 'acc_x'?"},
      {"columns = { accel_x = \"Ax [g]\" }", "Did you mean 'acc_x'?"},
      {"columns = { acx = \"Ax [g]\" }", "Did you mean 'acc_x'?"},
      {"columns = { inner = \"A [deg]\" }", "Did you mean 'gimbal_inner'?"},
      {"columns = { temp = \"T [degC]\" }", "Did you mean 'temperature'?"},
      {"columns = { acc_x = 3 }", "expected a header of the file with its unit"},
      {"columns = { acc_x = \"Ax [gg]\" }", "unknown unit 'gg'"},
      {"columns = { acc_x = \"Ax [g]\", acc_y = \"Ax [g]\" }", "name the same column 'Ax'"},
      {"columns = \"Ax\"", "expected a table"},
      {"positions = { up = 3 }", "expected a position of the plan: 1 to 2"},
      {"positions = { up = \"z upp\" }", "Did you mean 'z up'?"},
      {"offset = { gimbal_inner = \"90 s\" }", "measures something else"},
      {"offset = { gimbal_innr = \"90 deg\" }", "Did you mean 'gimbal_inner'?"},
      {"ignore = \"Datum\"", "expected a list of headers"},
      {"delimiter = \"|\"", "one of \"auto\", \",\", \";\", \"tab\", \"space\""},
      {"decimal = \",\"\ndelimiter = \",\"", "both a comma"},
      {"rate = 100", "has no unit"},
      {"counter = \"n\"", "expected tick"},
      {"wrap = 256", "without a counter"},
      {"rate = \"1 Hz\"\ncolumns = { time = \"t [s]\" }", "together with a column of time"},
      {"date = \"d\"\ncounter = \"n\"\ntick = \"1 s\"", "given together with counter"},
      {"kind = \"increments\"", "sensors fixed to a case"}};
  for (const auto& c : cases)
    EXPECT_NE(mistake(c.text).find(c.says), std::string::npos) << c.text << "\n" << mistake(c.text);
  EXPECT_EQ(mistake("columns = { oil = \"Oil [bar]\" }"), "") << "a covariate may have any unit";
}

}  // namespace
}  // namespace drift::own_file_test
