#include "core/estimate/sequential/in_lanes/lane_stretch.hpp"

#include <algorithm>

#include "core/estimate/transition.hpp"

namespace drift {
namespace {

/// out = C x: of three numbers at each node (a column of C) three of each row.
void combine(const MatX& C, const Pack* x, Pack* out) {
  const Eigen::Index rows = C.rows(), nodes = C.cols();
  const auto some = [&]<int together>(Eigen::Index first, std::integral_constant<int, together>) {
    Pack sum[3 * together];
    for (Pack& s : sum) s = Pack(0.0);
    const double* c = C.data() + first;
    for (Eigen::Index k = 0; k < nodes; ++k, c += rows) {
      const Pack x0 = x[3 * k], x1 = x[3 * k + 1], x2 = x[3 * k + 2];
#pragma GCC unroll 6
      for (int r = 0; r < together; ++r) {
        const Pack factor(c[r]);
        sum[3 * r] = mul_add(factor, x0, sum[3 * r]);
        sum[3 * r + 1] = mul_add(factor, x1, sum[3 * r + 1]);
        sum[3 * r + 2] = mul_add(factor, x2, sum[3 * r + 2]);
      }
    }
    std::copy_n(sum, 3 * together, out + 3 * first);
  };
  Eigen::Index r = 0;
  for (; r + 6 <= rows; r += 6) some(r, std::integral_constant<int, 6>());
  for (; r + 2 <= rows; r += 2) some(r, std::integral_constant<int, 2>());
  for (; r < rows; ++r) some(r, std::integral_constant<int, 1>());
}

/// Numbers of each lane.
template <class Of>
Pack of_readings(const LaneStretch::Sums& readings, std::size_t i, Reading what, std::size_t axis,
                 Of&& of) {
  return Pack::of_each(
      [&](int l) { return of(readings[static_cast<std::size_t>(l)]->of(i, what)[axis]); });
}

}  // namespace

LaneFilter::Scalars LaneStretch::Channel::scalars(std::size_t row) const {
  LaneFilter::Scalars scalars;
  scalars.nu = residual[row];
  scalars.on = PackVec::Constant(Pack(1.0));
  scalars.H_psi = by_attitude[row];
  scalars.H_rate = &by_rate[row];
  scalars.H_par = by_readout.empty() ? nullptr : &by_readout[row];
  scalars.sigma = 1.0;
  return scalars;
}

void LaneStretch::resize(std::size_t nodes, std::size_t rate, std::size_t entries,
                         const CompressedTest& test, std::size_t i) {
  Phi_.resize(nodes);
  back_.resize(nodes);
  G_.resize(3 * rate);
  std::size_t most = nodes;
  for (const Reading what : {Reading::mean, Reading::at_end}) {
    const std::size_t c = what == Reading::mean ? 0 : 1;
    const bool read = c == 0 ? test.readout().accelerometers : test.readout().gimbals;
    const auto rows =
        static_cast<std::size_t>(read ? test.complete(i, what).projection.of_nodes.rows() : 0);
    Channel& channel = channels_[c];
    channel.rows_ = rows;
    if (rows > channel.residual.size()) {
      channel.by_attitude.resize(rows);
      channel.residual.resize(rows);
      channel.by_rate.resize(rows, std::vector<Pack>(3 * rate));
      if (c == 0) channel.by_readout.resize(rows, std::vector<Pack>(entries));
    }
    H_[c].resize(nodes);
    most = std::max(most, rows);
  }
  for (auto* work : {&turned_back_, &along_, &at_nodes_, &combined_}) work->resize(3 * most);
}

void LaneStretch::work_out(const CompressedTest& test, std::size_t i,
                           const std::vector<LaneJacobian>& jacobian, const PackVec* phi,
                           const LaneLinearizer& linearizer, const Sums& readings) {
  const Interval& interval = test.timeline().intervals[i];
  resize(interval.node_count(), jacobian[0].B.size() / 3, linearizer.readout().size(), test, i);
  transitions(interval, jacobian);
  for (const Reading what : {Reading::mean, Reading::at_end})
    if (channel(what).rows() > 0) predict(test, i, what, jacobian, phi, linearizer, readings);
  by_rate(test, i, jacobian);
  if (channels_[0].rows() > 0) by_readout(test.complete(i, Reading::mean), jacobian);
  tail_ = Pack(0.0);
  for (const Channel& c : channels_) measure_tail(c, linearizer.readout());
}

void LaneStretch::transitions(const Interval& interval, const std::vector<LaneJacobian>& jacobian) {
  const double h = interval.length() / (2.0 * interval.substeps);
  Phi_[0] = back_[0] = in_all_lanes(Mat3::Identity());
  for (std::size_t k = 0; k + 2 < Phi_.size(); k += 2) {
    const TwoSteps<Pack> two(jacobian[k].A, jacobian[k + 1].A, jacobian[k + 2].A, h);
    Phi_[k + 1] = times(two.to_middle, Phi_[k]);
    Phi_[k + 2] = times(two.to_end, Phi_[k]);
    back_[k + 1] = Phi_[k + 1].inverse().eval();
    back_[k + 2] = Phi_[k + 2].inverse().eval();
  }
}

/// What a channel reads at the nodes and its derivatives by the attitude there; rows by the
/// attitude at the beginning, and residuals.
void LaneStretch::predict(const CompressedTest& test, std::size_t i, Reading what,
                          const std::vector<LaneJacobian>& jacobian, const PackVec* phi,
                          const LaneLinearizer& linearizer, const Sums& readings) {
  const Interval& interval = test.timeline().intervals[i];
  const std::size_t c = what == Reading::mean ? 0 : 1;
  const MatX& of_nodes = test.complete(i, what).projection.of_nodes;
  Channel& channel = channels_[c];
  PackVec reference;
  for (std::size_t a = 0; a < 3; ++a)
    reference[static_cast<int>(a)] = of_readings(
        readings, i, what, a, [](const StretchSums::Axis& axis) { return axis.reference; });
  for (std::size_t k = 0; k < Phi_.size(); ++k) {
    PackVec beyond;
    if (what == Reading::mean) {
      H_[c][k] = jacobian[k].H;
      beyond = jacobian[k].acc - reference;
    } else {
      const auto p = linearizer.gimbals(test.timeline().nodes[interval.first_node + k],
                                        interval.heading1, phi[k]);
      H_[c][k] = p.H;
      for (int a = 0; a < 3; ++a) beyond[a] = angle_difference(p.angles[a], reference[a]);
    }
    for (std::size_t a = 0; a < 3; ++a) at_nodes_[3 * k + a] = beyond[static_cast<int>(a)];
  }
  combine(of_nodes, at_nodes_.data(), combined_.data());
  for (std::size_t p = 0; p < channel.rows(); ++p)
    for (std::size_t a = 0; a < 3; ++a)
      channel.residual[p][static_cast<int>(a)] =
          of_readings(readings, i, what, a,
                      [&](const StretchSums::Axis& axis) {
                        return axis.measured[static_cast<Eigen::Index>(p)];
                      }) -
          combined_[3 * p + a];
  for (int direction = 0; direction < 3; ++direction) {
    for (std::size_t k = 0; k < Phi_.size(); ++k) {
      const PackMat by_beginning = times(H_[c][k], Phi_[k]);
      for (std::size_t a = 0; a < 3; ++a)
        at_nodes_[3 * k + a] = by_beginning(static_cast<int>(a), direction);
    }
    combine(of_nodes, at_nodes_.data(), combined_.data());
    for (std::size_t p = 0; p < channel.rows(); ++p)
      for (std::size_t a = 0; a < 3; ++a)
        channel.by_attitude[p](static_cast<int>(a), direction) = combined_[3 * p + a];
  }
}

/// A rate state acts through the attitude: integrals of the polynomials through all nodes.
void LaneStretch::by_rate(const CompressedTest& test, std::size_t i,
                          const std::vector<LaneJacobian>& jacobian) {
  const MatX& integral = test.readings(i)->integral;
  const std::size_t nodes = Phi_.size();
  for (std::size_t s = 0; s < G_.size(); s += 3) {
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        turned_back_[3 * k + a] =
            row_times(back_[k], static_cast<int>(a), &jacobian[k].B[s], Pack(0.0));
    combine(integral, turned_back_.data(), combined_.data());
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        along_[3 * k + a] = row_times(Phi_[k], static_cast<int>(a), &combined_[3 * k], Pack(0.0));
    std::copy_n(&along_[3 * (nodes - 1)], 3, &G_[s]);
    for (const Reading what : {Reading::mean, Reading::at_end}) {
      const std::size_t c = what == Reading::mean ? 0 : 1;
      Channel& channel = channels_[c];
      if (channel.rows() == 0) continue;
      for (std::size_t k = 0; k < nodes; ++k)
        for (std::size_t a = 0; a < 3; ++a)
          at_nodes_[3 * k + a] =
              row_times(H_[c][k], static_cast<int>(a), &along_[3 * k], Pack(0.0));
      combine(test.complete(i, what).projection.of_nodes, at_nodes_.data(), combined_.data());
      for (std::size_t p = 0; p < channel.rows(); ++p)
        std::copy_n(&combined_[3 * p], 3, &channel.by_rate[p][s]);
    }
  }
}

void LaneStretch::by_readout(const AxisReading& how, const std::vector<LaneJacobian>& jacobian) {
  Channel& channel = channels_[0];
  const std::size_t entries = jacobian[0].H_par.size();
  for (std::size_t first = 0; first < entries; first += 3) {
    const std::size_t count = std::min<std::size_t>(3, entries - first);
    for (std::size_t k = 0; k < Phi_.size(); ++k)
      for (std::size_t e = 0; e < 3; ++e)
        at_nodes_[3 * k + e] = e < count ? jacobian[k].H_par[first + e] : Pack(0.0);
    combine(how.projection.of_nodes, at_nodes_.data(), combined_.data());
    for (std::size_t p = 0; p < channel.rows(); ++p)
      std::copy_n(&combined_[3 * p], count, &channel.by_readout[p][first]);
  }
}

void LaneStretch::measure_tail(const Channel& channel,
                               const std::vector<LaneLinearizer::Entry>& entries) {
  const std::size_t rows = channel.rows(), first = rows - std::min<std::size_t>(rows, 2);
  const auto add = [&](Pack& sum) { tail_ = Pack(std::experimental::max(tail_.v, sum.v)); };
  for (std::size_t s = 0; s < G_.size(); s += 3) {
    Pack sum(0.0);
    for (std::size_t p = first; p < rows; ++p)
      for (std::size_t a = 0; a < 3; ++a)
        sum = mul_add(channel.by_rate[p][s + a], channel.by_rate[p][s + a], sum);
    add(sum);
  }
  if (channel.by_readout.empty()) return;
  for (std::size_t e = 0; e < entries.size();) {
    const std::size_t state = entries[e].state;
    Pack sum(0.0);
    for (; e < entries.size() && entries[e].state == state; ++e)
      for (std::size_t p = first; p < rows; ++p)
        sum = mul_add(channel.by_readout[p][e], channel.by_readout[p][e], sum);
    add(sum);
  }
}

}  // namespace drift
