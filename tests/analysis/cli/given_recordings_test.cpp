// What the commands make of recordings that are not what their names say.
#include <sstream>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::given_recordings_test {
namespace {

using namespace drift::test;

TEST(GivenRecordings, TheSameReadingsInAnotherFileAreNoFurtherEvidence) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), one = folder.file("one.csv"),
                    other = folder.file("other.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + one).code, 0);
  ASSERT_EQ(driftscope("simulate " + study + " --seed 77 -o " + other).code, 0);
  const std::string again = folder.write("again.csv", "# copied\n" + text_of(one));
  EXPECT_EQ(driftscope("identify " + study + " " + one + " " + other + " --quiet").code, 0);
  const Answer a = driftscope("identify " + study + " " + one + " " + again + " --quiet");
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage));
  EXPECT_NE(a.err.find("has the same readings as"), std::string::npos) << a.err;
}

/// A recording with its accelerations in m/s^2, of eight digits.
std::string in_si(const std::string& recording) {
  std::istringstream lines(recording);
  std::vector<std::string> names;
  std::string out;
  for (std::string line; std::getline(lines, line); out += "\n") {
    std::istringstream cells(line);
    std::size_t column = 0;
    if (line.starts_with("#")) continue;
    const bool header = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (header) names.push_back(cell);
      if (names.at(column).starts_with("acc_"))
        cell = header ? cell.substr(0, 5) + " [m/s^2]"
                      : fmt::format("{:.8g}", std::stod(cell) * 9.80665);
      out += (column > 0 ? "," : "") + cell;
    }
  }
  return out;
}

TEST(GivenRecordings, TheSameReadingsInAnotherUnitAreNoneEither) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), one = folder.file("one.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + one).code, 0);
  const std::string again = folder.write("again.csv", in_si(text_of(one)));
  const Answer alone = driftscope("identify " + study + " " + again + " --quiet");
  EXPECT_EQ(alone.code, 0) << alone.err;
  const Answer a = driftscope("identify " + study + " " + one + " " + again + " --quiet");
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage));
  EXPECT_NE(a.err.find("has the same readings as"), std::string::npos) << a.err;
}

TEST(GivenRecordings, ALogThatWasCutTwiceIsRefusedWithTheRowsThatStandInBoth) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), one = folder.file("one.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + one).code, 0);
  std::string shorter = text_of(one);
  shorter.erase(shorter.rfind('\n', shorter.size() - 2) + 1);
  const std::string cut = folder.write("cut.csv", shorter);
  for (const std::string& files : {one + " " + cut, cut + " " + one}) {
    const Answer a = driftscope("identify " + study + " " + files + " --quiet");
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage));
    EXPECT_NE(a.err.find("(positions 1 to 6, from 60 s on) hold the readings of " +
                         files.substr(0, files.find(' ')) + ": lines"),
              std::string::npos)
        << a.err;
    EXPECT_NE(a.err.find("cut these rows out of one"), std::string::npos) << a.err;
  }
}

/// The log at twice the interval: means of accelerometers, angles at the end.
std::string means_of_two(const std::string& recording) {
  std::istringstream lines(recording);
  std::string out, names;
  std::vector<std::string> before;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    if (names.empty()) {
      out = (names = line) + "\n";
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line), header(names);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (before.empty()) {
      before = cells;
      continue;
    }
    std::string name;
    for (std::size_t c = 0; c < cells.size() && std::getline(header, name, ','); ++c)
      out += (c > 0 ? "," : "") +
             (name.starts_with("acc_")
                  ? fmt::format("{}", 0.5 * (std::stod(before[c]) + std::stod(cells[c])))
                  : cells[c]);
    out += "\n";
    before.clear();
  }
  return out;
}

TEST(GivenRecordings, ALogAndTheMeansThatWereExportedOfItAreOne) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), log = folder.file("log.csv"),
                    other = folder.file("other.csv");
  const std::string simulate = "simulate " + study + " --set plan.sample='30 s' -o ";
  ASSERT_EQ(driftscope(simulate + log).code, 0);
  ASSERT_EQ(driftscope(simulate + other + " --seed 77").code, 0);
  const std::string means = folder.write("means.csv", means_of_two(text_of(log)));
  for (const std::string& files : {log + " " + means, means + " " + log}) {
    const Answer a = driftscope("identify " + study + " " + files + " --quiet");
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage)) << a.err;
    EXPECT_NE(a.err.find("its noise is that of " + files.substr(0, files.find(' '))),
              std::string::npos)
        << a.err;
  }
  const Answer a = driftscope("identify " + study + " " + other + " " + means + " --quiet");
  EXPECT_EQ(a.code, 0) << a.err;
}

TEST(GivenRecordings, AreNoSimulatedOneThatHasANumber) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), one = folder.file("one.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + one).code, 0);
  for (const std::string number : {"0", "3"}) {
    const Answer a = driftscope("identify " + study + " " + one + " --run " + number);
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::usage));
    EXPECT_NE(a.err.find("--run: recordings are given"), std::string::npos) << a.err;
    EXPECT_EQ(driftscope("identify " + study + " --quiet --run " + number).code, 0);
  }
}

TEST(GivenRecordings, OfACaseThatStoodAtFortyFiveDegreesNewSaysBoth) {
  const ScratchFolder folder;
  const std::string study = folder.write("made.toml", short_study), made = folder.file("made.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + made).code, 0);
  std::istringstream lines(text_of(made));
  std::string log;
  for (std::string line; std::getline(lines, line);)  // without its last column, the case's heading
    log += (line.front() == '#' ? line : line.substr(0, line.rfind(','))) + "\n";
  const Answer a = driftscope("new diagnose " + folder.write("log.csv", log) + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("half way between two directions"), std::string::npos) << a.out;
  const std::string text = text_of(file);
  EXPECT_NE(text.find("# or, of a case at 45 deg: axes = \"x="), std::string::npos) << text;
  const Answer recorded = driftscope("new diagnose " + made + " -o " + folder.file("b.toml"));
  EXPECT_EQ(recorded.out.find("half way"), std::string::npos) << recorded.out;
}

}  // namespace
}  // namespace drift::given_recordings_test
