// Speed of the null-seeking loop, 15 stiff states: driftscope's simulator against a plain program
// over CVODE as packaged (BDF, dense matrix, Jacobian by differences), same equations, tolerances
// and stops; in dwells and in slews. Exit code 8 if their attitudes differ by more than the
// tolerances allow.

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>

#include "bench/rows.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/plan/case_heading.hpp"
#include "core/sim/platform_ode.hpp"
#include "core/sim/simulate.hpp"

namespace drift::bench {
namespace {

constexpr int repetitions = 5;
constexpr double allowed_attitude = 0.02;  // [arcsec]

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

struct Stretch {
  const Timeline* timeline = nullptr;
  const TruthSpec* truth = nullptr;
  Drive drive;
  Mat3 R_lr0;
  double t0 = 0.0;
};

int rate(realtype t, N_Vector y_vector, N_Vector y_dot_vector, void* data) {
  const auto& s = *static_cast<Stretch*>(data);
  const double* y = NV_DATA_S(y_vector);
  double* y_dot = NV_DATA_S(y_dot_vector);
  const Vec3 phi = vec3(y + ServoState::size);
  const Mat3 R_rp = rotation(phi);
  const Mat3 R_lp =
      reference_attitude(s.timeline->site, s.R_lr0, s.drive.omega_cmd_p, t - s.t0) * R_rp;
  const Scene<double> scene(s.drive.omega_ic_l, s.drive.omega_cmd_p, s.drive.model->mounting, R_lp);
  const Vec3 unfelt_p =
      servo_derivative(s.truth->servo, *s.drive.model, scene.in, s.drive.theta, y, y_dot);
  const Vec3 omega_ip_p = vec3(y + ServoState::omega_ip) + unfelt_p;
  Eigen::Map<Vec3>(y_dot + ServoState::size) =
      rotation_vector_rate(phi, R_rp, omega_ip_p, s.drive.omega_cmd_p);
  return 0;
}

/// phi at the end of every interval.
std::vector<Vec3> plain(const Timeline& timeline, const TruthSpec& truth, const TruthDraw& draw,
                        const OdeOptions& options) {
  constexpr int n = PlatformOde::servo_states;
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector y = N_VNew_Serial(n, context), tolerance = N_VNew_Serial(n, context);
  const double scale[] = {1e-5, 1e-5, 1e-4, 1e-6, 1e-3};  // physics.md 6.2, as ours
  for (int i = 0; i < n; ++i) NV_DATA_S(tolerance)[i] = options.rel_tol * scale[i / 3];
  void* cvode = CVodeCreate(CV_BDF, context);
  check(CVodeSetErrFile(cvode, nullptr));  // remarks on the first step after a stop
  SUNMatrix matrix = SUNDenseMatrix(n, n, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  const DriftModel model = truth.model();
  Stretch s{&timeline, &truth, {}, Mat3::Identity(), 0.0};
  std::vector<Vec3> ends;
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
      if (interval.cage) {
        const Vec3 phi0 = caged_phi(node.R_lr, draw.psi0_l[interval.chain]);
        const Scene<double> scene(s.drive.omega_ic_l, s.drive.omega_cmd_p, model.mounting,
                                  node.R_lr * rotation(phi0));
        Eigen::Map<Eigen::Matrix<double, ServoState::size, 1>>(NV_DATA_S(y)) =
            servo_at_rest(truth.servo, model, scene.in, draw.theta.data());
        Eigen::Map<Vec3>(NV_DATA_S(y) + ServoState::size) = phi0;
      }
      if (i == 0) {
        check(CVodeInit(cvode, rate, interval.t0, y));
        check(CVodeSVtolerances(cvode, options.rel_tol, tolerance));
        check(CVodeSetUserData(cvode, &s));
        check(CVodeSetLinearSolver(cvode, solver, matrix));
        check(CVodeSetMaxNumSteps(cvode, 1000000));
      } else {
        check(CVodeReInit(cvode, interval.t0, y));
      }
    }
    realtype reached = 0.0;
    check(CVodeSetStopTime(cvode, interval.t1));
    check(CVode(cvode, interval.t1, y, &reached, CV_NORMAL));
    ends.emplace_back(vec3(NV_DATA_S(y) + ServoState::size));
  }
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(tolerance);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return ends;
}

TruthSpec servo_truth() {
  TruthSpec truth;
  truth.coupling = Coupling::servo;
  truth.active = base_parameters();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    truth.priors[i] = TermLibrary::specs[i].prior_si();
  return truth;
}

/// Largest difference of attitude [arcsec].
double compare(const char* preset, CommandLaw mode, const char* key, const char* note) {
  PlanDefaults defaults;
  defaults.mode = mode;
  defaults.dwell = 3600.0;
  defaults.sample = 180.0;
  const Timeline timeline =
      lay_out(preset_plan(preset, defaults).value(), Site{45.75 * detail::deg});
  const TruthSpec truth = servo_truth();
  const OdeOptions options = Simulator::default_options(Coupling::servo);
  Simulator simulator(truth, Readout{}, options);
  Simulation run = simulator.run(timeline, 1, 0);
  double ours = 1e9, slowest = 0.0, peer = 1e9, apart = 0.0;
  for (int k = 0; k < repetitions; ++k) {
    double start = cpu_time();
    simulator.run(timeline, run.draw, 1, 0, run);
    const double taken = cpu_time() - start;
    ours = std::min(ours, taken);
    slowest = std::max(slowest, taken);
    start = cpu_time();
    const std::vector<Vec3> ends = plain(timeline, truth, run.draw, options);
    peer = std::min(peer, cpu_time() - start);
    for (std::size_t i = 0; i < ends.size(); ++i)
      apart = std::max(apart, (ends[i] - run.phi[timeline.intervals[i].last_node()]).norm() /
                                  unit::arcsec.to_si);
  }
  fmt::print("{:<8} ours {:.3f} ms, plain CVODE {:.3f} ms, {:.1f} times; apart {:.1e} arcsec\n",
             preset, 1e3 * ours, 1e3 * peer, peer / ours, apart);
  print_row(key, ours, peer, slowest / ours, note);
  return apart;
}

int run() {
  const double dwells = compare("six", CommandLaw::free, "servo_dwell",
                                "6 h of six free positions, 15 states, against a plain program "
                                "over packaged CVODE (BDF, dense, Jacobian by differences)");
  const double slews = compare("slew12", CommandLaw::level, "servo_slew",
                               "slew12: twelve level positions and the slews between them, same "
                               "peer");
  return dwells < allowed_attitude && slews < allowed_attitude ? 0 : 8;
}

}  // namespace
}  // namespace drift::bench

int main() {
  return drift::bench::run();
}
