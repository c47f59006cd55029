#include "core/base/seal.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/process_memory.hpp"
#include "tests/support/program.hpp"

namespace drift::seal_test {
namespace {

using test::most_memory_kb;
using test::ScratchFolder;

TEST(Seal, HoldsUntilAByteChanges) {
  const ScratchFolder scratch;
  // More than two of the pieces in which a file is read.
  std::string text(600'000, '.');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * i % 251);
  const std::string file = scratch.write("file", text);
  EXPECT_FALSE(seal_holds(file));
  append_seal(file, file);
  ASSERT_TRUE(seal_holds(file));
  const std::string sealed = test::text_of(file);
  for (const std::size_t at : {std::size_t{0}, std::size_t{262'143}, std::size_t{262'144},
                               std::size_t{599'999}, sealed.size() - 1}) {
    std::string changed = sealed;
    changed[at] ^= 1;
    EXPECT_FALSE(seal_holds(scratch.write("changed", changed))) << at;
  }
  EXPECT_FALSE(seal_holds(scratch.write("longer", sealed + "\n")));
  EXPECT_FALSE(seal_holds(scratch.write("shorter", sealed.substr(1))));
}

TEST(Seal, OfALargeFileTakesNoMemoryOfItsSize) {
  const ScratchFolder scratch;
  const std::string file = scratch.write("large", "");
  constexpr long kilobytes = 64 * 1024;
  std::filesystem::resize_file(file, 1024 * kilobytes);
  // In a process of its own: what others took at most would hide what is taken here.
  EXPECT_EXIT(
      {
        const long before = most_memory_kb();
        append_seal(file, file);
        const bool holds = seal_holds(file);
        std::_Exit(holds && most_memory_kb() - before < kilobytes / 4 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace drift::seal_test
