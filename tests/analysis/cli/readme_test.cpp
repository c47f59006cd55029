// Every command of the README works as written; long studies are cut to a few runs or trials.
#include <sstream>

#include "tests/support/program.hpp"

namespace drift {
namespace {

using namespace drift::test;

TEST(Readme, EveryCommandWorks) {
  const ScratchFolder folder;
  const std::filesystem::path source(DRIFT_SOURCE_DIR);
  std::filesystem::create_directory_symlink(source / "configs", folder.file("configs"));
  const bool recordings = std::filesystem::exists(source / "../shared/recordings/xsens_mti.csv");
  std::istringstream readme(text_of((source / "README.md").string()));
  int run = 0;
  for (std::string line; std::getline(readme, line);) {
    const std::string start = "    ./driftscope ";
    if (!line.starts_with(start) || line.starts_with(start + "test")) continue;
    std::string arguments = line.substr(start.size(), line.find('#') - start.size());
    if (const auto shared = arguments.find("../shared"); shared != std::string::npos) {
      if (!recordings) {
        std::printf("without ../shared/recordings: not run: %s\n", line.c_str());
        continue;
      }
      arguments.replace(shared, 9, (source / "../shared").string());
    }
    if (arguments.starts_with("run ") && arguments.find("--runs") == std::string::npos)
      arguments += " --runs 4";
    if (arguments.starts_with("blind configs/blind.toml")) arguments += " --trials 8";
    const std::string command = "export SLURM_ARRAY_TASK_ID=0; cd '" + folder.path() + "' && '" +
                                DRIFT_PROGRAM + "' " + arguments + " >out.txt 2>err.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << line << "\n" << text_of(folder.file("err.txt"));
    ++run;
  }
  EXPECT_GE(run, 8);
}

}  // namespace
}  // namespace drift
