#include "core/base/weighed_texts.hpp"

#include <gtest/gtest.h>

namespace drift::weighed_texts_test {
namespace {

TEST(WeighedTexts, AreInTheOrderOfTheirWeightsAndOfOneWeightAsTheyCame) {
  WeighedTexts said;
  said.add(Weight::note, "n1");
  said.add(Weight::doubtful, "d1");
  said.add(Weight::note, "n2");
  said.add(Weight::wrong, "w1");
  WeighedTexts more;
  more.add(Weight::doubtful, "d2");
  more.add(Weight::wrong, "w2");
  said.add(more);
  EXPECT_EQ(said.texts(), (std::vector<std::string>{"w1", "w2", "d1", "d2", "n1", "n2"}));
}

}  // namespace
}  // namespace drift::weighed_texts_test
