#include <gtest/gtest.h>

#include <random>

#include "tests/mc/study/study_file.hpp"

namespace drift::study_mutation_test {
namespace {

/// Reading either succeeds or throws InputError(config) with at least one located message.
void expect_an_answer(const std::string& text) {
  static const test::StudyFile file("");
  file.write(text);
  try {
    mc::read_study(file.path());
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::config);
    ASSERT_FALSE(error.messages().empty());
    for (const auto& message : error.messages())
      EXPECT_TRUE(message.starts_with(file.path() + ":")) << message;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << " from\n" << text;
  }
}

TEST(StudyMutation, EveryTruncationIsReadOrExplained) {
  for (std::size_t n = 0; n <= test::full_study.size(); ++n)
    expect_an_answer(test::full_study.substr(0, n));
}

TEST(StudyMutation, RandomDamageIsReadOrExplained) {
  std::mt19937 generator(20240531);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(generator() % n); };
  const std::string spice = "[]{}=\".,#'\\\n\r\t -+_0189eEnaxN\xff\xc3\x80";
  for (int mutant = 0; mutant < 2000; ++mutant) {
    std::string text = test::full_study;
    for (std::size_t k = 1 + below(4); k > 0; --k) {
      const std::size_t at = below(text.size());
      switch (below(5)) {
        case 0:
          text[at] = static_cast<char>(generator());
          break;
        case 1:
          text.erase(at, 1 + below(20));
          break;
        case 2:
          text.insert(at, 1 + below(3), spice[below(spice.size())]);
          break;
        case 3:
          text.insert(at, text.substr(below(text.size()), below(40)));
          break;
        default:
          text[at] = spice[below(spice.size())];
          break;
      }
    }
    expect_an_answer(text);
  }
}

}  // namespace
}  // namespace drift::study_mutation_test
