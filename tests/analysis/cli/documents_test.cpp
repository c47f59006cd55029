// Every command of the README and the chapters works as written.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/program.hpp"

namespace drift::documents_test {
namespace {

using namespace drift::test;

constexpr const char* shared = "../shared";  // recordings of others, beside the project

/// The README, then the chapters by name.
std::vector<std::filesystem::path> documents() {
  const std::filesystem::path source(DRIFT_SOURCE_DIR);
  std::vector<std::filesystem::path> found;
  for (const char* part : {"core", "mc", "analysis"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / part))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::ranges::sort(found);
  found.insert(found.begin(), source / "README.md");
  return found;
}

/// Their commands, each once, in their order.
std::vector<std::string> commands() {
  std::vector<std::string> found;
  std::set<std::string> seen;
  for (const auto& document : documents()) {
    std::istringstream text(text_of(document.string()));
    for (std::string line; std::getline(text, line);) {
      const std::string start = "    ./driftscope ";
      if (!line.starts_with(start) || line.starts_with(start + "test")) continue;
      for (std::string more; line.ends_with('\\') && std::getline(text, more);) {
        line.pop_back();
        line += more.substr(more.find_first_not_of(' '));
      }
      std::string command = line.substr(start.size(), line.find('#') - start.size());
      command.resize(command.find_last_not_of(' ') + 1);
      if (seen.insert(command).second) found.push_back(command);
    }
  }
  return found;
}

/// Long studies become short ones: what a command does stays.
std::string cut(std::string command) {
  if (const auto runs = command.find(" --runs"); runs != std::string::npos) command.resize(runs);
  if (command.starts_with("run ")) command += " --runs 20";
  if (command.starts_with("blind ")) command += " --trials 2";
  return command;
}

class Commands {
 public:
  Commands() {
    std::filesystem::create_directory_symlink(source_ / "configs", folder_.file("configs"));
  }
  void run(std::string command) {
    if (const auto at = command.find(shared); at != std::string::npos) {
      if (!std::filesystem::exists(source_ / shared / "recordings/xsens_mti.csv")) {
        std::printf("without the recordings of others: not run: %s\n", command.c_str());
        return;
      }
      command.replace(at, std::string(shared).size(), (source_ / shared).string());
    }
    const std::string line = "export SLURM_ARRAY_TASK_ID=0; cd '" + folder_.path() + "' && '" +
                             DRIFT_PROGRAM + "' " + command + " >out.txt 2>err.txt";
    EXPECT_EQ(std::system(line.c_str()), 0) << command << "\n" << text_of(folder_.file("err.txt"));
  }

 private:
  const std::filesystem::path source_{DRIFT_SOURCE_DIR};
  const ScratchFolder folder_;
};

TEST(Documents, EveryCommandWorks) {
  Commands here;
  int run = 0;
  for (const std::string& command : commands()) {
    // The same once more with another ending, or with more of it: left to the nightly test below.
    if (command.find("--advise") != std::string::npos) continue;
    if (command.starts_with("blind configs/blind.toml")) continue;
    here.run(cut(command));
    ++run;
  }
  EXPECT_GE(run, 30);
}

/// Every registered test as "Suite.Name", parametrised ones also without prefix and parameter.
std::vector<std::string> registered_tests() {
  std::vector<std::string> all;
  const ::testing::UnitTest& unit = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *unit.GetTestSuite(s);
    const std::string name = suite.name();
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string test = suite.GetTestInfo(t)->name();
      all.push_back(name + "." + test);
      all.push_back(name.substr(name.find('/') + 1) + "." + test.substr(0, test.find('/')));
    }
  }
  return all;
}

TEST(Documents, TestsThatTheChaptersNameExist) {
  const std::vector<std::string> all = registered_tests();
  const std::regex named("`([A-Z][A-Za-z0-9]+[.*][A-Za-z0-9.*]*)`");
  int found = 0;
  for (const auto& document : documents()) {
    const std::string text = text_of(document.string());
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
      const std::string name = (*it)[1];
      const std::regex pattern(std::regex_replace(
          std::regex_replace(name, std::regex("\\."), "\\."), std::regex("\\*"), ".*"));
      EXPECT_TRUE(std::ranges::any_of(
          all, [&](const std::string& test) { return std::regex_match(test, pattern); }))
          << document.filename() << ": " << name;
      ++found;
    }
  }
  EXPECT_GE(found, 80);
}

TEST(Documents, FilesThatTheChaptersNameExist) {
  const std::filesystem::path source(DRIFT_SOURCE_DIR);
  const std::regex named("`([a-z_]+(/[a-z_0-9.]+)+\\.(hpp|cpp|py|sh|js|toml|md))`");
  int found = 0;
  for (const auto& document : documents()) {
    const std::string text = text_of(document.string());
    const auto part = source / *document.lexically_relative(source).begin();
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
      const std::string name = (*it)[1];
      const std::string folder = name.substr(0, name.find('/'));
      if (folder == "out" || folder == "trials" || folder == "share") continue;  // what is made
      EXPECT_TRUE(std::filesystem::exists(source / name) || std::filesystem::exists(part / name))
          << document.filename() << ": " << name;
      ++found;
    }
  }
  EXPECT_GE(found, 50);
}

TEST(DocumentsNightly, EveryCommandWorksUncut) {
  Commands here;
  for (const std::string& command : commands()) here.run(command);
}

}  // namespace
}  // namespace drift::documents_test
