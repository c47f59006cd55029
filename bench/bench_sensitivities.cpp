// Speed of the sensitivities of the platform's attitude to every rate parameter over six hours of
// free drift: variation of constants as the estimators do it, for one run by itself and for as many
// runs in lock step as the machine has lanes, against packaged CVODES by its staggered forward
// method, with the same derivatives in closed form. Exit code 8 if the two differ
// by more than the tolerances allow.

#include <algorithm>
#include <cmath>

#include "bench/rows.hpp"
#include "core/estimate/linearize.hpp"
#include "core/estimate/sequential/in_lanes/lane_intervals.hpp"
#include "core/estimate/starts.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/plan/case_heading.hpp"
#include "tests/support/forward_sensitivity.hpp"

namespace drift::bench {
namespace {

constexpr int repetitions = 20;
constexpr double allowed = 1e-6;  // of the norm of all columns: CVODES holds 1e-8 a step

FilterSpec rate_terms() {
  FilterSpec filter;
  filter.active = base_parameters();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    filter.priors[i] = TermLibrary::specs[i].prior_si();
  return filter;
}

Timeline six_free() {
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 3600.0;
  defaults.sample = 1200.0;
  return lay_out(preset_plan("six", defaults).value(), Site{45.75 * detail::deg});
}

/// The state of the problem that both sides solve.
struct Problem {
  FilterSpec filter = rate_terms();
  Timeline timeline = six_free();
  DriftModel model = filter.model();
  Layout layout = make_layout(filter);
  std::vector<Theta> runs = draws(filter);
  Theta theta = runs.front();
  static std::vector<Theta> draws(const FilterSpec& filter) {
    std::vector<Theta> all;
    for (std::size_t k = 0; k < LaneIntervals::width; ++k)
      all.push_back(draw_parameters(filter, 1, k, Purpose::test));
    return all;
  }
  Eigen::Index columns() const { return static_cast<Eigen::Index>(layout.num_rate); }
};

/// d psi at the end of every chain, shape (3, chains * columns).
MatX by_variation_of_constants(const Problem& p) {
  MatX all(3, p.timeline.chains * p.columns());
  Linearizer linearizer(p.model, p.layout, Readout{false, true});
  linearizer.set_theta(p.theta);
  const Trajectory phi = integrate_fixed(p.timeline, p.model, p.theta,
                                         std::vector<Vec3>(p.timeline.chains, Vec3::Zero()));
  IntervalSensitivity inner;
  Rows3 G = padded_rows(p.layout.num_rate);
  for (const Interval& i : p.timeline.intervals) {
    if (i.cage) G.setZero();
    linearize_interval(i, p.timeline, Mat3::Zero(), &phi[i.first_node], nullptr, linearizer, inner);
    G = (inner.Phi.back() * G + inner.G.back()).eval();
    all.middleCols(i.chain * p.columns(), p.columns()) = G.leftCols(p.columns());
  }
  return all;
}

/// The same of all runs at once.
class InLanes {
 public:
  explicit InLanes(const Problem& p)
      : along_(p.filter, p.timeline, Readout{false, true}),
        x_(p.layout.size()),
        of_runs_(p.runs.size(), MatX(3, p.timeline.chains * p.columns())) {
    for (std::size_t k = 0; k < x_.size(); ++k)
      x_[k] = Pack::of_each(
          [&](int l) { return p.layout.scaled(p.runs[static_cast<std::size_t>(l)], k); });
  }
  const std::vector<MatX>& run() {
    along_.set_theta(x_);
    const auto& all = along_.timeline().intervals;
    for (std::size_t i = 0; i < all.size(); ++i) {
      along_.phi(all[i].first_node) =
          all[i].cage ? PackVec(PackVec::Zero()) : along_.phi(all[i - 1].last_node());
      if (all[i].cage) along_.cage(all[i]);
      along_.forward(all[i]);
      along_.linearize(i, i > 0);
      along_.through(all[i]);
      if (i + 1 == all.size() || all[i + 1].cage) keep(all[i].chain);
    }
    return of_runs_;
  }

 private:
  void keep(int chain) {
    const std::size_t columns = along_.layout().num_rate;
    for (std::size_t k = 0; k < columns; ++k)
      for (int a = 0; a < 3; ++a)
        for (std::size_t l = 0; l < of_runs_.size(); ++l)
          of_runs_[l](a,
                      chain * static_cast<Eigen::Index>(columns) + static_cast<Eigen::Index>(k)) =
              along_.attitude().by_parameter(k)[a][static_cast<int>(l)];
  }
  LaneIntervals along_;
  std::vector<Pack> x_;
  std::vector<MatX> of_runs_;
};

MatX by_cvodes(const Problem& p) {
  MatX all(3, p.timeline.chains * p.columns());
  Linearizer linearizer(p.model, p.layout, Readout{false, true});
  linearizer.set_theta(p.theta);
  NodeJacobian jacobian = linearizer.make();
  const Vec3 omega_ie_l = p.timeline.site.omega_ie_l();
  const std::vector<double> scale(static_cast<std::size_t>(p.columns()), 1.0);
  for (const Interval& cage : p.timeline.intervals) {
    if (!cage.cage) continue;
    const Node& start = p.timeline.nodes[cage.first_node];
    Drive drive = drive_of(cage, p.timeline, p.model, p.theta);
    double end = cage.t1;
    for (const Interval& i : p.timeline.intervals)
      if (i.chain == cage.chain) end = i.t1;
    const auto node_at = [&](double t) {
      Node node = start;
      node.t = t;
      node.R_lr = reference_attitude(p.timeline.site, start.R_lr, drive.omega_cmd_p, t - start.t);
      node.R_il = rotation<double>(omega_ie_l * (t - start.t));
      return node;
    };
    const auto rhs = [&](double t, const double* y, double* f) {
      Eigen::Map<Vec3>(f, 3) = attitude_rate(drive, node_at(t).R_lr, vec3(y), t, nullptr);
      return true;
    };
    const auto sensitivity_rhs = [&](double t, const double* y, const double*, const double* S,
                                     double* S_dot) {
      const Node node = node_at(t);
      linearizer.evaluate({{{&node, &cage, vec3(y)}}}, Mat3::Zero(), &p.timeline, &jacobian);
      Eigen::Map<Mat3X>(S_dot, 3, p.columns()) =
          jacobian.A * Eigen::Map<const Mat3X>(S, 3, p.columns()) +
          jacobian.B.leftCols(p.columns());
      return true;
    };
    const SensitivityResult r =
        integrate_with_sensitivities(rhs, sensitivity_rhs, OdeOptions{}, start.t, VecX::Zero(3),
                                     MatX::Zero(3, p.columns()), scale, end);
    all.middleCols(cage.chain * p.columns(), p.columns()) = r.S;
  }
  return all;
}

/// Least and largest of several [s].
struct Taken {
  double least = 1e9, most = 0.0;
  void add(double seconds) {
    least = std::min(least, seconds);
    most = std::max(most, seconds);
  }
};

int run() {
  const Problem p;
  InLanes lanes(p);
  Taken alone, together, peer;
  MatX own, theirs;
  for (int k = 0; k < repetitions; ++k) {
    double start = cpu_time();
    own = by_variation_of_constants(p);
    alone.add(cpu_time() - start);
    start = cpu_time();
    lanes.run();
    together.add((cpu_time() - start) / static_cast<double>(p.runs.size()));
    start = cpu_time();
    theirs = by_cvodes(p);
    peer.add(cpu_time() - start);
  }
  const auto apart = [&](const MatX& m) {
    return (m - theirs).colwise().norm().maxCoeff() / theirs.norm();
  };
  const double worst = std::max(apart(own), apart(lanes.run()[0]));
  fmt::print(
      "{} sensitivities of {} h: a run {:.3f} ms, of {} in lock step {:.4f} ms, CVODES {:.2f} ms; "
      "apart {:.1e} of all\n",
      p.columns(), p.timeline.chains, 1e3 * alone.least, p.runs.size(), 1e3 * together.least,
      1e3 * peer.least, worst);
  const auto row = [&](const char* key, const Taken& ours, const std::string& how) {
    print_row(key, ours.least, peer.least, ours.most / ours.least,
              fmt::format("{} sensitivities of the attitude after each of {} hours of free drift, "
                          "{}, against packaged CVODES (staggered, derivatives in closed form)",
                          p.columns(), p.timeline.chains, how));
  };
  row("sensitivities_cvodes", together, fmt::format("{} runs in lock step", p.runs.size()));
  row("sensitivities_alone", alone, "one run by itself");
  return worst < allowed ? 0 : 8;
}

}  // namespace
}  // namespace drift::bench

int main() {
  return drift::bench::run();
}
