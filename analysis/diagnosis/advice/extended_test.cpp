#include "analysis/diagnosis/advice/extended_test.hpp"

#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/search/fitted.hpp"
#include "core/sim/simulate.hpp"

namespace drift::diagnosis {
namespace {

inference::NoiseModel noise_of(const Diagnosis& d) {
  inference::NoiseModel m = search::declared_noise(d.nominal);
  for (const inference::NoiseFinding& f : d.noise) {
    if (!f.significant || !std::isfinite(f.factor)) continue;
    if (f.component == "gimbal_white") m.gimbal_factor = f.factor;
    if (f.component == "accelerometer_white") m.acc_factor = f.factor;
  }
  return m;
}

}  // namespace

ExtendedTest::ExtendedTest(const mc::Study& study, const std::vector<Recording>& recordings,
                           const Diagnosis& d)
    : study_(study),
      d_(d),
      noise_(noise_of(d)),
      test_(preparation::recorded_test(study, recordings)),
      fit_(fit_batch(d.nominal, {test_.timeline, study.readout, test_.measured},
                     make_layout(d.nominal).theta)) {}

inference::Projector ExtendedTest::projector(
    const std::vector<inference::SignatureSpec>& signatures) const {
  return {linear_problem(d_.nominal, {test_.timeline, study_.readout, test_.measured}, fit_,
                         signatures),
          noise_};
}

planning::Information ExtendedTest::recorded(
    const BatchResult& at, const std::vector<inference::SignatureSpec>& signatures) const {
  return planning::information_of(
      linear_problem(d_.nominal, {test_.timeline, study_.readout, test_.measured}, at, signatures),
      noise_);
}

Timeline ExtendedTest::planned(const std::vector<Position>& positions) const {
  TestPlan plan = study_.plan;
  plan.preset.clear();
  plan.positions = positions;
  return preparation::planned_test(study_, plan, test_.timeline);
}

planning::Information ExtendedTest::added(
    const planning::Addition& addition, const BatchResult& at,
    const std::vector<inference::SignatureSpec>& signatures) const {
  Timeline timeline = planned(addition);
  const Interval& last = test_.timeline.intervals.back();
  const double later = last.t1 - last.t_begin;
  for (Interval& i : timeline.intervals) {
    i.t0 += later;
    i.t1 += later;
    i.t_dwell += later;
  }
  for (Node& node : timeline.nodes) node.t += later;
  const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
  const Measurements anything{Mat3X::Zero(3, n),
                              Mat3X::Zero(3, n)};  // information does not ask for values
  BatchResult fit = at;
  fit.psi0_l.assign(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  return planning::information_of(
      linear_problem(d_.nominal, {timeline, study_.readout, anything}, fit, signatures), noise_);
}

double ExtendedTest::verified(const std::vector<Position>& added, const Alternative& truth,
                              const Alternative& rival, const Theta& fitted,
                              std::uint64_t seed) const {
  std::vector<Position> positions = study_.plan.positions;
  positions.insert(positions.end(), added.begin(), added.end());
  const Timeline timeline = planned(positions);
  const FilterSpec right = patched_filter(d_.nominal, truth.causes);
  const FilterSpec wrong = patched_filter(d_.nominal, rival.causes);
  TruthSpec simulated;
  static_cast<ModelSpec&>(simulated) = right;
  TruthDraw draw = draw_truth(simulated, timeline.chains, seed, 0);
  draw.theta = fitted;
  for (const search::Cause& c : truth.causes)
    for (const search::CauseParameter& p : c.parameters)
      draw.theta[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
  const Simulation sim = Simulator(simulated, study_.readout).run(timeline, draw, seed, 0);
  if (!sim.ode.ok()) return std::nan("");
  const auto cost = [&](const FilterSpec& f) {
    return fit_batch(f, {timeline, study_.readout, sim.measured}, make_layout(f).theta,
                     {.result = BatchOptions::Result::estimates})
        .estimate.statistic;
  };
  const double gain = cost(wrong) - cost(right);
  return std::copysign(std::sqrt(std::abs(gain)), gain);
}

}  // namespace drift::diagnosis
