// What the rates of a strapdown recording are, said by the study or by the file.
#include "core/recording/sample_kind.hpp"

#include <gtest/gtest.h>

#include "core/config/load.hpp"
#include "core/estimate/strapdown/signals.hpp"
#include "core/recording/canonical_units.hpp"
#include "core/recording/own/format_config.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "recording_fixture.hpp"
#include "recording_format_of.hpp"

namespace drift::sample_kind_test {
namespace {

using namespace test;

std::string mistake(const std::string& text, RecordingKind kind) {
  try {
    format_of(text, kind);
  } catch (const InputError& e) {
    EXPECT_EQ(e.messages().size(), 1u) << e.what();
    return e.what();
  }
  return "";
}

std::string rows_of(const std::string& header, const std::string& readings) {
  std::string text = "time [s]," + header + "\n";
  for (const char* t : {"0.5", "1", "1.5", "2", "2.5"}) text += std::string(t) + readings + "\n";
  return text;
}

const std::string rates = rows_of(
    "gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z [g]", ",1,2,-3,0,0,1");
const std::string increments =
    rows_of("gyro_x [deg],gyro_y [deg],gyro_z [deg],acc_x [m/s],acc_y [m/s],acc_z [m/s]",
            ",1,2,-3,0,0,4.903325");

Recording read(const std::string& path, const std::string& section) {
  return read_recording(path, format_of(section), RecordingKind::strapdown, gravity);
}

TEST(SampleKinds, RatesAreInstantsUntilTheStudySaysThatTheyAreMeans) {
  const Folder folder;
  const std::string path = folder.write("rates.csv", rates);
  EXPECT_FALSE(holds_mean_rates(read(path, "")));
  EXPECT_FALSE(holds_mean_rates(read(path, "kind = \"rates\"\n")));
  const Recording means = read(path, "kind = \"mean_rates\"\n");
  EXPECT_TRUE(holds_mean_rates(means));
  EXPECT_TRUE(strapdown::signals_of(means).means);
  EXPECT_EQ(means.find("gyro_z")->values, read(path, "").find("gyro_z")->values);
}

TEST(SampleKinds, IncrementsAreMeansTimesTheirInterval) {
  const Folder folder;
  const Recording r = read(folder.write("increments.csv", increments), "kind = \"increments\"\n");
  EXPECT_TRUE(holds_mean_rates(r));
  EXPECT_NEAR(r.find("gyro_z")->values[2], -6.0 * detail::deg, 1e-15);
}

/// At 128 Hz times of four places are 0.0078 or 0.0079 s apart; of nine digits those of the first
/// seconds are exact. Counts stay counts, and what they add up to stays it.
TEST(SampleKinds, CountsOfEvenRowsStayCountsWhereTimesAreRounded) {
  const Folder folder;
  for (const bool places : {true, false}) {
    std::string rows =
        "time [s],gyro_x [arcsec],gyro_y [arcsec],gyro_z [arcsec],acc_x [m/s],acc_y [m/s],acc_z "
        "[m/s]\n";
    constexpr std::size_t n = 20000;
    double whole = 0.0;  // [arcsec]
    for (std::size_t k = 1; k <= n; ++k) {
      const double gained = 0.4 * static_cast<double>(k * 7919 % 5 < 2 ? 1 : 0);
      if (k > 1) whole += gained;
      const double t = static_cast<double>(k) / 128.0;
      rows += (places ? fmt::format("{:.4f}", t) : fmt::format("{:.9g}", t)) +
              fmt::format(",{:.1f},0,0,0,0,0.0766\n", gained);
    }
    const Recording r = read(folder.write("counts.csv", rows), "kind = \"increments\"\n");
    const Channel& gyro = *r.find("gyro_x");
    ASSERT_TRUE(reading_step(gyro, nullptr)) << places;
    EXPECT_NEAR(*reading_step(gyro, nullptr), 0.4 * unit::arcsec.to_si * 128.0, 1e-8);
    const std::vector<double>& time = r.find("time")->values;
    double sum = 0.0;
    for (std::size_t k = 1; k < n; ++k) sum += gyro.values[k] * (time[k] - time[k - 1]);
    // A rounding of the times, 1e-4 s at most, for every change of the rate, and their mean.
    EXPECT_NEAR(sum / unit::arcsec.to_si / whole, 1.0, 1e-3) << places;
  }
}

/// As `convert` writes it: what is read again needs no line in the study.
TEST(SampleKinds, AFileThatSaysItNeedsNoKey) {
  const Folder folder;
  const Recording r = in_canonical_units(
      read(folder.write("increments.csv", increments), "kind = \"increments\"\n"));
  for (const char* name : {"again.csv", "again.h5", "again.mat"}) {
    write_recording(r, folder / name);
    const Recording again = read(folder / name, "");
    EXPECT_TRUE(holds_mean_rates(again)) << name;
    EXPECT_NEAR(again.find("gyro_z")->values[2], -6.0 * detail::deg, 1e-12) << name;
    const Recording twice = read(folder / name, "kind = \"mean_rates\"\n");
    EXPECT_EQ(twice.facts, again.facts) << name << ": said once";
  }
}

TEST(SampleKinds, WhatIsNoneIsRefused) {
  EXPECT_NE(mistake("kind = \"means\"", RecordingKind::strapdown)
                .find("'recording.kind' is the string \"means\" (expected one of \"rates\", "
                      "\"mean_rates\", \"increments\")"),
            std::string::npos)
      << mistake("kind = \"means\"", RecordingKind::strapdown);
  EXPECT_NE(mistake("kind = \"mean_rates\"", RecordingKind::platform)
                .find("'recording.kind' = \"mean_rates\" is for sensors fixed to a case"),
            std::string::npos)
      << mistake("kind = \"mean_rates\"", RecordingKind::platform);
  const Folder folder;
  const std::string path = folder.write("increments.csv", increments);
  try {
    read(path, "kind = \"mean_rates\"\n");
    FAIL() << "angles were read as rates";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("need kind = \"increments\""), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace drift::sample_kind_test
