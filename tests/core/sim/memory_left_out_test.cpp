// What memory along the nominal path leaves out of the platform's own, at a pole, where one gimbal
// turns.
#include "core/sim/memory_left_out.hpp"

#include <gtest/gtest.h>

#include "tests/support/model_builders.hpp"

namespace drift::memory_left_out_test {
namespace {

using namespace drift::test;

/// Six minutes at a pole, x up: the middle gimbal turns about the vertical. command: of the Earth's
/// rate, about the vertical; drift: what turns the platform about it beside the command, likewise.
double part_left_out(double command, double drift) {
  Timeline timeline;
  timeline.site = Site{90.0 * detail::deg};
  timeline.chains = timeline.positions = 1;
  for (int k = 0; k < 36; ++k) {
    Interval i;
    i.t0 = 10.0 * k;
    i.t1 = i.t0 + 10.0;
    i.cage = k == 0;
    i.omega_cmd_p = Vec3(command * detail::earth_rate, 0.0, 0.0);
    timeline.intervals.push_back(i);
  }
  std::string why;
  place_nodes(timeline, {parse_axes("x=U y=N z=W", why).value()});
  const ParamMask active = TermLibrary::completed(only({"D_F_x", "F"}));
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (active[i]) theta[i] = TermLibrary::specs[i].prior_si().mean();
  theta[param("D_F_x")] = -drift * detail::earth_rate;  // w_ip = -w_l
  const auto all = memory_left_out(timeline, {Coupling::eq6, TermLibrary::terms_of(active), {}},
                                   theta, {Vec3::Zero()});
  EXPECT_EQ(all.size(), 1u);
  EXPECT_EQ(all.front().term, "stiction");
  return all.front().part;
}

TEST(MemoryLeftOut, IsAllOfAFrictionThatIsThereOnOneOfThePathsAlone) {
  // Held level the gimbal stands still, and a thirtieth of the Earth's rate, 0.5 deg/h, turns it by
  // 180 arcsec, F_turn being 40. Free, it turns, and a drift of the Earth's rate stops it.
  EXPECT_NEAR(part_left_out(1.0, 1.0 / 30.0), 1.0, 1e-9);
  EXPECT_NEAR(part_left_out(0.0, 1.0), 1.0, 1e-4);
}

TEST(MemoryLeftOut, IsTwiceAFrictionOfTheOtherSign) {
  // The platform is led by the Earth and turns against it by as much.
  EXPECT_NEAR(part_left_out(0.0, 2.0), 2.0, 1e-4);
}

TEST(MemoryLeftOut, IsLittleWhereTheGimbalTurnsFarTheSameWay) {
  EXPECT_EQ(part_left_out(0.0, 0.0), 0.0);
  EXPECT_EQ(part_left_out(1.0, 0.0), 0.0);
  // Twice as fast: 1 - exp(-t/tau) against 1 - exp(-2 t/tau), tau = 40 arcsec / 15 arcsec/s. The
  // square of the difference has the integral tau / 12, the friction is 1 for six minutes.
  const double tau = 40.0 * arcsec / detail::earth_rate;
  EXPECT_NEAR(part_left_out(0.0, -1.0), std::sqrt(tau / 12.0 / 360.0), 5e-3);
}

TEST(MemoryLeftOut, IsNothingOfAModelWithoutMemory) {
  const Timeline timeline = preset_timeline("six", CommandLaw::level, 600.0);
  const std::vector<Vec3> psi0_l(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  EXPECT_TRUE(
      memory_left_out(timeline, base_spec(Coupling::eq5).model(), random_theta(1), psi0_l).empty());
}

}  // namespace
}  // namespace drift::memory_left_out_test
