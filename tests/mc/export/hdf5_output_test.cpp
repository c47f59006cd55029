#include "mc/export/hdf5_output.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/process_memory.hpp"
#include "tests/support/program.hpp"

namespace drift::mc::hdf5_output_test {
namespace {

using test::most_memory_kb;
using test::ScratchFolder;

std::vector<double> numbers_in(const std::string& file, const char* path, hsize_t count) {
  const Hdf5Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle set(H5Dopen2(opened.get(), path, H5P_DEFAULT), H5Dclose);
  std::vector<double> read(count);
  EXPECT_GE(H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0);
  return read;
}

TEST(Hdf5Output, AScaleCountsOnFromPieceToPiece) {
  const ScratchFolder scratch;
  constexpr hsize_t size = 300'000;  // more than two pieces
  Hdf5Output file(scratch.file("scale.h5"));
  file.make_scale("/row", size, 7);
  file.complete();
  const auto read = numbers_in(scratch.file("scale.h5"), "/row", size);
  for (hsize_t i = 0; i < size; ++i) ASSERT_EQ(read[i], 7.0 + static_cast<double>(i));
}

TEST(Hdf5Output, AScaleOfMillionsTakesNoMemoryOfItsSize) {
  const ScratchFolder scratch;
  constexpr hsize_t size = 4'000'000;
  constexpr long kilobytes = 8 * size / 1024;  // 32 MB
  // In a process of its own: what others took at most would hide what is taken here.
  EXPECT_EXIT(
      {
        Hdf5Output file(scratch.file("scale.h5"));
        const long before = most_memory_kb();
        file.make_scale("/row", size);
        std::_Exit(most_memory_kb() - before < kilobytes / 2 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace drift::mc::hdf5_output_test
