#include "core/estimate/measurement_equations.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/estimate/rest_rate.hpp"

namespace drift {
namespace {

constexpr std::size_t at_once = 32;  // intervals that are linearised together
constexpr Eigen::Index rows_of_interval = 6;

bool read_in(const Mat3X& channel, std::size_t i) {
  return channel.col(static_cast<Eigen::Index>(i)).array().isFinite().any();
}

/// Whether the accelerometers were read in most intervals; where they were not, intervals are
/// better looked at one by one.
bool mostly_read(const MeasuredTest& test) {
  if (!test.readout.accelerometers) return true;
  std::size_t read = 0;
  const std::size_t all = test.timeline.intervals.size();
  for (std::size_t i = 0; i < all; ++i) read += read_in(test.measured.acc, i) ? 1 : 0;
  return 2 * read > all;
}

}  // namespace

MeasurementEquations::MeasurementEquations(const MeasuredTest& test, const DriftModel& model,
                                           const Layout& layout, double sigma_attitude)
    : MeasurementEquations(test, nullptr, model, layout, sigma_attitude) {}

MeasurementEquations::MeasurementEquations(const CompressedTest& test, const DriftModel& model,
                                           const Layout& layout, double sigma_attitude)
    : MeasurementEquations(test.test(), &test, model, layout, sigma_attitude) {}

MeasurementEquations::MeasurementEquations(const MeasuredTest& test,
                                           const CompressedTest* compressed,
                                           const DriftModel& model, const Layout& layout,
                                           double sigma_attitude)
    : test_((DRIFT_DEMAND(is_along(test.measured, test.timeline)), test)),
      compressed_(compressed),
      model_(model),
      layout_(layout),
      sigma_attitude_(sigma_attitude),
      linearizer_(model, layout, test.readout),
      memory_(test.timeline, model),
      jacobians_(test.timeline, model),
      together_(compressed || mostly_read(test)),
      G_(padded_rows(layout.num_rate)),
      G_next_(G_),
      Y_rate_(G_),
      Y_par_(padded_rows(layout.size() - layout.num_rate)),
      some_(rows_of_interval * static_cast<Eigen::Index>(at_once),
            3 + static_cast<Eigen::Index>(layout.size()) + 1),
      count_(static_cast<std::size_t>(test.timeline.chains), 0),
      stretch_(layout) {
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    Eigen::Index& count = count_[static_cast<std::size_t>(test.timeline.intervals[i].chain)];
    if (const StretchReadings* s = compressed ? compressed->readings(i) : nullptr)
      count += s->accelerometers.rows() + s->gimbals.rows();
    if (test.readout.accelerometers)
      count += test.measured.acc.col(column).array().isFinite().count();
    if (test.readout.gimbals) count += test.measured.gimbal.col(column).array().isFinite().count();
  }
}

std::vector<ChainEquations> MeasurementEquations::at(const Theta& theta, const Trajectory& phi) {
  std::vector<ChainEquations> chains;
  for (const Eigen::Index rows : count_) chains.push_back({MatX(rows, some_.cols())});
  std::vector<Eigen::Index> handed_over(count_.size(), 0);
  memory_.trace(theta.data());
  in_some_ = 0;
  too_rough_.clear();
  linearizer_.set_theta(theta);
  const auto& intervals = test_.timeline.intervals;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    enter(intervals[i]);
    linearize(i, phi);
    const auto chain = static_cast<std::size_t>(intervals[i].chain);
    take_stretch(i, phi, chains[chain].rows, handed_over[chain]);
    take_accelerometers(i);
    leave(intervals[i]);
    take_gimbals(i, phi);
    const bool last = i + 1 == intervals.size() || intervals[i + 1].chain != intervals[i].chain;
    if (last || in_some_ + rows_of_interval > some_.rows())
      hand_over(chains[chain].rows, handed_over[chain]);
  }
  return chains;
}

void MeasurementEquations::enter(const Interval& interval) {
  if (!interval.cage) return;
  Phi_.setIdentity();
  G_.setZero();
}

void MeasurementEquations::linearize(std::size_t i, const Trajectory& phi) {
  const auto& [timeline, readout, measured] = test_;
  const Interval& interval = timeline.intervals[i];
  if (together_) {
    if (i % at_once == 0)
      jacobians_.evaluate(i, std::min(i + at_once, timeline.intervals.size()), phi.data(),
                          linearizer_, &memory_);
    const StretchReadings* stretch = compressed_ ? compressed_->readings(i) : nullptr;
    if (stretch)
      stretch_.propagate(*stretch, interval, jacobians_.of(i), inner_);
    else
      propagate_sensitivity(interval, timeline, jacobians_.of(i), inner_);
    return;
  }
  readout.accelerometers&& read_in(measured.acc, i) ? linearizer_.work_readout_out()
                                                    : linearizer_.leave_readout_out();
  linearize_interval(interval, timeline, misalignment_matrix(model_.mounting, interval.loop),
                     &phi[interval.first_node], memory_.points(interval), linearizer_, inner_);
}

void MeasurementEquations::take_accelerometers(std::size_t i) {
  const auto& [timeline, readout, measured] = test_;
  if (!readout.accelerometers || !read_in(measured.acc, i)) return;
  const Interval& interval = timeline.intervals[i];
  Vec3 mean = Vec3::Zero();
  Mat3 Y_psi = Mat3::Zero();  // by the attitude at the start of the interval
  Y_rate_.setZero();
  Y_par_.setZero();
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const double w = Timeline::mean_weight(interval.substeps, k);
    const NodeJacobian& j = inner_.jacobian[k];
    mean += w * j.acc;
    Y_psi += w * j.H * inner_.Phi[k];
    if (k > 0) sum_of_products<Sum::onto>({w * j.H}, {&inner_.G[k]}, Y_rate_);  // G[0] is zero
    if (Y_par_.cols() > 0) Y_par_ += w * j.H_par;
  }
  sum_of_products<Sum::onto>({Y_psi}, {&G_}, Y_rate_);
  Y_psi = (Y_psi * Phi_).eval();
  const double sigma = interval.accelerometer_noise(readout.accelerometer_noise);
  for (int a = 0; a < 3; ++a)
    if (const double m = measured.acc(a, static_cast<Eigen::Index>(i)); std::isfinite(m))
      add_row(m - mean[a], Y_psi.row(a), a, sigma);
}

/// All that was read along a stretch, at once.
void MeasurementEquations::take_stretch(std::size_t i, const Trajectory& phi, MatX& rows,
                                        Eigen::Index& done) {
  const StretchReadings* readings = compressed_ ? compressed_->readings(i) : nullptr;
  if (!readings) return;
  hand_over(rows, done);
  const Interval& interval = test_.timeline.intervals[i];
  double tail = 0.0;
  if (readings->accelerometers.rows() > 0) {
    add_rows(stretch_.accelerometers(readings->accelerometers, interval, inner_), rows, done);
    tail += stretch_.tail();
  }
  if (readings->gimbals.rows() > 0) {
    add_rows(stretch_.gimbals(readings->gimbals, test_.timeline, interval, inner_,
                              &phi[interval.first_node], memory_.points(interval), linearizer_),
             rows, done);
    tail += stretch_.tail();
  }
  if (!(tail < StretchRows::negligible)) too_rough_.push_back(i);
}

/// Rows over the attitude at the beginning of the interval, as rows over that at the caging.
void MeasurementEquations::add_rows(const StretchRows::Rows& from, MatX& rows, Eigen::Index& done) {
  const auto nr = static_cast<Eigen::Index>(layout_.num_rate);
  auto to = rows.middleRows(done, from.rows());
  to.rightCols(from.cols() - 3) = from.rightCols(from.cols() - 3);
  to.middleCols(3, nr) += from.leftCols<3>() * G_.leftCols(nr);
  to.leftCols<3>() = sigma_attitude_ * from.leftCols<3>() * Phi_;
  done += from.rows();
}

/// On to the end of the interval.
void MeasurementEquations::leave(const Interval& interval) {
  const std::size_t last = interval.node_count() - 1;
  G_next_ = inner_.G[last];
  sum_of_products<Sum::onto>({inner_.Phi[last]}, {&G_}, G_next_);
  G_.swap(G_next_);
  Phi_ = (inner_.Phi[last] * Phi_).eval();
}

void MeasurementEquations::take_gimbals(std::size_t i, const Trajectory& phi) {
  const auto& [timeline, readout, measured] = test_;
  if (!readout.gimbals || !read_in(measured.gimbal, i)) return;
  const Interval& interval = timeline.intervals[i];
  const std::size_t last = interval.node_count() - 1;
  const MemoryPoint* memory = memory_.points(interval);
  const GimbalPrediction p =
      interval.rest ? predict_rest_rate(interval, timeline, &phi[interval.first_node], inner_)
                    : linearizer_.gimbals(timeline, {&timeline.nodes[interval.last_node()],
                                                     &interval, phi[interval.last_node()],
                                                     memory ? memory + 2 * last : nullptr});
  if (p.H_rate.cols() > 0)
    Y_rate_ = p.H_rate;
  else
    Y_rate_.setZero();
  sum_of_products<Sum::onto>({p.H}, {&G_}, Y_rate_);
  if (p.H_par.cols() > 0)
    Y_par_ = p.H_par;
  else
    Y_par_.setZero();
  const Mat3 Y_psi = p.H * Phi_;
  for (int a = 0; a < 3; ++a)
    if (const double m = measured.gimbal(a, static_cast<Eigen::Index>(i)); std::isfinite(m))
      add_row(angle_difference(m, p.angles[a]), Y_psi.row(a), a,
              interval.gimbal_noise(readout.gimbal_noise));
}

void MeasurementEquations::add_row(double residual, const Eigen::RowVector3d& d_psi, int axis,
                                   double sigma) {
  const auto n = static_cast<Eigen::Index>(layout_.size());
  const auto nr = static_cast<Eigen::Index>(layout_.num_rate);
  auto row = some_.row(in_some_++);
  row.head<3>() = d_psi * (sigma_attitude_ / sigma);
  row.segment(3, nr) = Y_rate_.row(axis).head(nr) / sigma;
  row.segment(3 + nr, n - nr) = Y_par_.row(axis).head(n - nr) / sigma;
  row[3 + n] = residual / sigma;
}

void MeasurementEquations::hand_over(MatX& rows, Eigen::Index& done) {
  rows.middleRows(done, in_some_) = some_.topRows(in_some_);
  done += in_some_;
  in_some_ = 0;
}

std::vector<ChainEquations> measurement_equations(const MeasuredTest& test, const DriftModel& model,
                                                  const Layout& layout, const Theta& theta,
                                                  const Trajectory& phi, double sigma_attitude) {
  return MeasurementEquations(test, model, layout, sigma_attitude).at(theta, phi);
}

}  // namespace drift
