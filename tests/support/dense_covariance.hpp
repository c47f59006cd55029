#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::test {

/// The covariance of all rows of a linearised test by its definition, shape (rows, rows): each kind
/// of noise has a covariance over time in closed form and a weight on each row. Slow, and without
/// any of the Whitener's recursions.
///
/// Time stands still but at the beginning of a recording and at the ends of half intervals.
/// Accelerometer rows are read at the end of the first half, gimbal rows at the end of the second;
/// what drives the platform acts through each half with the value it had when that began, but for
/// white rate noise. Nothing
/// but the parameters ties one recording to another.
class DenseCovariance {
 public:
  DenseCovariance(const inference::MeasuredRows& problem, const inference::NoiseModel& noise)
      : p_(problem), n_(noise), V_(MatX::Zero(problem.rows(), problem.rows())) {
    for (std::size_t i = 0; i < p_.drives.size(); ++i) {
      if (i == 0 || p_.drives[i].begins) {
        time_.push_back(0.0);
        recording_.push_back(recording_.empty() ? 0 : recording_.back() + 1);
      }
      for (const double gap : {p_.drives[i].gap, 0.0}) {
        const std::size_t half = begin_.size();
        caged_.push_back(begins_chain(half) ? half : caged_.back());
        begin_.push_back(time_.size() - 1);
        time_.push_back(time_.back() + gap + 0.5 * p_.drives[i].length);
        recording_.push_back(recording_.back());
      }
    }
    add_instruments();
    for (int axis = 0; axis < 3; ++axis) add_axis(axis);
    add_lone();
  }
  const MatX& all() const { return V_; }

 private:
  using Equation = inference::Equation;

  bool begins_chain(std::size_t half) const {
    return half == 0 || (half % 2 == 0 && p_.drives[half / 2].cage);
  }
  std::size_t half_of(Eigen::Index row) const {
    return 2 * p_.tags[row].interval + (p_.tags[row].accelerometer() ? 0 : 1);
  }

  void add_instruments() {
    for (Eigen::Index k = 0; k < V_.rows(); ++k) {
      const double factor = p_.tags[k].accelerometer() ? n_.acc_factor : n_.gimbal_factor;
      V_(k, k) += std::pow(factor / p_.weight[k], 2);
      for (Eigen::Index l = 0; l < V_.rows(); ++l)  // the attitude at the caging, unit prior
        if (caged_[half_of(k)] == caged_[half_of(l)]) V_(k, l) += p_.psi.row(k).dot(p_.psi.row(l));
    }
  }
  void add_axis(int axis) {
    const auto drift = [&](std::size_t half) {
      return Vec3(0.5 * n_.gyros[axis] * p_.drives[half / 2].per_rate.col(axis));
    };
    add(n_.drift_random_walk * driven(drift), kernel(forever_));
    add(n_.markov_drift * driven(drift), kernel(n_.markov_tau));
    add(n_.caging_drift * driven(drift), same_chain());
    add_angle_random_walk(axis);
    add(n_.acc_markov / p_.acc_sigma * read(axis), kernel(n_.acc_tau));
  }
  /// White rate noise, of which accelerometer rows feel the mean over an interval of what it has
  /// turned, gimbal rows its end: of a Wiener process W over unit time var(W) = 1, cov(W, mean) =
  /// 1 / 2, var(mean) = 1 / 3.
  void add_angle_random_walk(int axis) {
    const auto passed = [&](Eigen::Index row, std::size_t i) { return half_of(row) > 2 * i; };
    for (Eigen::Index k = 0; k < V_.rows(); ++k)
      for (Eigen::Index l = 0; l < V_.rows(); ++l) {
        if (caged_[half_of(k)] != caged_[half_of(l)]) continue;
        const std::size_t last = std::min(half_of(k), half_of(l)) / 2;
        for (std::size_t i = caged_[half_of(k)] / 2; i <= last; ++i) {
          const double share = passed(k, i) && passed(l, i)   ? 1.0
                               : passed(k, i) || passed(l, i) ? 1.0 / 2.0
                                                              : 1.0 / 3.0;
          const Vec3 turn = n_.gyros[axis] * n_.angle_random_walk * p_.drives[i].per_rate.col(axis);
          V_(k, l) +=
              share / p_.drives[i].length * p_.psi.row(k).dot(turn) * p_.psi.row(l).dot(turn);
        }
      }
  }
  void add_lone() {
    const inference::LoneInput& lone = n_.lone;
    if (lone.equation == Equation::rate)
      add(lone.sigma * driven([&](std::size_t half) {
            return Vec3(0.5 * p_.drives[half / 2].per_rate.col(lone.axis));
          }),
          kernel(lone.tau));
    else if (lone.equation == Equation::accelerometer)
      add(lone.sigma / p_.acc_sigma * read(lone.axis), kernel(lone.tau));
    else
      add(lone.sigma / p_.gimbal_sigma * read(3 + lone.axis), kernel(lone.tau));
  }

  /// Weights of rows on the values at the times time_, if they drive the platform.
  template <class PerHalf>
  MatX driven(PerHalf&& per_half) const {
    MatX W = MatX::Zero(V_.rows(), times());
    for (Eigen::Index k = 0; k < V_.rows(); ++k)
      for (std::size_t half = caged_[half_of(k)]; half <= half_of(k); ++half)
        W(k, static_cast<Eigen::Index>(begin_[half])) = p_.psi.row(k) * per_half(half);
    return W;
  }
  /// The same of what is read in one channel.
  MatX read(int channel) const {
    MatX W = MatX::Zero(V_.rows(), times());
    for (Eigen::Index k = 0; k < V_.rows(); ++k)
      if (p_.tags[k].channel == channel)
        W(k, static_cast<Eigen::Index>(begin_[half_of(k)] + 1)) = 1.0;
    return W;
  }
  /// A stationary Markov process of unit variance; of no end, a random walk from zero.
  MatX kernel(double tau) const {
    MatX K(times(), times());
    for (Eigen::Index a = 0; a < times(); ++a)
      for (Eigen::Index b = 0; b < times(); ++b)
        K(a, b) = recording_[a] != recording_[b] ? 0.0
                  : std::isinf(tau)              ? std::min(time_[a], time_[b])
                                                 : std::exp(-std::abs(time_[a] - time_[b]) / tau);
    return K;
  }
  /// A value for each chain.
  MatX same_chain() const {
    MatX K = MatX::Zero(times(), times());
    for (std::size_t a = 0; a < begin_.size(); ++a)
      for (std::size_t b = 0; b < begin_.size(); ++b)
        if (caged_[a] == caged_[b])
          K(static_cast<Eigen::Index>(begin_[a]), static_cast<Eigen::Index>(begin_[b])) = 1.0;
    return K;
  }
  void add(const MatX& W, const MatX& K) { V_ += W * K * W.transpose(); }
  Eigen::Index times() const { return static_cast<Eigen::Index>(time_.size()); }

  static constexpr double forever_ = std::numeric_limits<double>::infinity();
  const inference::MeasuredRows& p_;
  const inference::NoiseModel& n_;
  std::vector<double> time_;            ///< from the beginning of its recording on [s]
  std::vector<std::size_t> recording_;  ///< of each time
  std::vector<std::size_t> begin_;      ///< of each half: its time; its end is the next one
  std::vector<std::size_t> caged_;      ///< half with which the chain of a half began
  MatX V_;
};

}  // namespace drift::test
