// Rows between two positions that have no number of one.
#include "core/recording/rows/turned_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/recording/own/guess.hpp"
#include "recording_fixture.hpp"

namespace drift::turned_rows_test {
namespace {

using namespace test;

/// Rows of these positions, and how fast they are commanded [rad/s]; times are those of the rows.
Recording rows(const std::vector<double>& positions, const std::vector<double>& commands = {}) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, positions}};
  for (std::size_t k = 0; k < positions.size(); ++k) {
    r.channels[0].values.push_back(static_cast<double>(k + 1));
    r.lines.push_back(k + 2);
  }
  if (!commands.empty())
    for (const char* name : {"cmd_x", "cmd_y", "cmd_z"}) {
      r.channels.push_back({name, unit::deg_per_h, commands});
      if (r.channels.back().name != "cmd_x") r.channels.back().values.assign(commands.size(), 0.0);
    }
  return r;
}

TEST(TurnedRows, AreLeftOutWhereNoCommandTurnsIt) {
  for (const double none : {0.0, -1.0, nan_value}) {
    Recording r = rows({none, 1, 1, 1, 1, none, none, 2, 2, 2, 2, none});
    take_turned_rows(r);
    EXPECT_EQ(r.find("position")->values, (std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2})) << none;
    EXPECT_EQ(r.find("time")->values, (std::vector<double>{2, 3, 4, 5, 8, 9, 10, 11}));
    EXPECT_EQ(r.lines, (std::vector<std::size_t>{3, 4, 5, 6, 9, 10, 11, 12}));
    const std::string said = testing::PrintToString(r.remarks.texts());
    EXPECT_NE(said.find("4 rows in which no command turns it are left out"), std::string::npos)
        << said;
  }
}

TEST(TurnedRows, BeforeAndBehindAllPositionsAreLeftOutWhereNoNumberStandsThere) {
  Recording r = rows({nan_value, nan_value, 1, 1, 1, 1, 2, 2, 2, 2, nan_value});
  take_turned_rows(r);
  EXPECT_EQ(r.find("position")->values, (std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2}));
  Recording none = rows({nan_value, nan_value});
  take_turned_rows(none);
  EXPECT_EQ(none.rows(), 2u);
}

TEST(TurnedRows, AreTheWayToTheNextPositionWhereACommandDoes) {
  Recording r = rows({1, 1, 1, 1, 0, 0, 0, 0, 2, 2, 2, 2}, {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0});
  take_turned_rows(r);
  EXPECT_EQ(r.find("position")->values, (std::vector<double>{1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2}));
  ASSERT_NE(r.find("phase"), nullptr);
  EXPECT_EQ(r.find("phase")->values, (std::vector<double>{0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0}));
  const std::string said = testing::PrintToString(r.remarks.texts());
  EXPECT_NE(said.find("4 rows are taken as the way to the next"), std::string::npos) << said;
  EXPECT_EQ(said.find("left out"), std::string::npos) << said;
}

TEST(TurnedRows, OtherRowsWithoutANumberStay) {
  const std::vector<std::vector<double>> all = {
      {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2},                          // counted from 0
      {1, 1, 1, 1, nan_value, 1, 1, 1, 1, 0, 2, 2, 2, 2},            // lost within a position
      {1, nan_value, nan_value, nan_value, 2, nan_value, nan_value}  // written where it changes
  };
  for (const std::vector<double>& positions : all) {
    Recording r = rows(positions);
    take_turned_rows(r);
    EXPECT_EQ(r.rows(), positions.size());
    EXPECT_TRUE(r.remarks.empty());
  }
}

TEST(TurnedRows, OfAFileAreReadAndSaid) {
  const Folder folder;
  std::string text = "time [s],position,acc_x [g],acc_y [g],acc_z [g]\n";
  for (int row = 0; row < 15; ++row)
    text += fmt::format("{},{},0,0,1\n", row + 1, row < 5 ? "1" : row < 10 ? "turn" : "2");
  const std::string path = folder.write("own.csv", text);
  const Recording r =
      read_recording(path, guess_file(path).format, RecordingKind::platform, gravity);
  EXPECT_EQ(r.rows(), 10u);
  EXPECT_EQ(r.find("position")->values.back(), 2.0);
}

/// The column of positions of a guessed file with these cells, as it is read.
std::vector<double> positions_read(const std::vector<std::string>& cells) {
  const Folder folder;
  std::string text = "time [s],position,acc_x [g],acc_y [g],acc_z [g]\n";
  for (std::size_t row = 0; row < cells.size(); ++row)
    text += fmt::format("{},{},0,0,1\n", row + 1, cells[row]);
  const std::string path = folder.write("own.csv", text);
  return read_recording(path, guess_file(path).format, RecordingKind::platform, gravity)
      .find("position")
      ->values;
}

TEST(TurnedRows, ATextBeforeTheFirstPositionIsARemark) {
  const std::vector<double> expected = {1, 1, 1, 1, 2, 2, 2, 2};
  EXPECT_EQ(positions_read({"ready", "1", "1", "1", "1", "2", "2", "2", "2"}), expected);
  EXPECT_EQ(positions_read({"ready", "10", "10", "10", "10", "20", "20", "20", "20"}), expected);
  EXPECT_EQ(positions_read({"ready", "up", "up", "up", "up", "N", "N", "N", "N"}), expected);
  EXPECT_EQ(positions_read({"up", "up", "up", "up", "N", "N", "N", "N"}), expected);
  EXPECT_EQ(positions_read({"up", "N", "W", "W", "W", "W"}),
            (std::vector<double>{1, 2, 3, 3, 3, 3}))
      << "positions of a row each";
}

}  // namespace
}  // namespace drift::turned_rows_test
