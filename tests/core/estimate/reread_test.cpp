// Other sensors of the same motion, against the closed form of
// tests/support/strapdown_recording.hpp.
#include "core/estimate/strapdown/reread.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::reread_test {
namespace {

/// A quiet laboratory unit: all that differs is what it reads.
test::StrapdownScript script() {
  test::StrapdownScript s = case_unit::script(11);
  s.dwells = 6;
  s.gyro_noise = s.acc_noise = 0.0;
  return s;
}

/// A platform that is told what such sensors read (sensed.hpp, the other way).
CaseSensors platform_of(const Theta& sensors) {
  CaseSensors out;
  out.theta = sensors;
  Vec3 scale;
  for (int i = 0; i < 3; ++i) {
    const std::size_t s = TermLibrary::index("s_x") + static_cast<std::size_t>(i);
    out.theta[s] = case_unit::as_platform(s, sensors);
    scale[i] = 1.0 + out.theta[s];
  }
  for (const char* group : {"D_F", "D_I", "D_O", "D_S", "D_IS"})
    for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
      if (TermLibrary::specs[p].group.view() == group)
        out.theta[p] *= scale[TermLibrary::specs[p].axis.front() - 'x'];
  ParamMask active;
  for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
    if (out.theta[p] != 0.0) active.set(p);
  out.model = {Coupling::eq6, TermLibrary::terms_of(active), {}};
  return out;
}

/// Reads what `was` reads as sensors that are `is`; the farthest from what these would have read.
struct Farthest {
  double gyro = 0.0, acc = 0.0;  ///< [rad/s], [g]
};
Farthest farthest(const Theta& was, const Theta& is) {
  const Signals seen = signals_of(strapdown_recording(script(), was)),
                others = signals_of(strapdown_recording(script(), is));
  const auto dwells = find_dwells(seen, {}).dwells;
  const CaseTest test = lay_out_case(seen, dwells, case_unit::site, Carry::through);
  const Signals read = reread(seen, dwells, test, platform_of(was), platform_of(is));
  Farthest out;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    out.gyro = std::max(out.gyro, (read.gyro[k] - others.gyro[k]).cwiseAbs().maxCoeff());
    out.acc = std::max(out.acc, (read.acc[k] - others.acc[k]).cwiseAbs().maxCoeff());
  }
  return out;
}

Theta with(Theta theta, std::initializer_list<std::pair<const char*, double>> more) {
  for (const auto& [key, value] : more) test::set(theta, key, value);
  return theta;
}

}  // namespace

TEST(Reread, AnEffectMoreIsWhatTheSensorsWouldHaveRead) {
  const Theta was = case_unit::sensors();
  const Theta is = with(was, {{"D_O_x", 2.0},
                              {"D_S_z", -1.5},
                              {"D_IS_y", 0.8},
                              {"K2_x", 300.0},
                              {"s_y", 900.0},
                              {"xi_x", 400.0}});
  const Farthest off = farthest(was, is);
  EXPECT_LT(off.gyro, 1e-12);
  EXPECT_LT(off.acc, 1e-12);
}

TEST(Reread, TheSameSensorsReadTheSame) {
  const Farthest off = farthest(case_unit::sensors(), case_unit::sensors());
  EXPECT_LT(off.gyro, 1e-15);
  EXPECT_LT(off.acc, 1e-15);
}

TEST(Reread, SensorsFarFromIdealOnesAreSolvedFor) {
  const Theta consumer = with(case_unit::sensors(), {{"s_x", 30000.0}, {"eta_x", 4000.0}});
  const Farthest off = farthest(consumer, with(consumer, {{"D_O_x", 100.0}, {"K2_z", 5000.0}}));
  EXPECT_LT(off.gyro, 1e-11);
  EXPECT_LT(off.acc, 1e-11);
}

TEST(Reread, WhatWasNotMeasuredStaysSo) {
  const Signals seen = signals_of(strapdown_recording(script(), case_unit::sensors()));
  const auto dwells = find_dwells(seen, {}).dwells;
  const CaseTest test = lay_out_case(seen, dwells, case_unit::site, Carry::through);
  Signals gappy = seen;
  gappy.gyro[100][1] = std::nan("");
  const CaseSensors own = platform_of(case_unit::sensors());
  const Signals read =
      reread(gappy, dwells, test, own, platform_of(with(case_unit::sensors(), {{"K0_x", 300.0}})));
  EXPECT_TRUE(std::isnan(read.gyro[100][1]));
  EXPECT_EQ(read.acc[100], seen.acc[100]);
  EXPECT_NE(read.acc[101], seen.acc[101]);
}

TEST(Reread, AModelWithMemoryIsNotForThis) {
  const Signals seen = signals_of(strapdown_recording(script(), case_unit::sensors()));
  const auto dwells = find_dwells(seen, {}).dwells;
  const CaseTest test = lay_out_case(seen, dwells, case_unit::site, Carry::through);
  const CaseSensors own = platform_of(case_unit::sensors());
  for (const TermInfo& term : TermLibrary::terms) {
    if (!term.needs.memory) continue;
    CaseSensors others = own;
    ParamMask active;
    active.set(term.first);
    others.model.terms |= TermLibrary::terms_of(active);
    EXPECT_THROW(reread(seen, dwells, test, own, others), ContractError) << term.key;
    return;
  }
}

}  // namespace drift::strapdown::reread_test
