// Speed of the filter: the structured covariance step against a textbook filter over dense
// matrices, on the same transition and measurement matrices; of a whole EKF step with its
// linearisation; and of a whole linear pass in information form, at samples of 10 s and of 180 s.
// Exit code 8 if the covariances differ, 9 if a step or a pass allocates memory.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/dense_ekf.hpp"
#include "bench/ekf_problem.hpp"
#include "bench/linear_pass.hpp"
#include "bench/repeated.hpp"
#include "bench/rows.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"
#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/counted_allocations.hpp"

namespace drift::bench {
namespace {

constexpr int repetitions = 5;
constexpr double aimed_ratio = 40.0;
/// Of the final covariances, by their sigmas: far below what anybody reads off one, far above what
/// rounding makes of 13,000 updates in double precision (the two dense forms are 3e-8 apart).
constexpr double allowed_difference = 1e-6;

Timed run_structured(const Problem& p) {
  Covariance P(p.layout.size(), p.layout.num_rate, p.filter.initial_attitude);
  VecX x = VecX::Zero(p.layout.size());
  const Rows3 none(3, 0);
  const long before = allocations;
  const double start = cpu_time();
  for (const Step& s : p.steps) {
    if (s.cage) P.recage(p.filter.initial_attitude);
    P.propagate(s.Phi_half, s.G_half);
    P.update(s.nu_acc, s.H_acc, none, s.H_par, p.readout.accelerometer_noise, x);
    P.propagate(s.Phi_rest, s.G_rest);
    P.update(s.nu_gimbal, s.H_gimbal, none, none, p.readout.gimbal_noise, x);
  }
  Timed out{cpu_time() - start, allocations - before, MatX(p.states(), p.states())};
  out.P.topLeftCorner<3, 3>() = P.attitude();
  out.P.bottomLeftCorner(p.states() - 3, 3) = P.cross();
  out.P.topRightCorner(3, p.states() - 3) = P.cross().transpose();
  out.P.bottomRightCorner(p.states() - 3, p.states() - 3) = P.parameters();
  return out;
}

Timed run_dense(const Problem& p, DenseForm form) {
  const Eigen::Index n = p.states(), nr = p.rate_states();
  DenseCovariance filter(n, form);
  MatX F = MatX::Identity(n, n);
  const MatX Q = MatX::Zero(n, n);  // a textbook filter adds it, whatever it is
  Mat3X H_acc = Mat3X::Zero(3, n), H_gimbal = Mat3X::Zero(3, n);
  const double sa = p.readout.accelerometer_noise, sg = p.readout.gimbal_noise;
  const long before = allocations;
  const double start = cpu_time();
  for (const Step& s : p.steps) {
    if (s.cage) {
      filter.P.topRows<3>().setZero();
      filter.P.leftCols<3>().setZero();
      filter.P.diagonal().head<3>().setConstant(p.filter.initial_attitude *
                                                p.filter.initial_attitude);
    }
    F.topLeftCorner<3, 3>() = s.Phi_half;
    F.block(0, 3, 3, nr) = s.G_half;
    filter.propagate(F, Q);
    H_acc.leftCols<3>() = s.H_acc;
    H_acc.rightCols(n - 3 - nr) = s.H_par;
    filter.update(s.nu_acc, H_acc, sa * sa);
    F.topLeftCorner<3, 3>() = s.Phi_rest;
    F.block(0, 3, 3, nr) = s.G_rest;
    filter.propagate(F, Q);
    H_gimbal.leftCols<3>() = s.H_gimbal;
    filter.update(s.nu_gimbal, H_gimbal, sg * sg);
  }
  return {cpu_time() - start, allocations - before, filter.P};
}

/// The whole filter, on measurements simulated once.
Timed run_filter(const Problem& p, const Measurements& measured) {
  Ekf ekf(p.filter, p.timeline, p.readout, p.layout.theta);
  ekf.process(0, measured.acc.col(0), measured.gimbal.col(0));  // fills the work space
  const long before = allocations;
  const double start = cpu_time();
  for (std::size_t i = 1; i < p.steps.size(); ++i)
    ekf.process(i, measured.acc.col(i), measured.gimbal.col(i));
  return {cpu_time() - start, allocations - before, ekf.covariance().parameters()};
}

/// A linear pass in information form, on the same measurements.
Timed run_linear_pass(const Problem& p, const Measurements& measured) {
  LinearPass pass(p.filter, p.timeline, p.readout);
  pass.run(measured, p.layout.theta);  // fills the work space
  const long before = allocations;
  const double start = cpu_time();
  const MatX& P = pass.run(measured, p.layout.theta);
  const double seconds = cpu_time() - start;
  return {seconds, allocations - before, P};
}

/// Difference of two covariances of prior-scaled states, norm over norm.
double difference(const MatX& A, const MatX& B) {
  return (A - B).norm() / B.norm();
}

/// Largest difference of an element, over the largest element.
double difference_by_element(const MatX& A, const MatX& B) {
  return (A - B).cwiseAbs().maxCoeff() / B.cwiseAbs().maxCoeff();
}

/// The same, each element over the posterior sigmas it belongs to: amplified by how much was
/// learnt.
double difference_by_sigma(const MatX& A, const MatX& B) {
  const VecX sigma = B.diagonal().cwiseSqrt();
  return ((A - B).array() / (sigma * sigma.transpose()).array()).abs().maxCoeff();
}

/// Attitude over its prior too.
void scale_attitude(const Problem& p, Timed& t) {
  t.P.topRows<3>() /= p.filter.initial_attitude;
  t.P.leftCols<3>() /= p.filter.initial_attitude;
}

void print_line(const char* name, const Timed& t, std::size_t steps, double reference) {
  fmt::print("{:<34}{:>12.0f}{:>12.3f}{:>12.2f}{:>12}\n", name,
             static_cast<double>(steps) / t.seconds, 1e6 * t.seconds / static_cast<double>(steps),
             reference / t.seconds, t.allocated);
}

Measurements simulated(const Problem& p) {
  TruthSpec truth;
  static_cast<ModelSpec&>(truth) = p.filter;
  return Simulator(truth, p.readout).run(p.timeline, 1, 0).measured;
}

/// The textbook takes long where there are many samples.
int rounds_at(double sample) {
  return (sample < 60.0 ? 1 : 4) * repetitions;
}

/// Passes over the recording that an estimator in lanes has made, the first and linear ones.
int passes_of(const IteratedJob& job) {
  return 1 + job.linear_passes();
}
int passes_of(const EkfJob&) {
  return 1;
}

/// What a study does: an estimator of as many runs as there are lanes, each with a recording of its
/// own. Seconds are those of one run and one pass.
template <class Lanes, class Job>
Timed run_lanes(Lanes& lanes, std::vector<Job>& jobs) {
  lanes.run(jobs);  // fills the work space
  const long before = allocations;
  const double start = cpu_time();
  lanes.run(jobs);
  const double seconds = cpu_time() - start;
  int passes = 0;
  for (const Job& job : jobs) passes += passes_of(job);
  return {seconds / passes, allocations - before, jobs[0].settled_covariance()};
}

/// Row of a pass of runs in lock step; memory it allocated.
template <class Lanes, class Job>
long row_of_lanes(const char* key, double sample, const char* note) {
  const Problem p = make_problem(sample);
  FilterSpec filter = p.filter;
  filter.noise.angle_random_walk = 0.0;
  TruthSpec truth;
  static_cast<ModelSpec&>(truth) = filter;
  Simulator simulator(truth, p.readout);
  std::vector<Measurements> measured;
  for (std::size_t k = 0; k < LaneIntervals::width; ++k)
    measured.push_back(simulator.run(p.timeline, 1, k).measured);
  std::vector<Job> jobs(measured.size());
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    jobs[k].measured = &measured[k];
    jobs[k].start = p.layout.theta;
  }
  Lanes lanes(filter, p.timeline, p.readout);
  Repeated pass, textbook;
  for (int k = 0; k < rounds_at(sample); ++k) {
    textbook.add(run_dense(p, DenseForm::textbook));
    pass.add(run_lanes(lanes, jobs));
  }
  const auto n = static_cast<double>(p.steps.size());
  print_row(key, pass.best.seconds / n, textbook.best.seconds / n, pass.spread(),
            fmt::format("a sample of {} s in {}, {} runs in lock step, path and linearisation with "
                        "it, against the textbook covariance step alone",
                        sample, note, LaneIntervals::width));
  return pass.best.allocated;
}

/// Row of a whole pass; memory it allocated.
long row_of_pass(const char* key, double sample, const char* note) {
  const Problem p = make_problem(sample);
  const Measurements measured = simulated(p);
  Repeated pass, textbook;
  for (int k = 0; k < rounds_at(sample); ++k) {
    textbook.add(run_dense(p, DenseForm::textbook));
    pass.add(run_linear_pass(p, measured));
  }
  const auto n = static_cast<double>(p.steps.size());
  print_row(key, pass.best.seconds / n, textbook.best.seconds / n, pass.spread(), note);
  return pass.best.allocated;
}

int run() {
  const Problem p = make_problem(10.0);
  const Measurements measured = simulated(p);
  Repeated all_structured, all_textbook, all_joseph, all_filter;
  for (int k = 0; k < repetitions; ++k) {
    all_structured.add(run_structured(p));
    all_textbook.add(run_dense(p, DenseForm::textbook));
    all_joseph.add(run_dense(p, DenseForm::joseph));
    all_filter.add(run_filter(p, measured));
  }
  Timed structured = all_structured.best, textbook = all_textbook.best, joseph = all_joseph.best;
  const Timed filter = all_filter.best;
  const std::size_t n = p.steps.size();
  fmt::print(
      "{} states, {} steps of 2 propagations and 2 updates of 3 scalars; best of {}, CPU time\n\n",
      p.states(), n, repetitions);
  fmt::print("{:<34}{:>12}{:>12}{:>12}{:>12}\n", "", "steps/s", "us/step", "speed", "mallocs");
  print_line("dense, textbook (I - K H) P", textbook, n, textbook.seconds);
  print_line("dense, Joseph form", joseph, n, textbook.seconds);
  print_line("structured", structured, n, textbook.seconds);
  print_line("whole EKF step, structured", filter, n - 1, textbook.seconds);
  const double ratio = textbook.seconds / structured.seconds;
  fmt::print("\nstructured against textbook: {:.1f} times as fast (aim {:.0f}){}\n", ratio,
             aimed_ratio, ratio < aimed_ratio ? ", MISSED" : "");
  const auto steps = static_cast<double>(n);
  print_row("ekf63_sequential", structured.seconds / steps, textbook.seconds / steps,
            all_structured.spread(), "covariance step of 6 scalars against the textbook's");
  const long in_passes =
      row_of_lanes<EkfLanes, EkfJob>("ekf63_lanes", 180.0,
                                     "an EKF with its covariance after every update") +
      row_of_lanes<IteratedLanes, IteratedJob>(
          "ekf63_pass", 180.0,
          "a pass of the iterated filter in information form, solutions and covariance with it") +
      row_of_pass("ekf63_pass_alone", 180.0,
                  "the same of one run by itself, linear, its nodes in lanes") +
      row_of_lanes<IteratedLanes, IteratedJob>(
          "ekf63_pass_10s", 10.0,
          "a pass of the iterated filter, dwells through polynomials, projections with it");
  for (Timed* t : {&structured, &textbook, &joseph}) scale_attitude(p, *t);
  const auto compare = [](const char* names, const Timed& a, const Timed& b) {
    fmt::print("  {:<24}{:>12.1e}{:>12.1e}{:>12.1e}\n", names, difference(a.P, b.P),
               difference_by_element(a.P, b.P), difference_by_sigma(a.P, b.P));
  };
  fmt::print("\ndifference of final covariances{:>6}{:>12}{:>12}\n", "norm", "element", "by sigma");
  compare("structured, textbook", structured, textbook);
  compare("structured, Joseph", structured, joseph);
  compare("textbook, Joseph", textbook, joseph);
  const double gap = std::max(difference_by_sigma(structured.P, textbook.P),
                              difference_by_sigma(structured.P, joseph.P));
  if (!(gap <= allowed_difference)) return 8;
  return structured.allocated + filter.allocated + in_passes == 0 ? 0 : 9;
}

}  // namespace
}  // namespace drift::bench

int main() {
  return drift::bench::run();
}
