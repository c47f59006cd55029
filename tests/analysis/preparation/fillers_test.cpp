#include "analysis/preparation/fillers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/model_builders.hpp"

namespace drift::preparation::fillers_test {
namespace {

/// Three positions of ten rows: an accelerometer and a gimbal that drift a little.
Recording resting() {
  Recording r;
  r.source = "log.csv";
  Channel position{"position", unit::one, {}}, acc{"acc_x", unit::g, {}},
      inner{"gimbal_inner", unit::deg, {}};
  for (int row = 0; row < 30; ++row) {
    position.values.push_back(1.0 + row / 10);
    acc.values.push_back((row / 10 == 1 ? -1.0 : 0.02) + 1e-5 * row);
    inner.values.push_back((90.0 * (row / 10) + 0.1 * (row % 10)) * detail::deg);
    r.lines.push_back(static_cast<std::size_t>(row + 2));
  }
  r.channels = {position, acc, inner};
  return r;
}

std::size_t missing(const Recording& r, const char* name) {
  std::size_t count = 0;
  for (const double x : r.find(name)->values) count += std::isnan(x) ? 1 : 0;
  return count;
}

TEST(Fillers, ANumberThatComesBackFarFromItsNeighboursIsNotMeasured) {
  Recording r = resting();
  std::vector<std::string> remarks;
  for (const std::size_t row : {8, 9, 15, 29}) r.channels[2].values[row] = 999.999 * detail::deg;
  leave_out_fillers(r, remarks);
  EXPECT_EQ(missing(r, "gimbal_inner"), 4u);
  EXPECT_EQ(missing(r, "acc_x"), 0u);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(
      remarks[0],
      "log.csv: gimbal_inner reads 999.999 deg in 4 rows, the first in line 10, far from what "
      "is beside them: taken as not measured");
}

TEST(Fillers, ANumberThatAllThreeReadMayBeNearWhatTheyReadElsewhere) {
  Recording r = resting();
  Channel y{"acc_y", unit::g, std::vector<double>(30, 0.0)}, z = y;
  z.name = "acc_z";
  for (std::size_t row = 0; row < 30; ++row) {
    y.values[row] = 0.01 + 1e-5 * static_cast<double>(row);
    z.values[row] = row / 10 == 1 ? 0.02 : 1.0 - 1e-5 * static_cast<double>(row);
  }
  r.channels.push_back(y);
  r.channels.push_back(z);
  for (const std::size_t row : {9, 19, 29})
    for (const std::size_t c : {1, 3, 4}) r.channels[c].values[row] = 0.0;
  std::vector<std::string> remarks;
  leave_out_fillers(r, remarks);
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) EXPECT_EQ(missing(r, name), 3u) << name;
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("acc_x, acc_y and acc_z all read 0 g in 3 rows"), std::string::npos)
      << remarks[0];
}

/// A unit on a case, in one attitude; reads: three accelerometers, then three gyros.
Recording on_a_case() {
  Recording r;
  r.source = "log.csv";
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) r.channels.push_back({name, unit::g, {}});
  for (const char* name : {"gyro_x", "gyro_y", "gyro_z"})
    r.channels.push_back({name, *parse_unit("rad/s"), {}});
  for (int row = 0; row < 200; ++row) {
    const double noise = 1e-3 * std::sin(1.7 * row);
    for (const std::size_t c : {0, 1}) r.channels[c].values.push_back(0.01 + noise);
    r.channels[2].values.push_back(1.0 - noise);
    for (const std::size_t c : {3, 4, 5})
      r.channels[c].values.push_back(noise + 1e-4 * static_cast<double>(c));
    r.lines.push_back(static_cast<std::size_t>(row + 2));
  }
  return r;
}

TEST(Fillers, OnACaseNoSpecificForceIsZero) {
  Recording r = on_a_case();
  const std::vector<std::size_t> rows{20, 21, 90, 150};
  for (Channel& c : r.channels)
    for (const std::size_t row : rows) c.values[row] = 0.0;
  r.channels[4].values[150] = 0.2;
  std::vector<std::string> remarks;
  leave_out_fillers_on_a_case(r, remarks);
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) EXPECT_EQ(missing(r, name), 4u) << name;
  for (const char* name : {"gyro_x", "gyro_y", "gyro_z"}) EXPECT_EQ(missing(r, name), 3u) << name;
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0],
            "log.csv: acc_x, acc_y and acc_z all read 0 g in 4 rows, the first in line 22, far "
            "from what is beside them: taken as not measured, with gyro_x, gyro_y and gyro_z "
            "where they read alike, too");
}

TEST(Fillers, OnACaseTwoRowsAndCoarseCountsAndSmallForcesStay) {
  std::vector<std::string> remarks;
  Recording two = on_a_case();
  for (const std::size_t c : {0, 1, 2})
    for (const std::size_t row : {20, 90}) two.channels[c].values[row] = 0.0;
  leave_out_fillers_on_a_case(two, remarks);
  EXPECT_EQ(missing(two, "acc_z"), 0u);
  // A row holds a count or none.
  Recording counts = on_a_case();
  double sum = 0.0, counted = 0.0;
  for (double& force : counts.channels[2].values) {
    sum += force / 1.4;
    const double before = counted;
    counted = std::round(sum);
    force = 1.4 * (counted - before);
  }
  for (const std::size_t c : {0, 1})
    for (double& force : counts.channels[c].values) force = 0.0;
  leave_out_fillers_on_a_case(counts, remarks);
  EXPECT_EQ(missing(counts, "acc_z"), 0u);
  // Alike to the last digit, and no other than beside it.
  Recording alike = on_a_case();
  for (std::size_t row = 0; row < alike.rows(); ++row) {
    const double force = 0.577 + 1e-3 * std::sin(0.9 * static_cast<double>(row));
    for (const std::size_t c : {0, 1, 2}) alike.channels[c].values[row] = force;
  }
  leave_out_fillers_on_a_case(alike, remarks);
  EXPECT_EQ(missing(alike, "acc_z"), 0u);
  EXPECT_TRUE(remarks.empty()) << remarks.front();
}

TEST(Fillers, NoSpecificForceIsAlikeToTheLastDigitNorDoesATemperatureJump) {
  Recording r = resting();
  Channel y{"acc_y", unit::g, std::vector<double>(30, 0.3)},
      z = y, temperature{"temperature", "degC"_unit, std::vector<double>(30, 0.0)};
  z.name = "acc_z";
  for (std::size_t row = 0; row < 30; ++row) {
    r.channels[1].values[row] = 0.9 + 1e-5 * static_cast<double>(row);
    y.values[row] += 1e-5 * static_cast<double>(row);
    z.values[row] -= 1e-5 * static_cast<double>(row);
    temperature.values[row] = 21.0 + 0.01 * static_cast<double>(row);
  }
  r.channels.insert(r.channels.end(), {y, z, temperature});
  for (const std::size_t row : {12, 13, 17})
    for (const std::size_t c : {1, 3, 4}) r.channels[c].values[row] = 0.0;
  for (const std::size_t row : {0, 10, 11, 25}) r.channels[5].values[row] = 85.0;
  for (const std::size_t row : {4, 14, 24}) r.channels[5].values[row] += 9.0;
  std::vector<std::string> remarks;
  leave_out_fillers(r, remarks);
  for (const char* name : {"acc_x", "acc_y", "acc_z"}) EXPECT_EQ(missing(r, name), 3u) << name;
  EXPECT_EQ(missing(r, "temperature"), 4u);
}

TEST(Fillers, ANumberIsOneWhereverAFineReadoutHasItToTheLastDigit) {
  Recording r = resting();
  for (const std::size_t row : {2, 12, 13, 14, 22}) r.channels[1].values[row] = 0.0;  // acc_x
  for (const std::size_t row : {9, 19, 29}) r.channels[2].values[row] = -719.5 * detail::deg;
  std::vector<std::string> remarks;
  leave_out_fillers(r, remarks);
  EXPECT_EQ(missing(r, "acc_x"), 0u) << "of one position alone it is far from its neighbours";
  EXPECT_EQ(missing(r, "gimbal_inner"), 3u)
      << "0.5 deg less two turns is no reading, though 0.5 is";
  for (const std::size_t row : {24, 25, 26}) r.channels[1].values[row] = 0.5;
  for (const std::size_t row : {4, 15}) r.channels[1].values[row] = 0.5;
  leave_out_fillers(r, remarks);
  EXPECT_EQ(missing(r, "acc_x"), 5u);
}

TEST(Fillers, NoCovariateJumpsByAsMuchAsItUsuallyVaries) {
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k) {
      const double usual = c.usual * c.unit.to_si;
      const std::string name(c.column(k).view());
      Recording r = resting();
      r.channels.push_back({name, c.unit, {}});
      std::vector<double>& x = r.channels.back().values;
      for (int row = 0; row < 30; ++row) x.push_back(usual * (0.2 + 1e-3 * row));
      for (const std::size_t row : {3, 13, 23}) x[row] += 0.9 * usual;  // far, each another number
      for (const std::size_t row : {7, 17, 27}) x[row] = 1.1 * usual;   // 0.9 off: may be read
      std::vector<std::string> remarks;
      leave_out_fillers(r, remarks);
      EXPECT_EQ(missing(r, name.c_str()), 0u) << name;
      for (const std::size_t row : {0, 10, 11, 25}) r.channels.back().values[row] = 1.5 * usual;
      leave_out_fillers(r, remarks);
      EXPECT_EQ(missing(r, name.c_str()), 4u) << name;
      EXPECT_EQ(remarks.size(), 1u) << name;
    }
}

TEST(Fillers, WhatIsReadStays) {
  Recording r = resting();
  std::vector<std::string> remarks;
  leave_out_fillers(r, remarks);
  // A jump of a whole turn is none, a number of one position is an isolated one, and one that is
  // read elsewhere with neighbours as near is a reading.
  for (const std::size_t row : {3, 13, 23}) r.channels[2].values[row] += 360.0 * detail::deg;
  for (const std::size_t row : {4, 6, 8}) r.channels[1].values[row] = 7.0;
  for (const std::size_t row : {17, 27}) r.channels[2].values[row] = r.channels[2].values[5];
  leave_out_fillers(r, remarks);
  EXPECT_TRUE(remarks.empty()) << remarks.front();
  EXPECT_EQ(missing(r, "gimbal_inner") + missing(r, "acc_x"), 0u);
}

}  // namespace
}  // namespace drift::preparation::fillers_test
