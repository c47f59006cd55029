#include "analysis/inference/signatures.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/estimate/linearize.hpp"
#include "core/estimate/linearizer.hpp"
#include "core/sim/memory_path.hpp"
#include "core/sim/path_in_lanes.hpp"

namespace drift::inference {
namespace {

/// The nominal model with the terms of some parameters switched on at zero amplitude.
DriftModel extended(const FilterSpec& nominal, const ParamMask& added) {
  ModelSpec spec = nominal;
  spec.active |= added;
  if (added[closure_param]) spec.coupling = family_of(spec.coupling);
  return spec.model();
}

/// A layout of exactly some parameters, those of the rate equation first.
Layout layout_of(const std::vector<const SignatureSpec*>& specs, const Theta& theta) {
  Layout layout;
  layout.theta = theta;
  layout.mean = VecX::Zero(specs.size());
  layout.sigma.resize(specs.size());
  for (const bool rate : {true, false}) {
    for (const SignatureSpec* s : specs)
      if (TermLibrary::owner(s->param).in_rates == rate) {
        layout.sigma[layout.params.size()] = s->unit;
        layout.params.push_back(s->param);
      }
    if (rate) layout.num_rate = layout.params.size();
  }
  return layout;
}

std::vector<RowTag> row_tags(const MeasuredTest& test) {
  std::vector<RowTag> tags;
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i)
    for (int c = 0; c < num_channels; ++c) {
      const bool read = c < 3 ? test.readout.accelerometers : test.readout.gimbals;
      const double value = c < 3 ? test.measured.acc(c, i) : test.measured.gimbal(c - 3, i);
      if (read && std::isfinite(value)) tags.push_back({i, c, test.timeline.intervals[i].position});
    }
  return tags;
}

std::vector<IntervalDrive> drives(const Timeline& timeline) {
  std::vector<IntervalDrive> all;
  const Interval* before = nullptr;
  for (const Interval& i : timeline.intervals) {
    IntervalDrive d;
    d.length = i.length();
    d.gap = before && !i.begins ? std::max(0.0, i.t0 - before->t1) : 0.0;
    d.cage = i.cage;
    d.begins = i.begins;
    d.chain = i.chain;
    d.samples = i.samples;
    d.readings = i.readings;
    d.rest = i.rest;
    all.push_back(d);
    before = &i;
  }
  return all;
}

/// IntervalDrive::per_rate of every interval: what a drift of each gyro does to the attitude within
/// it, carried back to the caging by the transition that the rows have. Over hours without caging
/// an attitude error turns and grows by a tenth, many sigma of what noise has driven it to.
void carry_back(std::vector<IntervalDrive>& drives, const FilterSpec& nominal,
                const Timeline& timeline, const Theta& theta, const Trajectory& phi) {
  ParamMask drift;
  Layout layout;
  layout.theta = theta;
  layout.mean = VecX::Zero(3);
  layout.sigma = VecX::Ones(3);
  layout.num_rate = 3;
  constexpr std::size_t fixed_drift = TermLibrary::index("D_F_x");
  for (std::size_t gyro = 0; gyro < 3; ++gyro) {
    layout.params.push_back(fixed_drift + gyro);
    drift.set(fixed_drift + gyro);
  }
  const DriftModel model = extended(nominal, drift);
  Linearizer linearizer(model, layout, {});
  linearizer.set_theta(theta);
  linearizer.leave_readout_out();
  MemoryPath memory(timeline, model);
  IntervalSensitivity inner;
  Mat3 back = Mat3::Identity();  // from the start of the interval to the caging
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const Interval& interval = timeline.intervals[k];
    memory.advance(k, theta.data());
    if (interval.cage) back.setIdentity();
    if (interval.rest) continue;
    linearize_interval(interval, timeline, misalignment_matrix(model.mounting, interval.loop),
                       &phi[interval.first_node], memory.points(), linearizer, inner);
    const std::size_t last = interval.node_count() - 1;
    back = (back * inner.Phi[last].inverse()).eval();
    drives[k].per_rate = back * inner.G[last].leftCols<3>() / nominal.initial_attitude;
  }
}

/// The angle [rad] by which the platform and its gyros have turned between two fits of a test.
double turned_between(const Timeline& timeline, const KnownSignatures& known, const Theta& theta,
                      const Trajectory& phi) {
  const Theta before = theta_of(known.filter, known.fit);
  double angle = 0.0;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (is_misalignment(i)) angle = std::max(angle, std::abs(theta[i] - before[i]));
  const Trajectory then = integrate(timeline, known.filter.model(), before, known.fit.psi0_l);
  for (std::size_t k = 0; k < phi.size(); ++k) angle = std::max(angle, (phi[k] - then[k]).norm());
  return angle;
}

bool same_column(const SignatureSpec& a, const SignatureSpec& b) {
  if (a.param != b.param || a.unit != b.unit) return false;
  const TermInfo& owner = TermLibrary::owner(a.param);
  return a.theta.segment(owner.first, owner.count) == b.theta.segment(owner.first, owner.count);
}

/// Columns of which those known are taken as they are.
MatX columns_beside(const KnownSignatures& known, const FilterSpec& nominal,
                    const MeasuredTest& test, const BatchResult& fit,
                    const std::vector<SignatureSpec>& specs, const std::vector<RowTag>& tags) {
  MatX out(static_cast<Eigen::Index>(tags.size()), static_cast<Eigen::Index>(specs.size()));
  std::vector<SignatureSpec> others;
  std::vector<Eigen::Index> places;
  for (std::size_t k = 0; k < specs.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    const auto at = std::ranges::find_if(
        known.specs, [&](const SignatureSpec& s) { return same_column(s, specs[k]); });
    if (at != known.specs.end() && specs[k].param != closure_param) {
      out.col(place) = known.columns.col(at - known.specs.begin());
    } else {
      others.push_back(specs[k]);
      places.push_back(place);
    }
  }
  out(Eigen::all, places) = signature_columns(nominal, test, fit, others, tags);
  return out;
}

}  // namespace

VecX residual_of(const LinearProblem& problem, const BatchResult& fit) {
  VecX r(problem.rows());
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const RowTag& t = problem.tags[k];
    const double value = t.accelerometer() ? fit.acc_residual(t.channel, t.interval)
                                           : fit.gimbal_residual(t.channel - 3, t.interval);
    r[k] = std::isfinite(value) ? value : 0.0;  // a fit may have left a sample out
  }
  return r;
}

MatX signature_columns(const FilterSpec& nominal, const MeasuredTest& test, const BatchResult& fit,
                       std::span<const SignatureSpec> specs, const std::vector<RowTag>& tags) {
  MatX out =
      MatX::Zero(static_cast<Eigen::Index>(tags.size()), static_cast<Eigen::Index>(specs.size()));
  if (specs.empty()) return out;
  const Theta theta = theta_of(nominal, fit);
  const Trajectory phi = integrate(test.timeline, nominal.model(), theta, fit.psi0_l);
  std::vector<bool> done(specs.size(), false);
  for (std::size_t first = 0; first < specs.size(); ++first) {
    if (done[first]) continue;
    // Each parameter once: a layout cannot hold it twice; each term at one setting of its
    // parameters.
    std::vector<const SignatureSpec*> group;
    ParamMask added;
    TermMask terms;
    Theta at = theta;
    for (std::size_t k = first; k < specs.size(); ++k) {
      if (done[k] || added[specs[k].param]) continue;
      const TermInfo& owner = TermLibrary::owner(specs[k].param);
      const auto number = *TermLibrary::find_term(owner.key);
      const auto own = [&](const Theta& t) { return t.segment(owner.first, owner.count); };
      if (terms[number] && own(specs[k].theta) != own(at)) continue;
      terms.set(number);
      at.segment(owner.first, owner.count) = own(specs[k].theta);
      group.push_back(&specs[k]);
      added.set(specs[k].param);
      done[k] = true;
    }
    if (added[closure_param])
      at[closure_param] = facts(nominal.coupling).lambda.value_or(at[closure_param]);
    const Layout small = layout_of(group, at);
    const auto parts = measurement_equations(test, extended(nominal, added), small, at, phi,
                                             nominal.initial_attitude);
    Eigen::Index next = 0;
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const Eigen::Index count = parts[c].rows.rows();
      for (const SignatureSpec* s : group) {
        const auto place =
            std::find(small.params.begin(), small.params.end(), s->param) - small.params.begin();
        out.col(s - specs.data()).segment(next, count) = parts[c].rows.col(3 + place);
      }
      next += count;
    }
  }
  return out;
}

LinearProblem linear_problem(const FilterSpec& nominal, const MeasuredTest& test,
                             const BatchResult& fit, const std::vector<SignatureSpec>& specs,
                             const KnownSignatures* known) {
  LinearProblem out;
  out.tags = row_tags(test);
  out.drives = drives(test.timeline);
  out.acc_sigma = test.readout.accelerometer_noise;
  out.gimbal_sigma = test.readout.gimbal_noise;
  out.acc_rounded = test.readout.accelerometers_rounded;
  out.gimbals_rounded = test.readout.gimbals_rounded;
  out.driven_at_most = test.readout.gimbal_noise_at_most;
  out.attitude_sigma = nominal.initial_attitude;
  const auto rows = static_cast<Eigen::Index>(out.tags.size());
  out.weight = VecX::Ones(rows);

  const DriftModel model = nominal.model();
  const Layout layout = make_layout(nominal);
  const auto n = static_cast<Eigen::Index>(layout.size());
  const Theta theta = theta_of(nominal, fit);
  const Trajectory phi = integrate(test.timeline, model, theta, fit.psi0_l);

  carry_back(out.drives, nominal, test.timeline, theta, phi);

  out.psi.resize(rows, 3);
  out.theta.resize(rows, n);
  out.r0.resize(rows);
  const VecX x = layout.scaled(theta);
  Eigen::Index next = 0;
  const auto chains =
      measurement_equations(test, model, layout, theta, phi, nominal.initial_attitude);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const MatX& e = chains[c].rows;
    const Eigen::Index count = e.rows();
    out.psi.middleRows(next, count) = e.leftCols<3>();
    out.theta.middleRows(next, count) = e.middleCols(3, n);
    out.r0.segment(next, count) = e.col(3 + n) + e.middleCols(3, n) * x +
                                  e.leftCols<3>() * (fit.psi0_l[c] / nominal.initial_attitude);
    next += count;
  }

  const bool alike = known && known->columns.rows() == rows &&
                     known->filter.coupling == nominal.coupling &&
                     turned_between(test.timeline, *known, theta, phi) < EffortLimits::turned;
  out.extra = alike ? columns_beside(*known, nominal, test, fit, specs, out.tags)
                    : signature_columns(nominal, test, fit, specs, out.tags);
  return out;
}

}  // namespace drift::inference
