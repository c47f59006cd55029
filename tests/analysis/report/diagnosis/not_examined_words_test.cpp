#include "analysis/report/diagnosis/not_examined_words.hpp"

#include <gtest/gtest.h>

namespace drift::not_examined_words_test {
namespace {

using diagnosis::NotExamined;

/// Of a column that was read and is not used it is not said that nobody recorded it.
TEST(NotExaminedWords, SayWhyAColumnThatWasReadIsNotUsed) {
  NotExamined n{.term = "temperature_drift",
                .why = NotExamined::Why::no_covariate,
                .instead = "temperature lacks readings in so many rows that it is not used",
                .missing = covariate("temperature").set()};
  EXPECT_EQ(report::reason_in_words(n, {}), "it follows the temperature: " + n.instead);
  EXPECT_EQ(report::not_examined_sentences({n}, {}).at(0),
            "Not examined: temperature_drift: " + n.instead);
  EXPECT_EQ(report::followed_text({n}, {}), "");
  n.missing = further_column(0);
  EXPECT_EQ(report::reason_in_words(n, {}), "it follows a column: " + n.instead);
  n.instead.clear();
  EXPECT_EQ(report::reason_in_words(n, {}),
            "it follows a covariate that the recording does not have");
}

}  // namespace
}  // namespace drift::not_examined_words_test
