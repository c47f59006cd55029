// The files of an answer appear in a folder together or not at all.
#include "core/base/results/new_results.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::new_results_test {
namespace {

using test::ScratchFolder;
using test::temporaries_in;
using test::text_of;
namespace fs = std::filesystem;

TEST(NewResults, AppearTogetherOrNotAtAll) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("a/out"), "identify"};
  const std::string page = scratch.file("a/out/report.html"),
                    gone = scratch.file("a/out/corrected.toml");
  {
    NewResults results(folder);
    results.add("report.html", "new");
    EXPECT_FALSE(fs::exists(page));
  }
  EXPECT_FALSE(fs::exists(scratch.file("a"))) << "nothing was committed: no trace of it";
  write_files(folder, {{"report.html", "old"}, {"corrected.toml", "old"}});
  {
    NewResults results(folder);
    results.add("report.html", "new");
    results.remove("corrected.toml");
  }
  EXPECT_EQ(text_of(page) + text_of(gone), "oldold");
  NewResults results(folder);
  results.add("report.html", "new");
  results.add("estimates.csv", [](const std::string& path) { std::ofstream(path) << "1,2"; });
  results.remove("corrected.toml");
  results.remove("recording.csv");  // which there is none of
  EXPECT_EQ(text_of(page), "old");
  EXPECT_EQ(results.commit(), (std::vector<std::string>{"report.html", "estimates.csv"}));
  EXPECT_EQ(text_of(page) + text_of(scratch.file("a/out/estimates.csv")), "new1,2");
  EXPECT_FALSE(fs::exists(gone));
  EXPECT_EQ(temporaries_in(folder.path), 0u);
  EXPECT_NO_THROW(require_results_folder(folder)) << "all of it is listed";
}

TEST(NewResults, ThatMeetSomethingInTheWayBringBackWhatWasBefore) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "identify"};
  write_files(folder, {{"report.html", "old"}, {"corrected.toml", "old"}});
  {
    NewResults results(folder);
    results.add("report.html", "new");
    results.add("estimates.csv", "new");
    results.remove("corrected.toml");
    results.add("identification.json", "new");
    ASSERT_EQ(mkfifo(scratch.file("out/identification.json").c_str(), 0600), 0);
    try {
      results.commit();
      ADD_FAILURE() << "a pipe was replaced";
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), ExitCode::io);
      EXPECT_NE(std::string(error.what()).find("Nothing was changed"), std::string::npos);
    }
  }
  EXPECT_EQ(text_of(scratch.file("out/report.html")), "old");
  EXPECT_EQ(text_of(scratch.file("out/corrected.toml")), "old");
  EXPECT_FALSE(fs::exists(scratch.file("out/estimates.csv")));
  EXPECT_TRUE(fs::is_fifo(scratch.file("out/identification.json")));
  EXPECT_EQ(temporaries_in(folder.path), 0u);
}

}  // namespace
}  // namespace drift::new_results_test
