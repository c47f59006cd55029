#include "bench/practice_run.hpp"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench/dense_ekf.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/linearize.hpp"
#include "core/plan/case_heading.hpp"

namespace drift::bench {
namespace {

/// One stretch of constant command, as CVODE's user data.
struct Stretch {
  const Timeline* timeline = nullptr;
  Drive drive;
  Mat3 R_lr0;
  double t0 = 0.0;
};

int rate(realtype t, N_Vector y, N_Vector y_dot, void* data) {
  const auto& s = *static_cast<Stretch*>(data);
  const Mat3 R_lr = reference_attitude(s.timeline->site, s.R_lr0, s.drive.omega_cmd_p, t - s.t0);
  Eigen::Map<Vec3>(NV_DATA_S(y_dot)) =
      attitude_rate(s.drive, R_lr, Eigen::Map<Vec3>(NV_DATA_S(y)), t, nullptr);
  return 0;
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

}  // namespace

Trajectory practice_trajectory(const Timeline& timeline, const TruthSpec& truth,
                               const TruthDraw& draw, const OdeOptions& tolerances) {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector y = N_VNew_Serial(3, context);
  void* cvode = CVodeCreate(CV_ADAMS, context);
  SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(y, 0, context);
  const DriftModel model = truth.model();
  Stretch s;
  s.timeline = &timeline;
  Trajectory phi(timeline.nodes.size(), Vec3::Zero());
  bool first = true;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    const Node& node = timeline.nodes[interval.first_node];
    const bool same =
        i > 0 && !interval.cage && interval.omega_cmd_p == timeline.intervals[i - 1].omega_cmd_p &&
        std::abs(interval.heading_rate() - timeline.intervals[i - 1].heading_rate()) < 1e-15;
    if (!same) {
      s.drive = drive_of(interval, timeline, model, draw.theta);
      s.R_lr0 = node.R_lr;
      s.t0 = interval.t0;
      if (interval.cage)
        Eigen::Map<Vec3>(NV_DATA_S(y)) = caged_phi(node.R_lr, draw.psi0_l[interval.chain]);
      if (first) {
        check(CVodeInit(cvode, rate, interval.t0, y));
        check(CVodeSStolerances(cvode, 0.25 * tolerances.rel_tol, 0.25 * tolerances.abs_tol));
        check(CVodeSetUserData(cvode, &s));
        check(CVodeSetNonlinearSolver(cvode, solver));
        check(CVodeSetMaxNumSteps(cvode, 100000));
        first = false;
      } else {
        check(CVodeReInit(cvode, interval.t0, y));
      }
    }
    phi[interval.first_node] = Eigen::Map<Vec3>(NV_DATA_S(y));
    for (std::size_t k = 1; k < interval.node_count(); ++k) {
      const std::size_t n = interval.first_node + k;
      const double t_out = n == interval.last_node() ? interval.t1 : timeline.nodes[n].t;
      realtype reached = 0.0;
      check(CVodeSetStopTime(cvode, interval.t1));
      check(CVode(cvode, t_out, y, &reached, CV_NORMAL));
      phi[n] = Eigen::Map<Vec3>(NV_DATA_S(y));
    }
  }
  CVodeFree(&cvode);
  SUNNonlinSolFree(solver);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return phi;
}

namespace {

/// What a pass is linearised about: scaled parameters, and where the platform begins after each
/// caging [rad]. In between its attitude is the one that is filtered with them.
struct About {
  VecX x;
  std::vector<Vec3> starts;
};

/// A pass over a recording. about: null for the running estimate, as an EKF does. starts: where the
/// first sample after each caging says that the platform began.
EstimateResult practice_pass(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout, const Measurements& measured,
                             const Theta& start, const About* about, std::vector<Vec3>& starts) {
  const DriftModel model = filter.model();
  const Layout layout = make_layout(filter);
  const auto n = 3 + static_cast<Eigen::Index>(layout.size());
  const auto nr = static_cast<Eigen::Index>(layout.num_rate);
  DenseCovariance kalman(n, DenseForm::textbook);
  const VecX x0 = layout.scaled(start);
  VecX x = about ? about->x : x0;  // what is linearised about
  kalman.x.tail(n - 3) = x0 - x;
  Theta theta = layout.theta_at(x);
  Linearizer linearizer(model, layout, readout);
  IntervalSensitivity s;
  MatX F = MatX::Identity(n, n), Q = MatX::Zero(n, n);
  DenseCovariance::Mat3N H = DenseCovariance::Mat3N::Zero(3, n);
  std::vector<Vec3> phi(64);
  Vec3 now = Vec3::Zero();
  EstimateResult result;
  const double arw = filter.noise.angle_random_walk;
  const auto turn = [&](const Node& node, Vec3& attitude) {  // to where the filter has it
    const Vec3 psi_r = node.R_lr.transpose() * (node.R_il.transpose() * kalman.x.head<3>());
    attitude = rotation_vector(rotation(psi_r) * rotation(attitude));
    kalman.x.head<3>().setZero();
  };
  const auto take = [&](const Vec3& off, double sigma, const Node& node, Vec3& attitude) {
    const Vec3 nu = off - H * kalman.x;
    const Mat3 S = H * kalman.P * H.transpose() + sigma * sigma * Mat3::Identity();
    result.statistic += nu.dot(S.inverse() * nu);
    result.measured += 3;
    kalman.update(nu, H, sigma * sigma);
    if (about) return;
    x += kalman.x.tail(n - 3);
    turn(node, attitude);
    kalman.x.setZero();
    theta = layout.theta_at(x);
  };
  const auto propagate = [&] {
    kalman.propagate(F, Q);
    if (about) kalman.x = F * kalman.x;
  };
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    const auto chain = static_cast<std::size_t>(interval.chain);
    if (interval.cage) {
      const Node& first = timeline.nodes[interval.first_node];
      now = about ? about->starts[chain] : Vec3(Vec3::Zero());
      kalman.x.head<3>() = first.R_il * (first.R_lr * -now);
      kalman.P.topRows<3>().setZero();
      kalman.P.leftCols<3>().setZero();
      kalman.P.diagonal().head<3>().setConstant(filter.initial_attitude * filter.initial_attitude);
    }
    linearizer.set_theta(theta);
    phi.resize(std::max(phi.size(), interval.node_count()));
    phi[0] = now;
    step_through(interval, timeline, drive_of(interval, timeline, model, theta), nullptr,
                 phi.data());
    linearize_interval(interval, timeline, Mat3::Zero(), phi.data(), nullptr, linearizer, s);
    const std::size_t last = interval.node_count() - 1,
                      m = static_cast<std::size_t>(interval.substeps);
    Q.topLeftCorner<3, 3>() = 0.5 * arw * arw * interval.length() * Mat3::Identity();
    F.topLeftCorner<3, 3>() = s.Phi[m];
    F.block(0, 3, 3, nr) = s.G[m].leftCols(nr);
    propagate();
    if (readout.accelerometers) {
      H.setZero();
      Vec3 mean = Vec3::Zero();
      const Mat3 back = s.Phi[m].inverse();
      for (std::size_t k = 0; k <= last; ++k) {
        const double w = Timeline::mean_weight(interval.substeps, k);
        mean += w * s.jacobian[k].acc;
        H.leftCols<3>() += w * s.jacobian[k].H * s.Phi[k] * back;
        H.middleCols(3, nr) +=
            w * s.jacobian[k].H * (s.G[k] - s.Phi[k] * back * s.G[m]).leftCols(nr);
        H.rightCols(n - 3 - nr) += w * s.jacobian[k].H_par.leftCols(n - 3 - nr);
      }
      take(measured.acc.col(i) - mean, readout.accelerometer_noise,
           timeline.nodes[interval.first_node + m], phi[m]);
      if (!about)
        step_through(interval, timeline, drive_of(interval, timeline, model, theta), nullptr,
                     phi.data(), m);
    }
    F.topLeftCorner<3, 3>() = s.Phi[last] * s.Phi[m].inverse();
    F.block(0, 3, 3, nr) = (s.G[last] - F.topLeftCorner<3, 3>() * s.G[m]).leftCols(nr);
    propagate();
    now = phi[last];
    const Node& node = timeline.nodes[interval.last_node()];
    if (readout.gimbals) {
      const GimbalPrediction p = predict_gimbals(node, interval.heading1, now);
      H.setZero();
      H.leftCols<3>() = p.H;
      Vec3 nu;
      for (int a = 0; a < 3; ++a) nu[a] = angle_difference(measured.gimbal(a, i), p.angles[a]);
      take(nu, readout.gimbal_noise, node, now);
    }
    if (about) turn(node, now);
    if (interval.cage) {
      phi[last] = now;
      step_back_through(interval, timeline, drive_of(interval, timeline, model, theta), nullptr,
                        phi.data());
      starts[chain] = phi[0];
    }
  }
  x += kalman.x.tail(n - 3);
  result.covariance = kalman.P.bottomRightCorner(n - 3, n - 3);
  result.parameters = parameter_estimates(layout, x0, x, result.covariance);
  return result;
}

/// Estimates in prior sigmas from the prior means.
VecX scaled(const EstimateResult& result) {
  VecX x(static_cast<Eigen::Index>(result.parameters.size()));
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    const ParameterEstimate& p = result.parameters[k];
    x[static_cast<Eigen::Index>(k)] = (p.value - p.prior_mean) / p.prior_sigma;
  }
  return x;
}

}  // namespace

EstimateResult practice_ekf(const FilterSpec& filter, const Timeline& timeline,
                            const Readout& readout, const Measurements& measured,
                            const Theta& start) {
  std::vector<Vec3> starts(timeline.chains);
  return practice_pass(filter, timeline, readout, measured, start, nullptr, starts);
}

EstimateResult practice_iterated(const FilterSpec& filter, const Timeline& timeline,
                                 const Readout& readout, const Measurements& measured,
                                 const Theta& start) {
  std::vector<Vec3> starts(timeline.chains);
  EstimateResult result =
      practice_pass(filter, timeline, readout, measured, start, nullptr, starts);
  constexpr int most_passes = 16;
  for (int pass = 0; pass < most_passes; ++pass) {
    const About about{scaled(result), starts};
    result = practice_pass(filter, timeline, readout, measured, start, &about, starts);
    const VecX moved = scaled(result) - about.x;
    if ((moved.array().abs() / result.covariance.diagonal().array().sqrt()).maxCoeff() < 1.0) break;
  }
  return result;
}

}  // namespace drift::bench
