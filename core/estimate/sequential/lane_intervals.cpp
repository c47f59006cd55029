#include <algorithm>

#include "core/base/pack.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/sequential/iterated_lanes.hpp"
#include "core/estimate/transition.hpp"

namespace drift {
/// propagate_sensitivity (linearize.hpp), in lanes.
void IteratedLanes::linearize(std::size_t i, bool shared) {
  const Interval& interval = timeline_.intervals[i];
  const std::size_t nodes = interval.node_count();
  const Mat3 E_loop = misalignment_matrix(linearizer_.model().mounting, interval.loop);
  if (shared) std::swap(jacobian_[0], jacobian_[timeline_.intervals[i - 1].node_count() - 1]);
  for (std::size_t k = shared ? 1 : 0; k < nodes; ++k)
    linearizer_.evaluate(timeline_.nodes[interval.first_node + k], interval, E_loop,
                         path_[interval.first_node + k], jacobian_[k]);
  const double h = interval.length() / (2.0 * interval.substeps);
  Phi_[0] = in_all_lanes(Mat3::Identity());
  std::ranges::fill(G_[0], Pack(0.0));
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

/// IntervalRows::take, in lanes.
void IteratedLanes::take(std::size_t i, bool shared, Pass pass) {
  const Interval& interval = timeline_.intervals[i];
  linearize(i, shared);
  const std::size_t last = interval.node_count() - 1;
  const auto middle = static_cast<std::size_t>(interval.substeps);
  attitude_.propagate(Phi_[middle], G_[middle]);
  if (readout_.accelerometers) take_accelerometers(i, pass);
  const PackMat Phi_rest = times(Phi_[last], Phi_[middle].inverse().eval());
  const PackMat minus = -Phi_rest;
  for (std::size_t c = 0; c < rest_G_.size(); c += 3)
    for (int a = 0; a < 3; ++a) {
      const auto at = c + static_cast<std::size_t>(a);
      rest_G_[at] = row_times(minus, a, &G_[middle][c], G_[last][at]);
    }
  attitude_.propagate(Phi_rest, rest_G_);
  if (readout_.gimbals) take_gimbals(i, pass);
}

/// mean_output (linearize.hpp), in lanes.
void IteratedLanes::take_accelerometers(std::size_t i, Pass pass) {
  LaneFilter::Scalars scalars;
  read(&Measurements::acc, i, scalars);
  const Interval& interval = timeline_.intervals[i];
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const PackMat from_middle = Phi_[middle].inverse().eval();
  PackVec mean = PackVec::Zero();
  scalars.H_psi.setZero();
  std::ranges::fill(H_par_, Pack(0.0));
  std::ranges::fill(H_rate_, Pack(0.0));
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const double w = Timeline::simpson_weight(interval.substeps, k);
    const LaneJacobian& j = jacobian_[k];
    const PackMat weighted = scaled(w, j.H);
    scalars.H_psi += times(weighted, times(Phi_[k], from_middle));
    for (int a = 0; a < 3; ++a) mean[a] = mul_add(Pack(w), j.acc[a], mean[a]);
    for (std::size_t e = 0; e < H_par_.size(); ++e)
      H_par_[e] = mul_add(Pack(w), j.H_par[e], H_par_[e]);
    if (k == 0) continue;  // G is zero there
    for (std::size_t c = 0; c < H_rate_.size(); c += 3)
      for (int a = 0; a < 3; ++a) {
        Pack& h = H_rate_[c + static_cast<std::size_t>(a)];
        h = row_times(weighted, a, &G_[k][c], h);
      }
  }
  const PackMat minus = -scalars.H_psi;
  for (std::size_t c = 0; c < H_rate_.size(); c += 3)
    for (int a = 0; a < 3; ++a) {
      Pack& h = H_rate_[c + static_cast<std::size_t>(a)];
      h = row_times(minus, a, &G_[middle][c], h);
    }
  for (int a = 0; a < 3; ++a) scalars.nu[a] = scalars.on[a] * (scalars.nu[a] - mean[a]);
  scalars.H_rate = &H_rate_;
  scalars.H_par = &H_par_;
  scalars.sigma = interval.accelerometer_noise(readout_.accelerometer_noise);
  take_scalars(i, accelerometers, scalars, pass);
}

void IteratedLanes::take_gimbals(std::size_t i, Pass pass) {
  LaneFilter::Scalars scalars;
  read(&Measurements::gimbal, i, scalars);
  const Interval& interval = timeline_.intervals[i];
  for (int l = 0; l < Pack::width; ++l) {
    const GimbalPrediction one =
        predict_gimbals(timeline_.nodes[interval.last_node()], interval.heading1,
                        lane_of(path_[interval.last_node()], l));
    for (int a = 0; a < 3; ++a) {
      scalars.nu[a].set(l, scalars.on[a][l] * angle_difference(scalars.nu[a][l], one.angles[a]));
      for (int c = 0; c < 3; ++c) scalars.H_psi(a, c).set(l, one.H(a, c));
    }
  }
  scalars.sigma = readout_.gimbal_noise;
  take_scalars(i, gimbals, scalars, pass);
}

/// What each lane has measured in interval i, zero where it has not. What none has is taken in as
/// well: how rows come together must not hang on which runs do.
void IteratedLanes::read(const Mat3X Measurements::*what, std::size_t i,
                         LaneFilter::Scalars& scalars) const {
  for (int a = 0; a < 3; ++a) {
    const auto of = [&](int l) {
      return (lanes_[static_cast<std::size_t>(l)]->measured->*what)(a,
                                                                    static_cast<Eigen::Index>(i));
    };
    scalars.nu[a] = Pack::of_each([&](int l) { return std::isfinite(of(l)) ? of(l) : 0.0; });
    scalars.on[a] = Pack::of_each([&](int l) { return std::isfinite(of(l)) ? 1.0 : 0.0; });
  }
}

void IteratedLanes::take_scalars(std::size_t i, Channel channel, LaneFilter::Scalars& scalars,
                                 Pass pass) {
  if (information_.full()) information_.flush(pass == Pass::linear);
  information_.begin_rows(channel, !timeline_.intervals[i].cage);
  attitude_.update(scalars, information_);
  if (pass == Pass::linear) return;
  for (int a = 0; a < 3; ++a) {  // right hand sides count from the start
    Pack& right = information_.at(moved_.size())[4 * a];
    for (std::size_t k = 0; k < moved_.size(); ++k)
      right = mul_add(moved_[k], information_.at(k)[4 * a], right);
  }
}

}  // namespace drift
