// Results folders whose list of what driftscope wrote is gone.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::lost_list_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

TEST(LostList, WhereTheListIsLostNobodyKnowsWhoseAFileIs) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study());
  for (const std::string command : {"identify", "rank", "run"})
    for (const bool emptied : {false, true}) {
      const std::string name = command + (emptied ? "_emptied" : "_lost"), out = scratch.file(name),
                        line = command + " " + study + " -o " + out +
                               (command == "run" ? " --runs 64" : "");
      ASSERT_EQ(driftscope(line).code, 0);
      if (emptied)
        scratch.write(name + "/.driftscope", "");
      else
        ASSERT_TRUE(fs::remove(out + "/.driftscope"));
      scratch.write(name + "/report.html", "my remarks");
      const Answer a = driftscope(line);
      EXPECT_EQ(a.code, store_error) << line;
      EXPECT_NE(a.err.find("not in the list of what driftscope wrote"), std::string::npos) << a.err;
      EXPECT_EQ(text_of(out + "/report.html"), "my remarks");
      if (command == "run") {
        const Answer v = driftscope("verify " + out + " --sample 0%");
        EXPECT_EQ(v.code, store_error);
        EXPECT_NE(v.out.find("summary.json: not in the list"), std::string::npos) << v.out;
        // What is under its own checksums goes on.
        fs::remove(out + "/report.html");
        fs::remove(out + "/summary.json");
        const Answer again = driftscope(line);
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_NE(again.err.find("64 runs stored before"), std::string::npos) << again.err;
        EXPECT_EQ(driftscope("verify " + out + " --sample 0%").code, 0);
      }
    }
}

}  // namespace
}  // namespace drift::lost_list_test
