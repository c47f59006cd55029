#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "core/base/check.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"
#include "tests/mc/study/study_file.hpp"
#include "tests/support/mutants.hpp"
#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

// Readers of every kind of file get damaged ones: each is read or refused in words, and nothing
// else happens. DRIFT_FUZZ is the number of mutants (10,000), DRIFT_FUZZ_SERIES which they are (1),
// DRIFT_FUZZ_KEEP a folder for those that failed: they belong into tests/corpus then, which every
// test run reads. tests/checks/other_builds.sh runs this under the sanitizers.

namespace drift::fuzz_test {
namespace {

namespace fs = std::filesystem;

unsigned long setting(const char* name, unsigned long otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::stoul(text) : otherwise;
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// The folder of the files at work: what crashes the reader is still there afterwards.
std::string work_folder(const std::string& kind) {
  const char* kept = std::getenv("DRIFT_FUZZ_KEEP");
  const fs::path folder =
      (kept != nullptr ? fs::path(kept) : fs::temp_directory_path() / "driftscope_fuzz") / kind;
  fs::create_directories(folder);
  return folder.string();
}

/// Files of one kind, and what reading one of them must be like: `read` throws nothing but
/// InputError, of that code, about that file.
struct Kind {
  std::string name;  ///< of the folder in tests/corpus
  std::string file;  ///< what the reader takes it to be by its name
  ExitCode refusal;
  std::function<void(const std::string& folder)> read;
  std::vector<std::string> originals;
  std::vector<std::string> words;
};

/// What is wrong with how the file in the folder is read, or nothing.
std::string wrong(const Kind& kind, const std::string& folder) {
  try {
    kind.read(folder);
  } catch (const InputError& error) {
    if (error.code() != kind.refusal)
      return fmt::format("exit {}: {}", static_cast<int>(error.code()), error.what());
    for (const std::string& message : error.messages())
      if (!message.starts_with(folder)) return "names no file: " + message;
  } catch (const std::exception& error) {
    return fmt::format("not an answer: {}", error.what());
  }
  return {};
}

void fuzz(const Kind& kind, double share) {
  const auto series = static_cast<unsigned>(setting("DRIFT_FUZZ_SERIES", 1));
  const auto count =
      static_cast<unsigned>(share * static_cast<double>(setting("DRIFT_FUZZ", 10000)));
  const test::Mutants mutants(kind.originals, kind.words);
  const std::string folder = work_folder(kind.name);
  for (unsigned i = 0; i < count; ++i) {
    write(folder + "/" + kind.file, mutants.of(series, i));
    const std::string what = wrong(kind, folder);
    if (what.empty()) continue;
    const std::string kept = fmt::format("{}/failed-{}-{}-{}", folder, series, i, kind.file);
    fs::copy_file(folder + "/" + kind.file, kept, fs::copy_options::overwrite_existing);
    ADD_FAILURE() << what << "\nthe file is kept: " << kept;
  }
  ::testing::Test::RecordProperty("mutants", static_cast<int>(count));
}

/// Files that were a trouble once, or might be; of binary kinds there are none.
std::vector<std::string> corpus(const std::string& kind) {
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& file : fs::directory_iterator(DRIFT_SOURCE_DIR "/tests/corpus/" + kind, none))
    paths.push_back(file.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) texts.push_back(test::text_of(path.string()));
  return texts;
}

Kind studies() {
  Kind kind{.name = "study",
            .file = "study.toml",
            .refusal = ExitCode::config,
            .read = [](const std::string& folder) { mc::read_study(folder + "/study.toml"); },
            .originals = corpus("study"),
            .words = {"[",
                      "]",
                      "[[",
                      "]]",
                      "{",
                      "}",
                      "=",
                      "\"",
                      "'''",
                      "\"\"\"",
                      ".",
                      "#",
                      "\\u0000",
                      "\\",
                      "\n",
                      "\r\n",
                      "\t",
                      "nan",
                      "inf",
                      "-inf",
                      "1e999",
                      "0x7fffffffffffffff",
                      "9223372036854775808",
                      "1979-05-27",
                      "true",
                      "\xef\xbb\xbf",
                      "\xff",
                      "\xc3\x28",
                      "arcsec",
                      "deg/h",
                      "normal",
                      "[platform]\n",
                      "= [1, 2",
                      "- 1"}};
  kind.originals.push_back(test::full_study);
  return kind;
}

Recording small_recording() {
  Recording r;
  r.facts = {{"sensor", "test table"}};
  const auto add = [&](const std::string& name, const char* unit) {
    Channel c{name, *parse_unit(unit), {}};
    for (int i = 0; i < 8; ++i)
      c.values.push_back(name == "time" ? 60.0 * i : name == "position" ? 1.0 + i / 4 : 0.1 * i);
    r.channels.push_back(std::move(c));
  };
  add("time", "s");
  add("position", "1");
  for (const char* axis : {"x", "y", "z"}) add(std::string("acc_") + axis, "m/s^2");
  for (const char* ring : {"outer", "middle", "inner"}) add(std::string("gimbal_") + ring, "deg");
  return r;
}

Kind recordings(const std::string& file) {
  Kind kind{.name = file.substr(file.find('.') + 1),
            .file = file,
            .refusal = ExitCode::recording,
            .read =
                [file](const std::string& folder) {
                  read_recording(folder + "/" + file, RecordingKind::platform, 9.8);
                },
            .originals = {},
            .words = {"nan",
                      "inf",
                      "-",
                      "1e309",
                      ",",
                      ";",
                      "\n",
                      "\r",
                      "\t",
                      "[",
                      "]",
                      "#",
                      "=",
                      "\"",
                      "0x1",
                      "1e-400",
                      "\xff",
                      "time [s]",
                      std::string(8, '\0'),
                      "position",
                      "acc_x"}};
  const std::string folder = work_folder(kind.name);
  write_recording(small_recording(), folder + "/" + file);
  kind.originals.push_back(test::text_of(folder + "/" + file));
  for (std::string& one : corpus(kind.name)) kind.originals.push_back(std::move(one));
  return kind;
}

test::SyntheticStudy small_study() {
  test::SyntheticStudy study{
      .task = {.fail_every = 11}, .options = {.runs = 40, .allowed_failures = 40}, .block_size = 8};
  study.options.threads = 1;
  return study;
}

/// A manifest by its checksum, and one of the format that had none, whose every value is looked at.
Kind manifests() {
  Kind kind{.name = "manifest",
            .file = "manifest.json",
            .refusal = ExitCode::store,
            .read = [](const std::string& folder) { mc::read_manifest(folder); },
            .originals = corpus("manifest"),
            .words = {"{", "}", "[", "]", ":", ",", "\"", "\\ud800", "\\", "null", "true", "1e999",
                      "-1", "18446744073709551616", "\xff", "\"points\"", "\"columns\": [[]]",
                      "\"block_size\": 0"}};
  const test::ScratchFolder folder;
  small_study().run(folder.path());
  std::string text = test::text_of(folder.file("manifest.json"));
  kind.originals.push_back(text);
  const std::string format = "\"format\": 2";
  EXPECT_NE(text.find(format), std::string::npos);
  text.replace(text.find(format), format.size(), "\"format\": 1");
  kind.originals.push_back(text);
  return kind;
}

/// Blocks of a damaged worker file are those that were stored, or are not there.
Kind stores(const std::string& folder) {
  small_study().run(folder);
  std::map<std::uint64_t, std::string> whole;
  mc::StudyReader(folder).each_result({}, [&](const mc::StoredBlock& b) {
    whole[b.block.first] = mc::encode(b.block, 5) + mc::encode(b.failures);
  });
  const std::string bytes = test::text_of(folder + "/worker-0000.sqlite");
  return {.name = "store",
          .file = "worker-0000.sqlite",
          .refusal = ExitCode::store,
          .read =
              [whole](const std::string& where) {
                mc::StudyReader reader(where);
                reader.each_result({}, [&](const mc::StoredBlock& b) {
                  if (whole.at(b.block.first) != mc::encode(b.block, 5) + mc::encode(b.failures))
                    throw std::runtime_error("a damaged block was taken for a whole one");
                });
                reader.sessions();
                reader.unsound();
                reader.misfits();
              },
          .originals = {bytes},
          .words = {"SQLite format 3", std::string(16, '\0'), "CREATE TABLE", "blocks", "\x01",
                    "\xff\xff"}};
}

TEST(FuzzNightly, StudyFiles) {
  fuzz(studies(), 0.4);
}
TEST(FuzzNightly, CsvRecordings) {
  fuzz(recordings("recording.csv"), 0.3);
}
TEST(FuzzNightly, MatRecordings) {
  fuzz(recordings("recording.mat"), 0.005);  // a process each
}
TEST(FuzzNightly, Hdf5Recordings) {
  fuzz(recordings("recording.h5"), 0.005);
}
TEST(FuzzNightly, Manifests) {
  fuzz(manifests(), 0.16);
}
TEST(FuzzNightly, Stores) {
  const std::string folder = work_folder("store");
  fs::remove_all(folder);
  fuzz(stores(folder), 0.13);
}

TEST(FuzzCorpus, EveryFileIsReadOrRefusedInWords) {
  for (const Kind& kind : {studies(), recordings("recording.csv"), manifests()}) {
    const test::ScratchFolder folder;
    const auto files = corpus(kind.name);
    EXPECT_FALSE(files.empty()) << kind.name;
    for (const std::string& file : files) {
      write(folder.file(kind.file), file);
      EXPECT_EQ(wrong(kind, folder.path()), "") << kind.name << ":\n" << file.substr(0, 200);
    }
  }
}

}  // namespace
}  // namespace drift::fuzz_test
