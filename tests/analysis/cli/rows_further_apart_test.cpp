// Half of one position's rows lost, the other half evenly twice as far apart or not.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/support/program.hpp"

namespace drift::rows_further_apart_test {
namespace {

using test::driftscope, test::ScratchFolder;

constexpr const char* terms =
    "coupling = \"eq5\"\nterms = [\"fixed_drift\", \"g_drift\", \"gyro_misalignment\"]\n";

std::string study_of(const ScratchFolder& folder) {
  return folder.write("lab.toml", std::string("schema = 1\n[site]\nlatitude = \"45 deg\"\n[plan]\n"
                                              "preset = \"six\"\nmode = \"free\"\n"
                                              "dwell = \"20 min\"\nsample = \"1 min\"\n[truth]\n") +
                                      terms + "[[filter]]\nname = \"f\"\n" + terms);
}

enum class Lost { gone, empty };

/// The recording without these rows of its last position, from 1 on, or without their readings:
/// time, position and phase come first, then accelerometers and gimbals.
std::string without(const std::string& recording, const std::vector<int>& rows, Lost lost) {
  std::istringstream lines(recording);
  std::string out;
  int row = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(",6,0,") == std::string::npos || std::ranges::find(rows, ++row) == rows.end()) {
      out += line + "\n";
      continue;
    }
    if (lost == Lost::gone) continue;
    std::istringstream cells(line);
    std::string cell, emptied;
    for (int column = 0; std::getline(cells, cell, ','); ++column)
      emptied += (column > 0 ? "," : "") + (column >= 3 && column < 9 ? "" : cell);
    out += emptied + "\n";
  }
  return out;
}

struct Told {
  std::string told, verdict;
};

Told identified(const std::vector<int>& rows, Lost lost) {
  const ScratchFolder folder;
  const std::string study = study_of(folder), made = folder.file("made.csv");
  EXPECT_EQ(driftscope("simulate " + study + " -o " + made).code, 0);
  const std::string file = folder.write("r.csv", without(test::text_of(made), rows, lost));
  const auto a = driftscope("identify " + study + " " + file);
  EXPECT_EQ(a.code, 0) << a.err;
  return {a.err, a.out.substr(0, a.out.find(':'))};
}

const std::vector<int> every_other{1, 3, 5, 7, 9, 11, 13, 15, 17, 19},
    uneven{1, 3, 5, 7, 9, 10, 12, 13, 16, 18, 19};

TEST(RowsFurtherApart, EvenlyAreAskedAboutAndTheAdviceHelps) {
  const Told gone = identified(every_other, Lost::gone);
  EXPECT_NE(gone.told.find("rows of position 6 are 120 s apart where those of others are 60 s"),
            std::string::npos)
      << gone.told;
  const Told put_back = identified(every_other, Lost::empty);
  EXPECT_EQ(put_back.told.find("120 s apart"), std::string::npos) << put_back.told;
  EXPECT_EQ(put_back.verdict, "Fits");
}

TEST(RowsFurtherApart, UnevenlyAreLostRows) {
  const Told gone = identified(uneven, Lost::gone);
  EXPECT_NE(gone.told.find("rows are missing"), std::string::npos) << gone.told;
  EXPECT_EQ(gone.verdict, "Fits");
}

}  // namespace
}  // namespace drift::rows_further_apart_test
