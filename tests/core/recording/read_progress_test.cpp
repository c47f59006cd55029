// Of a large text file the part that is read is told while it is read.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"
#include "tests/support/program.hpp"

namespace drift::read_progress_test {
namespace {

TEST(ReadProgress, GrowsWithWhatIsRead) {
  std::string text = "time [s],position,acc_x [g],acc_y [g],acc_z [g]\n";
  for (int k = 1; k <= 50000; ++k)
    text += std::to_string(k) + ",1," + (k % 2 == 0 ? "1.000001" : "1.000000") + ",0,0\n";
  const test::ScratchFolder folder;
  const std::string path = folder.write("log.csv", text);
  std::vector<double> parts;
  const Recording r = read_recording(path, RecordingFormat{}, RecordingKind::platform, 9.81,
                                     [&](double part) { parts.push_back(part); });
  EXPECT_EQ(r.rows(), 50000u);
  ASSERT_EQ(parts.size(), 2u);  // every 20,000 lines of 50,001
  EXPECT_NEAR(parts[0], 0.4, 0.02);
  EXPECT_NEAR(parts[1], 0.8, 0.02);
}

}  // namespace
}  // namespace drift::read_progress_test
