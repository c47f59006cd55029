#include <gtest/gtest.h>

#include <random>

#include "recording_fixture.hpp"

namespace drift::recording_fuzz_test {
namespace {

using namespace test;

std::string small_csv() {
  const Folder folder;
  write_recording(platform_recording(), folder / "rec.csv");
  const std::string text = bytes_of(folder / "rec.csv");
  return text.substr(0, text.find('\n', 1500) + 1);
}

/// 0, or 4 with a message that begins with the file's name; anything else fails the test.
void expect_read_or_refused(const std::string& path, const std::string& what) {
  const Reading a = answer(path, RecordingKind::platform);
  EXPECT_TRUE(a.code == 0 || a.code == 4) << what << ": " << a.code << " " << a.text;
  if (a.code != 0) {
    EXPECT_EQ(a.text.rfind(path + ":", 0), 0u) << what << ": " << a.text;
  }
}

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  static constexpr std::string_view tokens[] = {"nan", "inf", "-",   "1e309",  ",",    ";",
                                                "\n",  "\r",  "\t",  "[",      "]",    "#",
                                                "=",   "\"",  "0x1", "1e-400", "\xFF", "time [s]"};
  for (std::size_t k = 1 + below(4); k > 0 && !text.empty(); --k) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, 1 + below(20));
        break;
      case 2:
        text.insert(at, tokens[below(std::size(tokens))]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), below(60)));
        break;
      default:
        text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
    }
  }
  return text;
}

/// The rows of a recording are the first of another's, but for what is not measured.
void expect_beginning(const Recording& part, const Recording& whole) {
  ASSERT_LE(part.rows(), whole.rows());
  for (const Channel& c : part.channels)
    for (std::size_t i = 0; i < part.rows(); ++i)
      ASSERT_EQ(ulps(c.values[i], whole.find(c.name)->values[i]), 0.0) << c.name << " row " << i;
}

TEST(RecordingFuzz, EveryTruncationOfACsvIsReadUpToItsCutOrRefused) {
  const Folder folder;
  const std::string text = small_csv();
  ASSERT_GT(text.size(), 1000u);
  const Recording whole =
      read_recording(folder.write("whole.csv", text), RecordingKind::platform, gravity);
  std::size_t read = 0;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    const std::string path = folder.write("cut.csv", std::string_view(text).substr(0, n));
    expect_read_or_refused(path, std::to_string(n));
    if (answer(path, RecordingKind::platform).code != 0) continue;
    ++read;
    expect_beginning(read_recording(path, RecordingKind::platform, gravity), whole);
  }
  EXPECT_GT(read, text.size() / 2);
  EXPECT_LT(read, text.size() - text.find('\n'));  // without a row it is no recording
}

TEST(RecordingFuzz, TwoThousandDamagedCsvFilesAreReadOrRefused) {
  const Folder folder;
  const std::string text = small_csv();
  std::mt19937 random(20240);
  for (int i = 0; i < 2000; ++i)
    expect_read_or_refused(folder.write("m.csv", mutated(text, random)),
                           "mutation " + std::to_string(i));
}

class BinaryFuzz : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Recording, BinaryFuzz, ::testing::Values("m.h5", "m.mat"),
                         [](const auto& one) { return std::string(one.param + 2); });

TEST_P(BinaryFuzz, EveryTruncationIsRefused) {
  const Folder folder;
  const std::string path = folder / GetParam();
  write_recording(platform_recording(), path);
  const std::string all = bytes_of(path);
  const std::size_t step = all.size() / 150 + 1;
  for (std::size_t n = 0; n < all.size(); n += step) {
    folder.write(GetParam(), std::string_view(all).substr(0, n));
    EXPECT_EQ(answer(path, RecordingKind::platform).code, 4)
        << n << " of " << all.size() << " bytes";
  }
}

TEST_P(BinaryFuzz, DamagedFilesAreReadOrRefusedAndNeverCrash) {
  const Folder folder;
  const std::string path = folder / GetParam();
  write_recording(platform_recording(), path);
  const std::string all = bytes_of(path);
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string text = all;
    for (unsigned k = 1 + random() % 8; k > 0; --k)
      text[random() % (i % 2 == 0 ? text.size() : std::min<std::size_t>(text.size(), 2048))] =
          static_cast<char>(random());
    folder.write(GetParam(), text);
    expect_read_or_refused(path, "mutation " + std::to_string(i));
  }
}

}  // namespace
}  // namespace drift::recording_fuzz_test
