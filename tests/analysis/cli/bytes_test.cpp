// Names as they come: not UTF-8, too long, leading nowhere; and terminals that are not steered.
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "core/base/utf8.hpp"
#include "tests/support/program.hpp"

namespace drift::bytes_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

TEST(Bytes, NamesThatAreNotUtf8AreNamesLikeOthers) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("K\xf6ln.toml", cheap_study()),
                    out = scratch.file("M\xfcnchen");
  for (const std::string& line :
       {"run " + study + " --runs 64 -o " + out + "1", "status " + out + "1", "verify " + out + "1",
        "replay " + out + "1 --run 3", "report " + out + "1", "export " + out + "1 --format hdf5",
        "export " + out + "1 --format json",
        "simulate " + study + " -o " + scratch.file("r\xe9.csv"),
        "identify " + study + " " + scratch.file("r\xe9.csv") + " -o " + out + "2",
        "rank " + study + " -o " + out + "3", "check " + study}) {
    const Answer a = driftscope(line);
    EXPECT_EQ(a.code, 0) << line << "\n" << a.err;
    EXPECT_TRUE(valid_utf8(a.out) && valid_utf8(a.err)) << line;
  }
  for (const std::string file : {"1/manifest.json", "1/summary.json", "1/export.json",
                                 "2/identification.json", "3/rank.json"}) {
    const std::string text = text_of(out + file);
    EXPECT_TRUE(valid_utf8(text)) << file;
    EXPECT_TRUE(nlohmann::json::accept(text)) << file;
  }
}

TEST(Bytes, ALineEndInANameEndsNoLine) {
  const ScratchFolder scratch;
  const std::string name = scratch.file("a\nerror: all is lost\tb");
  fs::create_directory(name);
  std::ofstream(name + "/s.toml") << cheap_study() << "bogus = 1\n";
  std::ofstream(name + "/c\nd.csv") << "mine";
  for (const std::string& line :
       {"check '" + name + "/s.toml'", "status '" + name + "'", "look '" + name + ".csv'",
        "run " + test::config("cheap.toml") + " --runs 64 -o '" + name + "'",
        "check x.toml --set='" + name + "'"}) {
    const Answer a = driftscope(line);
    EXPECT_NE(a.code, 0) << line;
    EXPECT_NE(a.err.find("a\\x0aerror: all is lost\\x09b"), std::string::npos) << a.err;
    EXPECT_EQ(a.err.find("\nerror: all is lost"), std::string::npos) << a.err;
    EXPECT_EQ(a.err.find("c\nd.csv"), std::string::npos) << a.err;
  }
}

TEST(Bytes, ALineEndInANameOfAStudyEndsNoLine) {
  const ScratchFolder scratch;
  std::string text = cheap_study();
  text.replace(text.find("z up"), 4, "z\\nerror: all is lost");
  const Answer a = driftscope("check " + scratch.write("s.toml", text));
  EXPECT_EQ(a.code, config_error);
  EXPECT_NE(a.err.find("z\\x0aerror: all is lost"), std::string::npos) << a.err;
  EXPECT_EQ(a.err.find("\nerror: all is lost"), std::string::npos) << a.err;
}

TEST(Bytes, NoNameSteersTheTerminal) {
  const ScratchFolder scratch;
  std::string text = cheap_study();
  text.replace(text.find("[[filter]]"), 10, "[[filter]]\n\"a\\u001b[31m\\u0007\" = 1");
  const std::string title = "title  = \"";
  text.insert(text.find(title) + title.size(), "\\u001b]0;owned\\u0007");
  const std::string wrong = scratch.write("s\x1b[2J.toml", text);
  const Answer a = driftscope("check '" + wrong + "'");
  EXPECT_EQ(a.code, config_error);
  const Answer missing = driftscope("identify '" + scratch.file("a\x1b\nb.toml") + "' --bo\x1bgus");
  const Answer other = driftscope("check '" + scratch.file("a\x1b\nb.toml") + "'");
  text.erase(text.find("\"a\\u001b"), std::string("\"a\\u001b[31m\\u0007\" = 1").size());
  const Answer titled = driftscope("identify '" + scratch.write("t.toml", text) + "'");
  EXPECT_EQ(titled.code, config_error) << "a title is one line";
  for (const std::string& said : {a.err, missing.err, other.err, titled.err}) {
    EXPECT_FALSE(said.empty());
    EXPECT_EQ(said.find_first_of("\x1b\x07\r"), std::string::npos) << said;
  }
  EXPECT_NE(a.err.find("a\\x1b[31m"), std::string::npos) << a.err;
}

TEST(Bytes, AnEndlessNameIsNotEchoedWhole) {
  const ScratchFolder scratch;
  std::string text = cheap_study();
  text.insert(text.find("[[filter]]") + 10, "\n" + std::string(100000, 'k') + " = 1");
  const Answer a = driftscope("check " + scratch.write("s.toml", text));
  EXPECT_EQ(a.code, config_error);
  EXPECT_LT(a.err.size(), 5000u);
  EXPECT_NE(a.err.find("expected"), std::string::npos) << "what to do is still said";
}

TEST(Bytes, WhatAFileSystemRefusesIsToldAsThat) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  fs::create_symlink("loop", scratch.file("loop"));
  for (const auto& [name, reason] :
       {std::pair<std::string, std::string>{std::string(300, 'n'), "File name too long"},
        {"loop/out", "Too many levels of symbolic links"},
        {"s.toml/out", "Not a directory"}}) {
    const std::string path = scratch.file(name);
    for (const std::string& line :
         {"run " + study + " --runs 64 -o " + path, "identify " + study + " -o " + path,
          "rank " + study + " -o " + path, "simulate " + study + " -o " + path + ".csv",
          "blind " + test::config("blind_small.toml") + " -o " + path}) {
      const Answer a = driftscope(line);
      EXPECT_EQ(a.code, io_error) << line << a.err;
      EXPECT_NE(a.err.find(reason), std::string::npos) << line << a.err;
      EXPECT_EQ(a.err.find("standard output"), std::string::npos) << a.err;
      EXPECT_EQ(a.out, "") << "nothing is computed first";
    }
  }
}

TEST(Bytes, AFolderTooDeepForSqliteIsSaidToBe) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  const std::string part = "/" + std::string(200, 'd');
  const Answer a =
      driftscope("run " + study + " --runs 64 -o " + scratch.path() + part + part + part);
  EXPECT_EQ(a.code, io_error);
  EXPECT_NE(a.err.find("the path is too long for SQLite"), std::string::npos) << a.err;
}

TEST(Bytes, StandardErrorThatIsFullStopsNothing) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  const auto code = [&](const std::string& line) {
    return WEXITSTATUS(std::system(("'" DRIFT_PROGRAM "' " + line + " >/dev/null").c_str()));
  };
  EXPECT_EQ(code("run " + study + " --runs 640 --progress json -o " + scratch.file("out") +
                 " 2>/dev/full"),
            0);
  EXPECT_EQ(code("identify " + study + " --progress json 2>/dev/full"), 0);
  EXPECT_EQ(code("verify " + scratch.file("out")), 0);
}

}  // namespace
}  // namespace drift::bytes_test
