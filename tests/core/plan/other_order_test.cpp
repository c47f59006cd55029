// Positions of the plan held in another order, or some of them only.
#include "core/plan/other_order.hpp"

#include <algorithm>

#include "tests/support/attitude_scene.hpp"

namespace drift::other_order_test {
namespace {

using Scene = test::AttitudeScene;
using Numbers = std::vector<std::size_t>;

/// What is said of a recording of which nothing was spoilt but the plan.
std::string said(Scene& s) {
  const auto wrong = s.mistakes();
  EXPECT_EQ(wrong.size(), 1u);
  return wrong.empty() ? "" : wrong.front().text;
}

TEST(OtherOrder, AsAdvisedThePlanIsThatOfTheRecording) {
  Scene s("six");
  const Scene held = s;
  s.plan.positions = {};
  for (const std::size_t p : {1u, 2u, 0u, 5u, 4u, 3u})
    s.plan.positions.push_back(held.plan.positions[p]);
  const std::string text = said(s);
  test::expect_part(text, "in which they were held: 3, 1, 2, 6, 5, 4.");
  const TestPlan other = s.plan;
  s.plan.positions = {};
  for (const std::size_t p : {3u, 1u, 2u, 6u, 5u, 4u})
    s.plan.positions.push_back(other.positions[p - 1]);
  EXPECT_TRUE(s.mistakes().empty());
}

TEST(OtherOrder, SomeOfThePlanInItsOrderAreAMatterOfNumbers) {
  Scene s;
  const std::vector<double> number = s.column("position");
  const auto first = std::ranges::find(number, 2.0) - number.begin();
  for (Channel& c : s.recording.channels)
    c.values.erase(c.values.begin(), c.values.begin() + first);
  s.recording.lines.resize(number.size() - static_cast<std::size_t>(first));
  for (double& p : s.column("position")) p -= 1.0;
  const std::string text = said(s);
  test::expect_part(text, "They show positions 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 of the plan");
  test::expect_part(text, "positions = { \"NUMBER IN THE FILE\" = NUMBER IN THE PLAN");
}

TEST(OtherOrder, IsKnownWhereEachFitsOneOrItsOwn) {
  std::vector<Sight> sights(3);
  for (int k = 0; k < 3; ++k) sights[static_cast<std::size_t>(k)].position = k;
  const auto shown = [&](const std::vector<Numbers>& fits) {
    return shown_positions(sights, 4, [&](const Sight& s, std::size_t p) {
      const Numbers& of = fits[static_cast<std::size_t>(s.position)];
      return std::ranges::find(of, p) == of.end() ? 1.0 : 0.0;
    });
  };
  EXPECT_EQ(shown({{1}, {0}, {3}}), (Numbers{1, 0, 3}));
  EXPECT_EQ(shown({{1, 0}, {3}, {2}}), (Numbers{0, 3, 2})) << "its own";
  EXPECT_EQ(shown({{1, 2}, {3}, {2}}), std::nullopt) << "several";
  EXPECT_EQ(shown({{1}, {}, {2}}), std::nullopt) << "none";
  EXPECT_EQ(shown({{3}, {3}, {2}}), std::nullopt) << "two the same";
}

TEST(OtherOrder, IsAQuestionWhereItIsNotKnown) {
  for (const std::string& text :
       {other_order_advice(std::nullopt, true), other_order_advice(Numbers{1, 0}, false)}) {
    EXPECT_NE(text.find("Is this the plan"), std::string::npos) << text;
    EXPECT_EQ(text.find("positions = {"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace drift::other_order_test
