#include "core/base/sha256.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/check.hpp"
#include "core/base/file_text.hpp"

namespace drift::sha256_test {
namespace {

TEST(Sha256, GivesTheDigestsOfFips180) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, DoesNotDependOnThePieces) {
  Sha256 pieces;
  for (int i = 0; i < 1000; ++i) pieces.update(std::string(1000, 'a'));
  EXPECT_EQ(to_hex(pieces.finish()),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/// A folder is a file that opens and cannot be read, as one on a broken disk.
TEST(Sha256, OfWhatCannotBeReadIsAnErrorAndOfNothingEmpty) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_THROW(sha256_hex_of_file(folder), InputError);
  EXPECT_THROW(file_text(folder), InputError);
  EXPECT_EQ(sha256_hex_of_file(folder + "/not/there"), "");
  EXPECT_EQ(file_text(folder + "/not/there"), std::nullopt);
}

}  // namespace
}  // namespace drift::sha256_test
