// Every command of the README works as written.
#include <set>
#include <sstream>

#include "tests/support/program.hpp"

namespace drift::readme_test {
namespace {

using namespace drift::test;

constexpr const char* shared = "../shared";  // recordings of others, beside the project

/// The commands of the README, each once, in their order.
std::vector<std::string> commands() {
  std::istringstream readme(text_of(std::string(DRIFT_SOURCE_DIR) + "/README.md"));
  std::vector<std::string> found;
  std::set<std::string> seen;
  for (std::string line; std::getline(readme, line);) {
    const std::string start = "    ./driftscope ";
    if (!line.starts_with(start) || line.starts_with(start + "test")) continue;
    const std::string command = line.substr(start.size(), line.find('#') - start.size());
    if (seen.insert(command).second) found.push_back(command);
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

TEST(Readme, EveryCommandWorks) {
  Commands here;
  int run = 0;
  for (const std::string& command : commands()) {
    // The same diagnosis once more, with another ending: AdviceFollowed and the nightly test below.
    if (command.find("--advise") != std::string::npos) continue;
    here.run(cut(command));
    ++run;
  }
  EXPECT_GE(run, 8);
}

TEST(ReadmeNightly, EveryCommandWorksUncut) {
  Commands here;
  for (const std::string& command : commands()) here.run(command);
}

}  // namespace
}  // namespace drift::readme_test
