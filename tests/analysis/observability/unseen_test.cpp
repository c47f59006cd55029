// What a plan does not see, from the plan to the words.
#include <gtest/gtest.h>

#include <map>

#include "analysis/report/page/degeneracies.hpp"
#include "tests/analysis/observability/ranking_fixture.hpp"

namespace drift::unseen_test {
namespace {

/// One position held level for 2 h, x north and z up.
observability::Ranking held_level(std::initializer_list<std::string_view> keys) {
  Position p;
  std::string why;
  p.R_lp = parse_axes("x=N y=W z=U", why).value();
  p.mode = CommandLaw::level;
  p.dwell = 7200.0;
  p.sample = 300.0;
  TestPlan plan;
  plan.positions = {p};
  return observability::rank_parameters(
      observability::linearise(plan, model_of(Coupling::eq6, keys)));
}

TEST(Unseen, AScaleFactorUnderAConstantCommandIsUnseenWithTheDriftAlone) {
  // 1000 ppm of the Earth's rate, 10.5 deg/h north and 10.8 up, are 0.01 of the prior of D_F, and
  // tens of sigma: s_x is no direction that cannot be seen, s_x with D_F_x is. y is never torqued.
  const observability::Ranking r = held_level({"D_F", "s"});
  EXPECT_EQ(exactly_unseen(r.unseen, r.root), 3u);
  std::map<std::string, std::string> reason;
  std::string said;
  for (const auto& d :
       report::name_degeneracies(r.layout, Mounting{}, {r.unseen, r.root, r.excitation})) {
    std::string keys;
    for (const auto& part : d.parts)
      keys += std::string(TermLibrary::specs[part.param].key.view()) + " ";
    reason[keys] = d.reason;
    said += d.combination + "\n";
    EXPECT_EQ(d.unrounded, 0.0) << d.combination;
    EXPECT_LT(d.signal * d.signal, unseen_information) << d.combination;  // as it is written
  }
  EXPECT_EQ(reason,
            (std::map<std::string, std::string>{{"D_F_x s_x ", ""},
                                                {"D_F_z s_z ", ""},
                                                {"s_y ", "no signal: the gyro is never torqued"}}))
      << said;
  const auto column = [&](std::string_view key) {
    const auto k = std::ranges::find(r.layout.params, param(key)) - r.layout.params.begin();
    return r.root.col(k).norm();
  };
  EXPECT_GT(column("s_x"), 10.0);
  EXPECT_LE(column("s_y"), rounding_signal(r.root));
}

}  // namespace
}  // namespace drift::unseen_test
