// Swept values that are texts stand in every export as the study has them.
#include <gtest/gtest.h>

#include "tests/mc/small_study.hpp"
#include "tests/support/program.hpp"

namespace drift::swept_text_export_test {
namespace {

using namespace drift::test;

const std::string study = small_study +
                          "[sweep]\n\"truth.parameters.D_F_x\" = [\"-0.1 deg/h\", \"0.1 deg/h\", { "
                          "normal = [\"0 deg/h\", \"0.2 deg/h\"] }]\n";

TEST(SweptTextExport, AQuantityBelowZeroIsItselfInEveryFormat) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out");
  const Answer run =
      driftscope("run " + scratch.write("s.toml", study) + " --runs 4 --threads 1 -o " + out);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* format : {"csv", "hdf5", "json"})
    ASSERT_EQ(driftscope("export " + out + " --format " + format).code, 0) << format;
  const std::string csv = text_of(out + "/export.csv");
  EXPECT_NE(csv.find("\n0,0,ok,-0.1 deg/h,"), std::string::npos) << csv.substr(csv.size() / 2);
  EXPECT_EQ(csv.find("'-0.1"), std::string::npos);
  EXPECT_NE(text_of(out + "/export.json").find("\"-0.1 deg/h\""), std::string::npos);
  EXPECT_NE(text_of(out + "/export.h5").find("-0.1 deg/h\n0.1 deg/h\n"), std::string::npos)
      << "the attribute `words` of /points";
}

/// The coordinate of what is swept would be called as the array of true values is.
TEST(SweptTextExport, WholeSectionsAreSweptInEveryFormat) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out");
  const std::string sections =
      small_study +
      "[sweep]\ntruth = [{ coupling = \"eq6\" }, { initial_attitude = \"9 arcsec\" }]\n"
      "readout = [{ gimbals = false }, { accelerometers = false }]\n";
  const Answer run =
      driftscope("run " + scratch.write("s.toml", sections) + " --runs 2 --threads 1 -o " + out);
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* format : {"csv", "hdf5", "json", "netcdf"}) {
    const Answer made = driftscope("export " + out + " --format " + format);
    EXPECT_EQ(made.code, 0) << format << ": " << made.err;
  }
  EXPECT_NE(text_of(out + "/export.nc").find("truth_"), std::string::npos);
}

}  // namespace
}  // namespace drift::swept_text_export_test
