// The scripts of `driftscope completion`, run by the shells that are here.
#include "tests/support/program.hpp"

namespace drift::completion_test {
namespace {

using namespace drift::test;

/// The script for bash, made once: the program asks its reader about every key.
const std::string& bash_script() {
  static const std::string script = driftscope("completion bash").out;
  return script;
}

/// What bash offers for the last of these words, one a line.
std::string offered(const std::string& words) {
  const ScratchFolder folder;
  const std::string file =
      folder.write("try.sh", bash_script() + "COMP_WORDS=(" + words +
                                 ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_driftscope\n"
                                 "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const Answer answer = run_program("/bin/bash", "--norc " + file);
  EXPECT_EQ(answer.code, 0) << answer.err;
  return answer.out;
}

TEST(Completion, TheBashScriptIsValid) {
  const ScratchFolder folder;
  const std::string script = folder.write("c.bash", bash_script());
  const Answer answer = run_program("/bin/bash", "-n " + script);
  EXPECT_EQ(answer.code, 0) << answer.err;
}

TEST(Completion, BashCompletesCommandsOptionsValuesAndKeys) {
  EXPECT_EQ(offered("driftscope ident"), "identify\n");
  EXPECT_EQ(offered("driftscope help ver"), "verify\nversion\n");
  EXPECT_EQ(offered("driftscope rank --imp"), "--improve\n");
  EXPECT_EQ(offered("driftscope run --progress p"), "plain\n");
  EXPECT_EQ(offered("driftscope run s.toml --set plan.dw"), "plan.dwell=\n");
  EXPECT_EQ(offered("driftscope check s.toml --set truth.parameters.D_F_x"),
            "truth.parameters.D_F_x=\n");
  EXPECT_EQ(offered("driftscope terms gyro_mis"), "gyro_misalignment\n");
  EXPECT_EQ(offered("driftscope --color always ident"), "identify\n");
  EXPECT_EQ(offered("driftscope --threads 2 ident"), "identify\n");
}

TEST(Completion, FilesAreLeftToTheShell) {
  EXPECT_EQ(offered("driftscope identify s.t"), "\n");
  EXPECT_EQ(offered("driftscope identify -o x"), "\n");
}

TEST(Completion, OtherShellsTakeTheirScripts) {
  const ScratchFolder folder;
  for (const std::string shell : {"zsh", "fish"}) {
    const Answer answer = driftscope("completion " + shell);
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("identify"), std::string::npos);
    if (std::system(("command -v " + shell + " >/dev/null").c_str()) != 0) continue;
    EXPECT_EQ(run_program(shell, "-n " + folder.write(shell, answer.out)).code, 0) << shell;
  }
  EXPECT_EQ(driftscope("completion tcsh").code, 2);
}

}  // namespace
}  // namespace drift::completion_test
