#include "analysis/discovery/advise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/discovery/patched_study.hpp"
#include "analysis/discovery/position_pool.hpp"
#include "analysis/discovery/score.hpp"
#include "analysis/discovery/signatures.hpp"
#include "analysis/recorded_test.hpp"
#include "core/sim/simulate.hpp"
#include "mc/campaign.hpp"

namespace drift::discovery {
namespace {

constexpr auto lambda = TermLibrary::index("lambda");

/// A way the truth may be: what it adds to the nominal model, and by how much.
struct Alternative {
  std::string label;
  std::vector<Cause> causes;   ///< empty: the nominal model itself
  std::vector<int> columns;    ///< of its linear parameters among all signatures
  VecX amplitude;              ///< in prior sigmas
};

double base_of(std::size_t param, const FilterSpec& nominal) {
  return param == lambda && nominal.coupling == Coupling::eq6 ? 1.0 : 0.0;
}

Alternative nothing() { return {"the nominal model", {}, {}, VecX()}; }

/// The other member of {eq5, eq6}, where the test is blind to lambda.
std::vector<Alternative> equations(const Diagnosis& d) {
  const bool six = d.nominal.coupling == Coupling::eq6;
  if (d.verdict != Verdict::consistent || (d.nominal.coupling != Coupling::eq5 && !six)) return {};
  if (!(d.other_equation_gain > -equation_told)) return {};  // told, or not asked
  Cause cause;
  cause.term = "frame_closure";
  cause.parameters = {{"lambda", lambda, six ? 0.0 : 1.0, 0.0, "1", false}};
  return {{six ? "eq. (5)" : "eq. (6)", {cause}, {}, {}}, {six ? "eq. (6)" : "eq. (5)", {}, {}, VecX()}};
}

std::vector<Alternative> alternatives_of(const Diagnosis& d) {
  std::vector<Alternative> all;
  if (d.verdict != Verdict::ambiguous) return equations(d);
  for (const Cause& c : d.causes) {
    const auto k = static_cast<std::size_t>(c.set);
    if (k >= all.size()) all.resize(k + 1);
    // One parameter tells more than its term: several of a term may be alternatives.
    const std::string own = c.parameters.size() == 1 && !c.parameters[0].key.starts_with(c.term)
                                ? fmt::format(" ({})", c.parameters[0].key) : "";
    all[k].label += fmt::format("{}{}{}{}{}", all[k].label.empty() ? "" : " + ", c.term, c.axis.empty() ? "" : ".", c.axis, own);
    all[k].causes.push_back(c);
  }
  std::erase_if(all, [](const Alternative& a) { return a.causes.empty(); });
  if (all.size() == 1) all.push_back(nothing());
  return all;
}

/// Numbers the linear parameters of all alternatives and notes their amplitudes.
std::vector<SignatureSpec> number_signatures(std::vector<Alternative>& all, const FilterSpec& nominal, const Theta& theta) {
  std::vector<SignatureSpec> specs;
  for (Alternative& a : all) {
    std::vector<double> amplitude;
    for (const Cause& cause : a.causes) {
      Theta at = theta;
      for (const CauseParameter& p : cause.parameters)
        if (p.profiled) at[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
      for (const CauseParameter& p : cause.parameters) {
        if (p.profiled) continue;
        const ParamSpec& spec = TermLibrary::specs[p.param];
        const double sigma = spec.prior_si().sigma();
        amplitude.push_back((p.value * spec.unit.to_si - base_of(p.param, nominal)) / sigma);
        a.columns.push_back(static_cast<int>(specs.size()));
        specs.push_back({p.param, at, sigma});
      }
    }
    a.amplitude = Eigen::Map<const VecX>(amplitude.data(), static_cast<Eigen::Index>(amplitude.size()));
  }
  return specs;
}

bool holds_lambda(const Alternative& a) {
  return std::ranges::any_of(a.causes, [](const Cause& c) { return c.term == "frame_closure"; });
}

/// Information of a test on nominal parameters (t) and signatures (e), in prior sigmas.
struct Information {
  MatX tt, te, ee;
  Information& operator+=(const Information& o) {
    tt += o.tt;
    te += o.te;
    ee += o.ee;
    return *this;
  }
};

Information information_of(const LinearProblem& problem, const NoiseModel& noise) {
  const Projector p(problem, noise);
  return {p.theta().transpose() * p.theta(), p.theta().transpose() * p.extra(), p.extra().transpose() * p.extra()};
}

struct Separation {
  double sigma = HUGE_VAL;
  std::size_t a = 0, b = 0;  ///< the closest pair; a is taken as true
};

Separation separation(const Information& info, const std::vector<Alternative>& all) {
  const MatX A = info.tt + MatX::Identity(info.tt.rows(), info.tt.cols());
  const MatX C = info.ee - info.te.transpose() * A.llt().solve(info.te);
  Separation least;
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t d = 0; d < all.size(); ++d) {
      if (c == d || all[c].columns.empty()) continue;
      MatX left = C(all[c].columns, all[c].columns);
      if (!all[d].columns.empty()) {
        const MatX cd = C(all[c].columns, all[d].columns);
        const MatX dd = C(all[d].columns, all[d].columns);
        left -= cd * (dd + MatX::Identity(dd.rows(), dd.cols())).llt().solve(cd.transpose());
      }
      const double sigma = std::sqrt(std::max(0.0, all[c].amplitude.dot(left * all[c].amplitude)));
      if (sigma < least.sigma) least = {sigma, c, d};
    }
  return least;
}

NoiseModel noise_of(const Diagnosis& d) {
  NoiseModel m;
  m.angle_random_walk = d.nominal.noise.angle_random_walk;
  m.drift_random_walk = d.nominal.noise.drift_random_walk;
  for (const NoiseFinding& f : d.noise) {
    if (!f.significant || !std::isfinite(f.factor)) continue;
    if (f.component == "gimbal_white") m.gimbal_factor = f.factor;
    if (f.component == "accelerometer_white") m.acc_factor = f.factor;
  }
  return m;
}

class Adviser {
 public:
  Adviser(const Study& study, const std::vector<Recording>& recordings, const Diagnosis& d, const AdviseOptions& options)
      : study_(study), d_(d), options_(options), noise_(noise_of(d)), all_(alternatives_of(d)) {
    if (all_.empty()) return;
    test_ = recorded_test(study, recordings);
    fit_ = fit_batch(d.nominal, test_.timeline, study.readout, test_.measured, make_layout(d.nominal).theta);
    if (std::ranges::any_of(all_, holds_lambda)) widen_misalignments();
    specs_ = number_signatures(all_, d.nominal, theta_of(d.nominal, fit_));
  }

  std::vector<Advice> run() {
    if (all_.empty()) return {};
    Information now = information_of(linear_problem(d_.nominal, {test_.timeline, study_.readout, test_.measured}, fit_, specs_), noise_);
    Advice advice;
    Separation reached = separation(now, all_);
    advice.now_sigma = reached.sigma;
    for (const Alternative& a : all_) advice.separates.push_back(a.label);
    const Position& first = study_.plan.positions.front();
    std::vector<Addition> pool = position_pool(first.dwell, first.sample, study_.site);
    const auto gains = mc::run_campaign(pool.size(), [&](std::size_t k) { return gain_of(pool[k]); });
    for (std::size_t step = 0; step < options_.most && reached.sigma < options_.wanted; ++step) {
      std::size_t best = pool.size();
      Separation best_reached = reached;
      for (std::size_t k = 0; k < pool.size(); ++k) {
        Information with = now;
        const Separation s = separation(with += gains[k], all_);
        if (s.sigma > best_reached.sigma) {
          best = k;
          best_reached = s;
        }
      }
      if (best == pool.size()) break;
      now += gains[best];
      reached = best_reached;
      for (Position p : pool[best]) {
        p.name = fmt::format("advised {}: {}", advice.plan.size() + 1, p.name);
        advice.plan.push_back(std::move(p));
      }
    }
    if (advice.plan.empty() && reached.sigma >= options_.wanted) return {};  // told apart as it is
    advice.expected_sigma = reached.sigma;
    advice.verified_sigma = advice.plan.empty() ? std::nan("") : verify(advice.plan, reached);
    advice.text = text_of(advice, reached);
    return {advice};
  }

 private:
  /// What lambda does goes with the misalignments: where the test has not seen them they stand near zero,
  /// yet may be as large as their sigma. Their root mean square size is what is to be expected.
  void widen_misalignments() {
    for (ParameterEstimate& p : fit_.estimate.parameters) {
      const auto group = TermLibrary::specs[p.param].group.view();
      if (group == "eta" || group == "xi") p.value = std::copysign(std::hypot(p.value, p.sigma), p.value);
    }
  }

  Information gain_of(const Addition& addition) const {
    TestPlan plan = study_.plan;
    plan.preset.clear();
    plan.positions = addition;
    const Timeline timeline = planned_test(study_, plan);
    const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
    const Measurements anything{Mat3X::Zero(3, n), Mat3X::Zero(3, n)};  // information does not ask for values
    BatchResult fit = fit_;
    fit.psi0_l.assign(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
    return information_of(linear_problem(d_.nominal, {timeline, study_.readout, anything}, fit, specs_), noise_);
  }

  /// Simulates the extended test with one of the closest pair as truth and fits both.
  double verify(const std::vector<Position>& added, const Separation& closest) const {
    TestPlan plan = study_.plan;
    plan.preset.clear();
    plan.positions.insert(plan.positions.end(), added.begin(), added.end());
    const Timeline timeline = planned_test(study_, plan);
    const FilterSpec right = patched_filter(d_.nominal, all_[closest.a].causes);
    const FilterSpec wrong = patched_filter(d_.nominal, all_[closest.b].causes);
    Theta theta = theta_of(d_.nominal, fit_);
    for (const Cause& c : all_[closest.a].causes)
      for (const CauseParameter& p : c.parameters) theta[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
    TruthSpec truth;
    static_cast<ModelSpec&>(truth) = right;
    TruthDraw draw = draw_truth(truth, timeline.chains, options_.seed, 0);
    draw.theta = theta;
    const Simulation sim = Simulator(truth, study_.readout).run(timeline, draw, options_.seed, 0);
    if (!sim.ode.ok()) return std::nan("");
    const auto cost = [&](const FilterSpec& f) {
      return fit_batch(f, timeline, study_.readout, sim.measured, make_layout(f).theta).estimate.statistic;
    };
    const double gain = cost(wrong) - cost(right);
    return std::copysign(std::sqrt(std::abs(gain)), gain);
  }

  std::string text_of(const Advice& a, const Separation& s) const {
    const std::string pair = fmt::format("{} and {}", all_[s.a].label, all_[s.b].label);
    if (a.plan.empty())
      return fmt::format("{} are {:.1f} sigma apart on this plan, and no position of the pool helps.", pair, a.now_sigma);
    std::vector<std::string> names;
    for (const Position& p : a.plan) names.push_back(p.name.substr(p.name.find(": ") + 2));
    return fmt::format("{} are {:.1f} sigma apart on this plan. Add {}: then {:.1f} sigma{}{}.", pair, a.now_sigma,
                       fmt::join(names, "; "), a.expected_sigma,
                       std::isfinite(a.verified_sigma) ? fmt::format(" (in a simulation: {:.1f})", a.verified_sigma) : "",
                       a.expected_sigma < options_.wanted ? ", which is not enough" : "");
  }

  const Study& study_;
  const Diagnosis& d_;
  AdviseOptions options_;
  NoiseModel noise_;
  std::vector<Alternative> all_;
  RecordedTest test_;
  BatchResult fit_;
  std::vector<SignatureSpec> specs_;
};

}  // namespace

std::vector<Advice> advise(const Study& study, const std::vector<Recording>& recordings, const Diagnosis& diagnosis,
                           const AdviseOptions& options) {
  return Adviser(study, recordings, diagnosis, options).run();
}

}  // namespace drift::discovery
