#include "analysis/inference/whitener.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

namespace drift::inference {
namespace {

/// Where each kind of state stands; -1: not there.
struct States {
  int white = -1, walk = -1, markov = -1, acc = -1, lone = -1, count = 3;

  explicit States(const NoiseModel& n) {
    if (n.angle_random_walk > 0.0) white = std::exchange(count, count + 3);
    if (n.drift_random_walk > 0.0) walk = std::exchange(count, count + 3);
    if (n.markov_drift > 0.0) markov = std::exchange(count, count + 3);
    if (n.acc_markov > 0.0) acc = std::exchange(count, count + 3);
    if (n.lone.sigma > 0.0) lone = std::exchange(count, count + 1);
  }
};

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Transition and noise over one half of an interval.
struct Step {
  MatX F, Q;
};

/// States are in units of their own sigma. White rate noise is constant within an interval, as the
/// simulator has it: the accelerometers' mean sees half of what the gimbals see at the end.
Step step_of(const States& s, const NoiseModel& n, const IntervalDrive& d, bool first_half) {
  const double dt = 0.5 * d.length, gap = first_half ? d.gap : 0.0;
  Step step{MatX::Identity(s.count, s.count), MatX::Zero(s.count, s.count)};
  const Mat3 part = 0.5 * d.per_rate * n.gyros.asDiagonal();
  if (s.white >= 0) {
    const Mat3 kick = part * (n.angle_random_walk / std::sqrt(d.length));
    if (first_half) {  // a new value, which acts at once
      step.F.block<3, 3>(s.white, s.white).setZero();
      step.Q.block<3, 3>(s.white, s.white).setIdentity();
      step.Q.block<3, 3>(0, s.white) = kick;
      step.Q.block<3, 3>(s.white, 0) = kick.transpose();
      step.Q.topLeftCorner<3, 3>() = kick * kick.transpose();
    } else {
      step.F.block<3, 3>(0, s.white) = kick;
    }
  }
  if (s.walk >= 0) {
    step.F.block<3, 3>(0, s.walk) = part * n.drift_random_walk;
    step.Q.block<3, 3>(s.walk, s.walk) = (dt + gap) * Mat3::Identity();
  }
  if (s.markov >= 0) {
    const double phi = std::exp(-(dt + gap) / n.markov_tau);
    step.F.block<3, 3>(0, s.markov) = part * n.markov_drift;
    step.F.block<3, 3>(s.markov, s.markov) = phi * Mat3::Identity();
    step.Q.block<3, 3>(s.markov, s.markov) = (1.0 - phi * phi) * Mat3::Identity();
  }
  if (s.acc >= 0) {
    const double phi = std::exp(-(dt + gap) / n.acc_tau);
    step.F.block<3, 3>(s.acc, s.acc) = phi * Mat3::Identity();
    step.Q.block<3, 3>(s.acc, s.acc) = (1.0 - phi * phi) * Mat3::Identity();
  }
  if (s.lone >= 0) {
    const bool walks = std::isinf(n.lone.tau);
    const double phi = walks ? 1.0 : std::exp(-(dt + gap) / n.lone.tau);
    step.F(s.lone, s.lone) = phi;
    step.Q(s.lone, s.lone) = walks ? dt + gap : 1.0 - phi * phi;
    if (n.lone.equation == LoneInput::Equation::rate)
      step.F.block<3, 1>(0, s.lone) = 0.5 * n.lone.sigma * d.per_rate.col(n.lone.axis);
  }
  return step;
}

/// Weight of the lone input on a row of its channel.
double lone_weight(const LinearProblem& p, const LoneInput& lone, int channel) {
  if (lone.equation == LoneInput::Equation::accelerometer && channel == lone.axis)
    return lone.sigma / p.acc_sigma;
  if (lone.equation == LoneInput::Equation::gimbal && channel == 3 + lone.axis)
    return lone.sigma / p.gimbal_sigma;
  return 0.0;
}

/// Walks along intervals and rows; calls cage(), move(step) and row(index, h, white sigma).
template <class Cage, class Move, class Row>
void walk(const LinearProblem& p, const NoiseModel& n, const States& s, Cage&& cage, Move&& move,
          Row&& row) {
  Eigen::Index k = 0;
  VecX h(s.count);
  for (std::size_t i = 0; i < p.drives.size(); ++i) {
    const IntervalDrive& d = p.drives[i];
    if (d.cage) cage(i);
    // Half of the interval's noise before its accelerometer rows, half before its gimbal rows.
    for (const bool accelerometer : {true, false}) {
      if (n.driven()) move(step_of(s, n, d, accelerometer));
      for (; k < p.rows() && p.tags[k].interval == i && p.tags[k].accelerometer() == accelerometer;
           ++k) {
        h.setZero();
        h.head<3>() = p.psi.row(k);
        if (accelerometer && s.acc >= 0) h[s.acc + p.tags[k].channel] = n.acc_markov / p.acc_sigma;
        if (s.lone >= 0) h[s.lone] = lone_weight(p, n.lone, p.tags[k].channel);
        row(k, h, (accelerometer ? n.acc_factor : n.gimbal_factor) / p.weight[k]);
      }
    }
  }
}

/// Before anything is measured: attitude at its prior, a random walk at zero, the others
/// stationary.
MatX initial_covariance(const States& s, const NoiseModel& n) {
  MatX P = MatX::Identity(s.count, s.count);
  if (s.walk >= 0) P.block<3, 3>(s.walk, s.walk).setZero();
  if (s.lone >= 0 && std::isinf(n.lone.tau)) P(s.lone, s.lone) = 0.0;
  return P;
}

}  // namespace

Whitener::Whitener(const LinearProblem& problem, const NoiseModel& noise) : root_(problem.rows()) {
  const States s(noise);
  states_ = s.count;
  H_.resize(s.count, problem.rows());
  gain_.resize(s.count, problem.rows());
  MatX P = initial_covariance(s, noise);
  Eigen::Index next = 0;
  walk(
      problem, noise, s,
      [&](std::size_t) {
        P.topRows<3>().setZero();
        P.leftCols<3>().setZero();
        P.topLeftCorner<3, 3>().setIdentity();
        events_.push_back({next, true, {}});
      },
      [&](const Step& step) {
        P = (step.F * P * step.F.transpose() + step.Q).eval();
        if (s.count > 3) events_.push_back({next, false, step.F});
      },
      [&](Eigen::Index k, const VecX& h, double sigma) {
        const VecX Ph = P * h;
        const double S = h.dot(Ph) + sigma * sigma;
        H_.col(k) = h;
        gain_.col(k) = Ph / S;
        root_[k] = std::sqrt(S);
        P -= gain_.col(k) * Ph.transpose();
        log_det_ += std::log(S);
        next = k + 1;
      });
}

MatX Whitener::apply(const MatX& columns, Eigen::Index first) const {
  RowMajor white = columns;
  RowMajor x = RowMajor::Zero(states_, columns.cols());  // state estimate of every column
  std::size_t event = 0;
  while (event < events_.size() && events_[event].row < first) ++event;
  for (Eigen::Index r = 0; r < white.rows(); ++r) {
    const Eigen::Index k = first + r;
    for (; event < events_.size() && events_[event].row == k; ++event) {
      if (events_[event].cage)
        x.topRows<3>().setZero();
      else
        x = (events_[event].F * x).eval();
    }
    auto e = white.row(r);
    for (int m = 0; m < states_; ++m)
      if (H_(m, k) != 0.0) e -= H_(m, k) * x.row(m);
    for (int m = 0; m < states_; ++m)
      if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * e;
    e /= root_[k];
  }
  return white;
}

MatX Whitener::colour(const MatX& white) const {
  RowMajor rows = white;
  RowMajor x = RowMajor::Zero(states_, white.cols());
  std::size_t event = 0;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    for (; event < events_.size() && events_[event].row == k; ++event) {
      if (events_[event].cage)
        x.topRows<3>().setZero();
      else
        x = (events_[event].F * x).eval();
    }
    auto y = rows.row(k);
    y *= root_[k];  // the innovation
    const Eigen::RowVectorXd innovation = y;
    for (int m = 0; m < states_; ++m)
      if (H_(m, k) != 0.0) y += H_(m, k) * x.row(m);
    for (int m = 0; m < states_; ++m)
      if (gain_(m, k) != 0.0) x.row(m) += gain_(m, k) * innovation;
  }
  return rows;
}

MatX dense_covariance(const LinearProblem& problem, const NoiseModel& noise) {
  // By definition: each row's weights on independent unit variables (prior, each step's noise).
  const States s(noise);
  MatX state(s.count, 0);
  const auto add = [&](const MatX& Q) {
    const Eigen::LDLT<MatX> ldlt(Q);
    MatX L = ldlt.matrixL();
    L = ldlt.transpositionsP().transpose() * L *
        ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    MatX wider(s.count, state.cols() + s.count);
    wider << state, L;
    state = wider;
  };
  MatX prior = initial_covariance(s, noise);
  prior.topLeftCorner<3, 3>().setZero();
  add(prior);
  std::vector<VecX> weights(problem.rows());
  VecX white(problem.rows());
  walk(
      problem, noise, s,
      [&](std::size_t) {
        state.topRows<3>().setZero();
        MatX fresh = MatX::Zero(s.count, s.count);
        fresh.topLeftCorner<3, 3>().setIdentity();
        add(fresh);
      },
      [&](const Step& step) {
        state = (step.F * state).eval();
        add(step.Q);
      },
      [&](Eigen::Index k, const VecX& h, double sigma) {
        weights[k] = state.transpose() * h;
        white[k] = sigma * sigma;
      });
  MatX all = MatX::Zero(problem.rows(), state.cols());
  for (Eigen::Index k = 0; k < problem.rows(); ++k) all.row(k).head(weights[k].size()) = weights[k];
  MatX V = all * all.transpose();
  V.diagonal() += white;
  return V;
}

}  // namespace drift::inference
