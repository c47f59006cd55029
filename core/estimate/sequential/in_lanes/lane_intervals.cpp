#include "core/estimate/sequential/in_lanes/lane_intervals.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/sequential/drift_walk.hpp"
#include "core/estimate/transition.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/surroundings.hpp"

namespace drift {
namespace {

/// Rotation vector of a rotation by less than 120 deg; another lane is worked out by itself.
PackVec rotation_vector(const PackMat& R) {
  const Pack trace = R(0, 0) + R(1, 1) + R(2, 2);
  const Pack w = Pack(0.5) * sqrt(Pack(1.0) + trace);  // of the quaternion
  const Pack factor = Pack(0.25) / w;
  PackVec v{factor * (R(2, 1) - R(1, 2)), factor * (R(0, 2) - R(2, 0)),
            factor * (R(1, 0) - R(0, 1))};
  // 2 atan(x) / x, x the tangent of half of the angle; by series below 0.05: it is off by 2e-17.
  const Pack x2 = mul_add(v[0], v[0], mul_add(v[1], v[1], v[2] * v[2])) / (w * w);
  Pack series(2.0 / 11.0);
  for (const double c : {9.0, 7.0, 5.0, 3.0, 1.0}) series = Pack(2.0 / c) - x2 * series;
  const Pack stretch = lane_by_lane(x2, series, x2.v >= 0.0025, [](double square) {
    const double x = std::sqrt(square);
    return 2.0 * std::atan(x) / x;
  });
  for (int i = 0; i < 3; ++i) v[i] = stretch * (v[i] / w);
  for (int l = 0; l < Pack::width; ++l) {
    if (!(trace[l] <= 0.0)) continue;
    Mat3 one;
    for (int e = 0; e < 9; ++e) one.data()[e] = R.data()[e][l];
    set_lane(v, l, drift::rotation_vector(one));
  }
  return v;
}

/// Whether the last node of an interval and the first of the next are the same for the terms.
bool go_on_alike(const Timeline& timeline, const Interval& a, const Interval& b, bool see_more) {
  return !b.cage && a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop &&
         timeline.nodes[a.last_node()].omega_ic_l == timeline.nodes[b.first_node].omega_ic_l &&
         (!see_more || moment_at(timeline, a, a.t1) == moment_at(timeline, b, b.t0));
}

/// What each lane has measured in a sample, zero where it has not.
void read(const Mat3X Measurements::*what, std::size_t sample,
          const LaneIntervals::Recordings& recordings, LaneFilter::Scalars& scalars) {
  for (int a = 0; a < 3; ++a) {
    const auto of = [&](int l) {
      return (recordings[static_cast<std::size_t>(l)]->*what)(a, static_cast<Eigen::Index>(sample));
    };
    scalars.nu[a] = Pack::of_each([&](int l) { return std::isfinite(of(l)) ? of(l) : 0.0; });
    scalars.on[a] = Pack::of_each([&](int l) { return std::isfinite(of(l)) ? 1.0 : 0.0; });
  }
}

}  // namespace

bool LaneIntervals::can(const FilterSpec& filter, const Timeline& timeline) {
  const DriftModel model = filter.model();
  return LaneLinearizer::can(model) && !has_outliers(model.terms) &&
         filter.noise.angle_random_walk == 0.0 &&
         walking_states(filter, make_layout(filter)).empty() &&
         std::ranges::none_of(timeline.intervals, [](const Interval& i) { return i.rest; });
}

LaneIntervals::LaneIntervals(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout)
    : LaneIntervals(filter, timeline, nullptr, readout) {}

LaneIntervals::LaneIntervals(const FilterSpec& filter, const CompressedTest& test,
                             const Readout& readout)
    : LaneIntervals(filter, test.timeline(), &test, readout) {}

LaneIntervals::LaneIntervals(const FilterSpec& filter, const Timeline& timeline,
                             const CompressedTest* compressed, const Readout& readout)
    : filter_(filter),
      timeline_(timeline),
      compressed_(compressed),
      readout_(readout),
      layout_(make_layout(filter)),
      linearizer_(filter.model(), layout_, readout),
      see_more_(!all_in_lanes(filter.model().terms)),
      attitude_(layout_, linearizer_.readout()),
      H_rate_(3 * layout_.num_rate),
      H_par_(linearizer_.readout().size()),
      rest_G_(H_rate_),
      path_(timeline.nodes.size()) {
  require_covariates(linearizer_.model(), timeline);
  std::size_t most = 0;
  for (const Interval& i : timeline.intervals) most = std::max(most, i.node_count());
  jacobian_.assign(most, linearizer_.make());
  Phi_.resize(most);
  weighted_H_.resize(most);
  weight_.resize(most);
  G_.assign(most, std::vector<Pack>(3 * layout_.num_rate, Pack(0.0)));
}

PackVec LaneIntervals::turned(std::size_t node, const PackVec& psi, const PackVec& phi) const {
  const Mat3 R_ri = (timeline_.nodes[node].R_il * timeline_.nodes[node].R_lr).transpose();
  const PackMat R = times(rotation(times_vector(in_all_lanes(R_ri), psi)), rotation(phi));
  return rotation_vector(R);
}

void LaneIntervals::set_theta(const std::vector<Pack>& x) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    linearizer_.theta()[layout_.params[k]] =
        Pack(layout_.mean[at]) + Pack(layout_.sigma[at]) * x[k];
  }
}

void LaneIntervals::cage(const Interval& interval) {
  const Node& node = timeline_.nodes[interval.first_node];
  PackVec psi;
  for (int l = 0; l < Pack::width; ++l)
    set_lane(psi, l, node.R_il * (node.R_lr * -lane_of(path_[interval.first_node], l)));
  attitude_.cage(psi, filter_.initial_attitude);
}

void LaneIntervals::evaluate(std::size_t i, bool follows) {
  const Interval& interval = timeline_.intervals[i];
  const std::size_t nodes = interval.node_count();
  const Mat3 E_loop = misalignment_matrix(linearizer_.model().mounting, interval.loop);
  const bool shared =
      follows && go_on_alike(timeline_, timeline_.intervals[i - 1], interval, see_more_);
  if (shared) std::swap(jacobian_[0], jacobian_[timeline_.intervals[i - 1].node_count() - 1]);
  for (std::size_t k = shared ? 1 : 0; k < nodes; ++k)
    linearizer_.evaluate(timeline_, timeline_.nodes[interval.first_node + k], interval, E_loop,
                         path_[interval.first_node + k], jacobian_[k]);
}

void LaneIntervals::linearize(std::size_t i, bool follows, const LaneStretch::Sums& readings,
                              LaneStretch& stretch) {
  evaluate(i, follows);
  stretch.work_out(*compressed_, i, jacobian_, &path_[timeline_.intervals[i].first_node],
                   linearizer_, readings);
}

/// propagate_sensitivity (linearize.hpp), in lanes.
void LaneIntervals::linearize(std::size_t i, bool follows) {
  evaluate(i, follows);
  const Interval& interval = timeline_.intervals[i];
  const std::size_t nodes = interval.node_count();
  const double h = interval.length() / (2.0 * interval.substeps);
  Phi_[0] = in_all_lanes(Mat3::Identity());
  for (std::size_t k = 0; k + 2 < nodes; k += 2) {
    const LaneJacobian &j0 = jacobian_[k], &j1 = jacobian_[k + 1], &j2 = jacobian_[k + 2];
    const TwoSteps<Pack> two(j0.A, j1.A, j2.A, h);
    const PackMat &Phi1 = two.to_middle, &Phi2 = two.to_end;
    const PackMat from_end = small_exponential<Pack>(-two.log_of_second),
                  from_middle = small_exponential<Pack>(two.log_of_second);
    Phi_[k + 1] = times(Phi1, Phi_[k]);
    Phi_[k + 2] = times(Phi2, Phi_[k]);
    const PackMat of0 = scaled(h * 5.0 / 12.0, Phi1), of2 = scaled(-h / 12.0, from_end),
                  end0 = scaled(h / 3.0, Phi2), end1 = scaled(h * 4.0 / 3.0, from_middle);
    const Pack of1(h * 8.0 / 12.0), end2(h / 3.0);
    for (std::size_t c = 0; c < 3 * layout_.num_rate; c += 3) {
      const Pack *b0 = &j0.B[c], *b1 = &j1.B[c], *b2 = &j2.B[c], *g = &G_[k][c];
      for (int a = 0; a < 3; ++a) {
        const auto at = static_cast<std::size_t>(a);
        Pack middle = row_times(of2, a, b2, row_times(of0, a, b0, of1 * b1[at]));
        Pack end = row_times(end1, a, b1, row_times(end0, a, b0, end2 * b2[at]));
        if (k > 0) {
          middle = row_times(Phi1, a, g, middle);
          end = row_times(Phi2, a, g, end);
        }
        G_[k + 1][c + at] = middle;
        G_[k + 2][c + at] = end;
      }
    }
  }
}

void LaneIntervals::to_middle(const Interval& interval) {
  const auto middle = static_cast<std::size_t>(interval.substeps);
  attitude_.propagate(Phi_[middle], G_[middle]);
}

void LaneIntervals::to_end(const Interval& interval) {
  const std::size_t last = interval.node_count() - 1;
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const PackMat Phi_rest = times(Phi_[last], Phi_[middle].inverse().eval());
  const PackMat minus = -Phi_rest;
  for (std::size_t c = 0; c < rest_G_.size(); c += 3)
    for (int a = 0; a < 3; ++a) {
      const auto at = c + static_cast<std::size_t>(a);
      rest_G_[at] = row_times(minus, a, &G_[middle][c], G_[last][at]);
    }
  attitude_.propagate(Phi_rest, rest_G_);
}

void LaneIntervals::through(const Interval& interval) {
  const std::size_t last = interval.node_count() - 1;
  attitude_.propagate(Phi_[last], G_[last]);
}

/// mean_output (linearize.hpp), in lanes.
LaneFilter::Scalars LaneIntervals::read_accelerometers(std::size_t i,
                                                       const Recordings& recordings) {
  LaneFilter::Scalars scalars;
  read(&Measurements::acc, first_sample(i), recordings, scalars);
  const Interval& interval = timeline_.intervals[i];
  const std::size_t nodes = interval.node_count();
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const PackMat from_middle = Phi_[middle].inverse().eval();
  PackVec mean = PackVec::Zero();
  scalars.H_psi.setZero();
  for (std::size_t k = 0; k < nodes; ++k) {
    const double w = Timeline::mean_weight(interval.substeps, k);
    const LaneJacobian& j = jacobian_[k];
    weight_[k] = Pack(w);
    weighted_H_[k] = scaled(w, j.H);
    scalars.H_psi += times(weighted_H_[k], times(Phi_[k], from_middle));
    for (int a = 0; a < 3; ++a) mean[a] = mul_add(weight_[k], j.acc[a], mean[a]);
  }
  for (std::size_t e = 0; e < H_par_.size(); ++e) {
    Pack sum(0.0);
    for (std::size_t k = 0; k < nodes; ++k) sum = mul_add(weight_[k], jacobian_[k].H_par[e], sum);
    H_par_[e] = sum;
  }
  const PackMat minus = -scalars.H_psi;
  for (std::size_t c = 0; c < H_rate_.size(); c += 3) {
    Pack h[3] = {Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::size_t k = 1; k < nodes; ++k)  // G is zero at the first
      for (int a = 0; a < 3; ++a) h[a] = row_times(weighted_H_[k], a, &G_[k][c], h[a]);
    for (int a = 0; a < 3; ++a)
      H_rate_[c + static_cast<std::size_t>(a)] = row_times(minus, a, &G_[middle][c], h[a]);
  }
  for (int a = 0; a < 3; ++a) scalars.nu[a] = scalars.on[a] * (scalars.nu[a] - mean[a]);
  scalars.H_rate = &H_rate_;
  scalars.H_par = &H_par_;
  scalars.sigma = interval.accelerometer_noise(readout_.accelerometer_noise);
  return scalars;
}

/// predict_gimbals (gimbal_prediction.hpp), in lanes.
LaneFilter::Scalars LaneIntervals::read_gimbals(std::size_t i, const Recordings& recordings) {
  LaneFilter::Scalars scalars;
  read(&Measurements::gimbal, first_sample(i), recordings, scalars);
  const Interval& interval = timeline_.intervals[i];
  const std::size_t last = interval.last_node();
  const LaneLinearizer::Gimbals predicted =
      linearizer_.gimbals(timeline_.nodes[last], interval.heading1, path_[last]);
  for (int a = 0; a < 3; ++a)
    scalars.nu[a] = scalars.on[a] * angle_difference(scalars.nu[a], predicted.angles[a]);
  scalars.H_psi = predicted.H;
  scalars.sigma = interval.gimbal_noise(readout_.gimbal_noise);
  return scalars;
}

}  // namespace drift
