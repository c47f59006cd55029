// Nothing of the user's is ever replaced: inputs, files of others, what was changed since, and what
// links lead to.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::nothing_replaced_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

/// Every file below a folder with its content; a link as where it leads.
std::map<std::string, std::string> snapshot(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_symlink())
      files[entry.path().string()] = "-> " + fs::read_symlink(entry.path()).string();
    else if (entry.is_regular_file())
      files[entry.path().string()] = text_of(entry.path().string());
  return files;
}

/// A run of the program that refuses, says `part`, computes and changes nothing.
void expect_refused(const ScratchFolder& scratch, const std::string& line, int code,
                    const std::string& part) {
  const auto before = snapshot(scratch.path());
  const Answer a = run_program(
      "/bin/bash", "-c \"cd '" + scratch.path() + "'; '" DRIFT_PROGRAM "' " + line + "\"");
  EXPECT_EQ(a.code, code) << line << "\n" << a.err;
  EXPECT_NE(a.err.find(part), std::string::npos) << line << "\n" << a.err;
  EXPECT_EQ(a.out, "") << line << ": something was computed";
  EXPECT_EQ(snapshot(scratch.path()), before) << line;
}

/// A folder with a study and its recording, made by the program and annotated by its owner.
struct Desk : ScratchFolder {
  Desk() {
    fs::create_directory(file("v"));
    write("v/study.toml", "# my study\n" + cheap_study());
    EXPECT_EQ(
        driftscope("simulate " + file("v/study.toml") + " -o " + file("v/recording.csv")).code, 0);
    write("v/recording.csv", text_of(file("v/recording.csv")) + "# lab note\n");
  }
};

TEST(NothingReplaced, InputsAreNeverOutputs) {
  const Desk desk;
  desk.write("v/report.html", "mine");
  for (const char* command : {"identify", "diagnose"}) {
    const std::string line = std::string(command) + " v/study.toml v/recording.csv -o ";
    expect_refused(desk, line + "v", usage_error, "is an input of this command");
    expect_refused(desk, line + "./v/../v/", usage_error, "is an input of this command");
    expect_refused(desk, line + desk.file("v"), usage_error, "is an input of this command");
  }
  expect_refused(desk, "rank v/study.toml -o v", usage_error, "study.toml in it is an input");
  expect_refused(desk, "simulate v/study.toml -o v/study.toml", usage_error, "is an input");
}

TEST(NothingReplaced, InputsAreKnownThroughLinks) {
  const Desk desk;
  fs::create_symlink("v", desk.file("alias"));
  fs::create_symlink("v/recording.csv", desk.file("soft.csv"));
  fs::create_hard_link(desk.file("v/recording.csv"), desk.file("hard.csv"));
  fs::create_hard_link(desk.file("v/study.toml"), desk.file("hard.toml"));
  fs::create_directory(desk.file("own"));
  fs::rename(desk.file("v/study.toml"), desk.file("own/study.toml"));
  expect_refused(desk, "identify own/study.toml v/recording.csv -o alias", usage_error,
                 "recording.csv in it is an input");
  expect_refused(desk, "identify own/study.toml soft.csv -o v", usage_error,
                 "recording.csv in it is an input");
  expect_refused(desk, "identify own/study.toml hard.csv -o v", usage_error,
                 "recording.csv in it is an input");
  expect_refused(desk, "rank hard.toml -o own", usage_error, "study.toml in it is an input");
  expect_refused(desk, "simulate own/study.toml -o hard.toml", usage_error, "is an input");
}

TEST(NothingReplaced, AFolderOfSomebodyElseIsRefusedBeforeAnythingIsComputed) {
  for (const char* name : {"report.html", "summary.json", "study.toml", "manifest.json",
                           "recording.csv", "worker-0000.lock", "worker-0000.sqlite"}) {
    const ScratchFolder scratch;
    scratch.write("s.toml", cheap_study());
    scratch.write("b.toml", text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/blind_small.toml"));
    fs::create_directory(scratch.file("out"));
    scratch.write(std::string("out/") + name, "{\"mine\": true}");
    for (const char* line : {"run s.toml --runs 64 -o out", "identify s.toml -o out",
                             "rank s.toml -o out", "blind b.toml --trials 1 -o out"})
      expect_refused(scratch, line, store_error,
                     std::string("out: holds ") + name + ", which driftscope did not write");
  }
}

TEST(NothingReplaced, LogsAndNotesDoNotStandInTheWay) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out");
  fs::create_directory(out);
  for (const char* name : {"out/slurm-17.out", "out/notes.txt", "out/.hidden"})
    scratch.write(name, "mine");
  EXPECT_EQ(driftscope("run " + study + " --runs 64 -o " + out).code, 0);
  for (const char* name : {"out/slurm-17.out", "out/notes.txt", "out/.hidden"})
    EXPECT_EQ(text_of(scratch.file(name)), "mine");
}

TEST(NothingReplaced, LinksInAFolderLeadNothingOut) {
  const ScratchFolder scratch;
  scratch.write("s.toml", cheap_study());
  for (const char* name :
       {"report.html", "worker-0000.lock", "worker-0000.sqlite", "study.toml", "manifest.json"}) {
    for (const char* target : {"../precious.txt", "../to_be.txt"}) {
      fs::remove_all(scratch.file("out"));
      fs::create_directory(scratch.file("out"));
      scratch.write("precious.txt", "precious");
      fs::create_symlink(target, scratch.file(std::string("out/") + name));
      expect_refused(scratch, "run s.toml --runs 64 -o out", store_error, name);
    }
  }
}

TEST(NothingReplaced, LinksThatCameLaterLeadNothingOut) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  scratch.write("precious.txt", "precious");
  for (const char* name : {"report.html", "worker-0000.lock", "worker-0000.sqlite", "study.toml",
                           "manifest.json", "summary.json"}) {
    fs::remove_all(scratch.file("out"));
    ASSERT_EQ(driftscope("run " + study + " --runs 64 -o " + scratch.file("out")).code, 0);
    const std::string path = scratch.file(std::string("out/") + name);
    fs::rename(path, scratch.file("moved"));
    fs::create_symlink("../moved", path);
    expect_refused(scratch, "run s.toml --runs 128 -o out", store_error,
                   std::string(name) + ": is a symbolic link");
    fs::remove(scratch.file("moved"));
  }
}

TEST(NothingReplaced, OnlyWhatDriftscopeWroteAndNobodyChangedIsReplaced) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out");
  const std::string line = "identify " + study + " -o " + out;
  ASSERT_EQ(driftscope(line).code, 0);
  const std::string first = text_of(out + "/report.html");
  EXPECT_EQ(driftscope(line + " --seed 2").code, 0) << "its own results are replaced";
  EXPECT_NE(text_of(out + "/report.html"), first);
  scratch.write("out/notes.toml", "mine");
  EXPECT_EQ(driftscope(line).code, 0) << "a name that is not written does not matter";
  EXPECT_EQ(text_of(out + "/notes.toml"), "mine");
  scratch.write("out/report.html", first + "<!-- my remark -->");
  expect_refused(scratch, "identify s.toml -o out", store_error,
                 "report.html changed since driftscope wrote it");
  fs::remove(out + "/report.html");
  EXPECT_EQ(driftscope(line).code, 0);
}

TEST(NothingReplaced, AForeignFileAmongOwnResultsStaysWhenItsNameIsFirstWritten) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out");
  ASSERT_EQ(driftscope("rank " + study + " -o " + out).code, 0);
  scratch.write("out/proposed_positions.toml", "mine");
  const std::string report = text_of(out + "/rank.json");
  const Answer a = driftscope("rank " + study + " --improve 1 --progress none -o " + out);
  EXPECT_EQ(a.code, store_error);
  EXPECT_NE(a.err.find("proposed_positions.toml: is there already"), std::string::npos) << a.err;
  EXPECT_EQ(text_of(out + "/proposed_positions.toml"), "mine");
  EXPECT_EQ(text_of(out + "/rank.json"), report) << "all or nothing is written";
}

TEST(NothingReplaced, ARecordingIsWrittenOverSimulatedOnesAlone) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  for (const std::string name : {"r.csv", "r.h5", "r.mat"}) {
    const std::string line = "simulate " + study + " -o " + scratch.file(name);
    ASSERT_EQ(driftscope(line).code, 0);
    const std::string first = text_of(scratch.file(name));
    const Answer again = driftscope(line + " --run 1");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(text_of(scratch.file(name)), first);
    scratch.write(name, "my thesis");
    expect_refused(scratch, "simulate s.toml -o " + name, store_error,
                   name + ": is there already, and is no recording that driftscope made");
    scratch.write(name, "");
    EXPECT_EQ(driftscope(line).code, 0) << "an empty file holds nothing to lose";
    fs::create_symlink(name, scratch.file("link_" + name));
    expect_refused(scratch, "simulate s.toml -o link_" + name, io_error, "it is a symbolic link");
    // A recording of the laboratory in the program's columns is not to be had again by simulating.
    const std::string lab = scratch.file("lab_" + name);
    EXPECT_EQ(driftscope("convert " + study + " " + scratch.file(name) + " -o " + lab).code, 0);
    expect_refused(scratch, "simulate s.toml -o lab_" + name, store_error, "converted from ");
    expect_refused(scratch, "convert s.toml " + name + " -o lab_" + name, store_error,
                   "converted from ");  // another spelling may be another file
    const Answer converted =
        driftscope("convert " + study + " " + scratch.file(name) + " -o " + lab);
    EXPECT_EQ(converted.code, 0) << converted.err;
    expect_refused(scratch, "convert s.toml lab_" + name + " -o " + name, store_error,
                   "no recording that was converted");
  }
}

/// The text with a digit of its last number another one.
std::string with_another_digit(std::string text) {
  const std::size_t at = text.find_last_of("0123456789");
  text[at] = text[at] == '1' ? '2' : '1';
  return text;
}

TEST(NothingReplaced, ARecordingThatWasEditedStays) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  for (const std::string name : {"r.csv", "r.h5", "r.mat"}) {
    ASSERT_EQ(driftscope("simulate " + study + " -o " + scratch.file(name)).code, 0);
    const std::string made = text_of(scratch.file(name));
    const std::size_t place = name == "r.csv" ? made.rfind("9") : made.size() / 2;
    std::string other = made;
    other[place] = other[place] == '1' ? '2' : '1';
    for (const std::string& text : {made + "# lab note\n", other}) {
      scratch.write(name, text);
      // A binary file may be damaged by it so that it is not known at all any more.
      const bool known = name == "r.csv" || (name == "r.h5" && text.size() > made.size());
      expect_refused(scratch, "simulate s.toml -o " + name, store_error,
                     known ? "changed since driftscope made it" : "is there already, and is");
    }
    scratch.write(name, made);
    EXPECT_EQ(driftscope("simulate " + study + " -o " + scratch.file(name)).code, 0);
    EXPECT_EQ(text_of(scratch.file(name)), made) << "the same again, byte for byte";
    EXPECT_EQ(driftscope("look " + scratch.file(name)).code, 0) << "and it is read";
  }
}

TEST(NothingReplaced, AnExportThatWasEditedStays) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out");
  ASSERT_EQ(driftscope("run " + study + " --runs 64 -o " + out).code, 0);
  const std::pair<const char*, const char*> formats[] = {
      {"csv", "csv"}, {"json", "json"}, {"hdf5", "h5"}, {"netcdf", "nc"}};
  for (const auto& [format, ending] : formats) {
    const std::string line = std::string("export out --format ") + format,
                      full = "export " + out + " --format " + format,
                      name = std::string("out/export.") + ending;
    ASSERT_EQ(driftscope(full).code, 0);
    const std::string made = text_of(scratch.file(name));
    EXPECT_EQ(driftscope(full).code, 0) << format;
    EXPECT_EQ(text_of(scratch.file(name)), made);
    for (const std::string& text : {made + "\n", with_another_digit(made)}) {
      scratch.write(name, text);
      expect_refused(scratch, line, store_error, "changed since driftscope made it");
    }
  }
}

TEST(NothingReplaced, ATraceIsWrittenOverItselfAlone) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out"),
                    trace = scratch.file("t.csv"),
                    line = "replay " + out + " --run 1 --trace " + trace;
  ASSERT_EQ(driftscope("run " + study + " --runs 64 -o " + out).code, 0);
  ASSERT_EQ(driftscope(line).code, 0);
  EXPECT_EQ(driftscope(line).code, 0);
  const std::string made = text_of(trace);
  for (const std::string& text : {made + "# note\n", with_another_digit(made)}) {
    scratch.write("t.csv", text);
    expect_refused(scratch, "replay out --run 1 --trace t.csv", store_error,
                   "the trace of another run, or changed since driftscope made it");
  }
  EXPECT_EQ(made.find('#'), std::string::npos) << "a table and nothing else";
  scratch.write("t.csv", made);
  expect_refused(scratch, "replay out --run 2 --trace t.csv", store_error,
                 "the trace of another run");
  scratch.write("t.csv", "mine");
  const Answer a = driftscope(line);
  EXPECT_EQ(a.code, store_error) << a.err;
  EXPECT_EQ(text_of(trace), "mine");
}

}  // namespace
}  // namespace drift::nothing_replaced_test
