// What stands behind the recording that `look` is given.
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::look_arguments_test {
namespace {

using test::driftscope, test::ScratchFolder, test::config_error, test::usage_error;

TEST(LookArguments, ARecordingIsNoStudyToReadAnotherWith) {
  const ScratchFolder folder;
  const std::string study = folder.write("study.toml", test::short_study);
  for (const char* name : {"a.csv", "b.csv", "b.h5", "b.mat"})
    ASSERT_EQ(driftscope("simulate '" + study + "' -o '" + folder.file(name) + "'").code, 0);
  const std::string first = folder.file("a.csv");
  for (const char* name : {"b.csv", "b.h5", "b.mat"}) {
    const auto two = driftscope("look '" + first + "' '" + folder.file(name) + "'");
    EXPECT_EQ(two.code, usage_error) << two.err;
    EXPECT_NE(two.err.find(std::string(name) + " is a recording (expected one recording and, "
                                               "behind it, a study file"),
              std::string::npos)
        << two.err;
    EXPECT_EQ(two.err.find("TOML"), std::string::npos) << two.err;
  }
  const auto turned = driftscope("look '" + study + "' '" + first + "'");
  EXPECT_EQ(turned.code, usage_error) << turned.err;
  EXPECT_NE(turned.err.find("Name it first"), std::string::npos) << turned.err;
}

TEST(LookArguments, AStudyIsOneUnderWhateverName) {
  const ScratchFolder folder;
  const std::string study = folder.write("study.txt", test::short_study),
                    made = folder.file("a.csv");
  ASSERT_EQ(driftscope("simulate '" + study + "' -o '" + made + "'").code, 0);
  const auto look = driftscope("look '" + made + "' '" + study + "'");
  EXPECT_EQ(look.code, 0) << look.err;
  const std::string wrong =
      folder.write("wrong.txt", std::string(test::short_study) + "[plam]\nx = 1\n");
  EXPECT_EQ(driftscope("look '" + made + "' '" + wrong + "'").code, config_error);
}

}  // namespace
}  // namespace drift::look_arguments_test
