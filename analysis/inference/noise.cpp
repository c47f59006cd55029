#include "analysis/inference/noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/units.hpp"
#include "core/stats/chi_square.hpp"
#include "mc/task/campaign.hpp"

namespace drift::inference {
namespace {

constexpr double needed_gain = 2.7;        // of twice the log likelihood: a component comes in
constexpr double significant_gain = 12.0;  // eight alternatives, one in a thousand
constexpr double deg_per_h = detail::deg / 3600.0;  // [rad/s]

/// One standard deviation of the noise model.
struct Component {
  const char* name;
  double NoiseModel::*sigma;
  double NoiseModel::*tau;  ///< null if it has none
  double reference;         ///< a size at which it may begin to matter, SI
  const char* unit;
  double to_unit;  ///< SI per unit
};

constexpr Component acc_white{
    "accelerometer_white", &NoiseModel::acc_factor, nullptr, 1.0, "1", 1.0};
constexpr Component gimbal_white{
    "gimbal_white", &NoiseModel::gimbal_factor, nullptr, 1.0, "1", 1.0};
const Component angle_walk{"angle_random_walk",
                           &NoiseModel::angle_random_walk,
                           nullptr,
                           1e-3 * detail::deg / 60.0,
                           "deg/sqrt(h)",
                           detail::deg / 60.0};
const Component drift_walk{"drift_random_walk",
                           &NoiseModel::drift_random_walk,
                           nullptr,
                           3e-3 * deg_per_h / 60.0,
                           "deg/h/sqrt(h)",
                           deg_per_h / 60.0};
const Component markov{
    "markov_drift", &NoiseModel::markov_drift, &NoiseModel::markov_tau, 3e-3 * deg_per_h, "deg/h",
    deg_per_h};
const Component acc_markov{
    "accelerometer_markov", &NoiseModel::acc_markov, &NoiseModel::acc_tau, 2e-6, "ug", 1e-6};

/// Restricted likelihood as a function of the noise.
class Likelihood {
 public:
  Likelihood(const LinearProblem& problem, const std::vector<int>& with) : problem_(problem) {
    const Eigen::Index n = problem.theta.cols();
    problem_.extra.resize(problem.rows(), 0);
    problem_.theta.conservativeResize(Eigen::NoChange, n + with.size());
    for (std::size_t k = 0; k < with.size(); ++k)
      problem_.theta.col(n + k) = problem.extra.col(with[k]);
  }
  double operator()(const NoiseModel& m) const {
    const double v = Projector(problem_, m).candidates().log_likelihood2();
    return std::isfinite(v) ? v : -std::numeric_limits<double>::infinity();
  }

 private:
  LinearProblem problem_;
};

NoiseModel at(const NoiseModel& base, const std::vector<const Component*>& active,
              const VecX& log_sigma) {
  NoiseModel m = base;
  for (std::size_t k = 0; k < active.size(); ++k) m.*(active[k]->sigma) = std::exp(log_sigma[k]);
  return m;
}

struct Ascent {
  VecX log_sigma;
  double value = 0.0;
  MatX inverse_curvature;  ///< of half the value: covariance of log sigma
};

/// Maximises over the log sigmas of the active components (BFGS, forward differences).
Ascent ascend(const Likelihood& likelihood, const NoiseModel& base,
              const std::vector<const Component*>& active, const VecX& curvature) {
  const auto n = static_cast<Eigen::Index>(active.size());
  VecX x(n);
  for (Eigen::Index k = 0; k < n; ++k) x[k] = std::log(base.*(active[k]->sigma));
  const auto f = [&](const VecX& p) { return 0.5 * likelihood(at(base, active, p)); };
  double value = f(x);
  const auto gradient = [&](const VecX& p, double here) {
    const auto slopes = mc::run_campaign(active.size(), [&](std::size_t k) {
      VecX q = p;
      q[static_cast<Eigen::Index>(k)] += 1e-3;
      return (f(q) - here) / 1e-3;
    });
    return VecX(Eigen::Map<const VecX>(slopes.data(), n));
  };
  MatX H = curvature.cwiseInverse().asDiagonal();  // inverse of minus the Hessian
  VecX g = gradient(x, value);
  for (int iteration = 0; iteration < 25; ++iteration) {
    VecX step = H * g;
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > 1.0) step /= longest;
    double next = f(x + step);
    for (int k = 0; k < 8 && !(next > value); ++k) {
      step *= 0.3;
      next = f(x + step);
    }
    if (!(next > value)) break;
    const double gain = next - value;
    x += step;
    value = next;
    if (gain < 1e-3) break;
    const VecX g_next = gradient(x, value);
    const VecX y = g - g_next;  // of minus the function
    const double sy = step.dot(y);
    if (sy > 1e-12) {
      const MatX I = MatX::Identity(n, n);
      H = (I - step * y.transpose() / sy) * H * (I - y * step.transpose() / sy) +
          step * step.transpose() / sy;
    }
    g = g_next;
  }
  return {x, 2.0 * value, H};
}

/// A component tried alone on top of a model: where along its sigma the likelihood is best.
struct Trial {
  const Component* component = nullptr;
  double sigma = 0.0, tau = 0.0, gain = 0.0;
};

Trial try_out(const Likelihood& likelihood, const NoiseModel& base, double value,
              const Component& c, double tau) {
  Trial best{&c, 0.0, tau, 0.0};
  NoiseModel m = base;
  if (c.tau) m.*(c.tau) = tau;
  const auto gain = [&](double sigma) {
    m.*(c.sigma) = sigma;
    return likelihood(m) - value;
  };
  // Up a ladder by factors of three, from where nothing is changed, until it gets worse again.
  double last = 0.0;
  for (double sigma = c.reference / 9.0; sigma < 300.0 * c.reference; sigma *= 3.0) {
    const double g = gain(sigma);
    if (g > best.gain) {
      best.gain = g;
      best.sigma = sigma;
    }
    if (g < last - 3.0) break;
    last = g;
  }
  return best;
}

std::vector<Trial> all_trials(const Likelihood& likelihood, const NoiseModel& base, double value,
                              const LinearProblem& problem) {
  std::vector<std::pair<const Component*, double>> jobs;  // with the time constant
  const bool gimbals = std::any_of(problem.tags.begin(), problem.tags.end(),
                                   [](auto& t) { return !t.accelerometer(); });
  const bool accs = std::any_of(problem.tags.begin(), problem.tags.end(),
                                [](auto& t) { return t.accelerometer(); });
  if (base.angle_random_walk == 0.0) jobs.emplace_back(&angle_walk, 0.0);
  if (base.drift_random_walk == 0.0) jobs.emplace_back(&drift_walk, 0.0);
  if (base.markov_drift == 0.0)
    for (const double tau : {600.0, 2400.0}) jobs.emplace_back(&markov, tau);
  if (base.acc_markov == 0.0 && accs && gimbals)
    for (const double tau : {150.0, 900.0}) jobs.emplace_back(&acc_markov, tau);
  return mc::run_campaign(jobs.size(), [&](std::size_t k) {
    return try_out(likelihood, base, value, *jobs[k].first, jobs[k].second);
  });
}

NoiseFinding white_finding(const Component& c, double declared, double sigma,
                           double log_sigma_error, std::size_t rows) {
  NoiseFinding f;
  f.component = c.name;
  f.factor = sigma / declared;
  f.factor_sigma = f.factor * log_sigma_error;
  f.value = sigma / declared;
  f.unit = "of declared";
  const double z = std::log(f.factor) / log_sigma_error;
  f.p_value = std::exp(stats::log_tail(z * z, 1.0));
  f.significant = f.p_value < 1e-3;
  f.log_likelihood_gain = 0.5 * z * z;
  f.count = rows;
  return f;
}

}  // namespace

NoiseEstimate estimate_noise(const LinearProblem& problem, const NoiseModel& declared,
                             const std::vector<int>& with, int most_added) {
  const Likelihood likelihood(problem, with);
  std::size_t acc_rows = 0;
  for (const RowTag& t : problem.tags) acc_rows += t.accelerometer();
  const std::size_t gimbal_rows = problem.tags.size() - acc_rows;

  NoiseEstimate out;
  out.model = declared;
  std::vector<const Component*> active;
  if (acc_rows > 0) active.push_back(&acc_white);
  if (gimbal_rows > 0) active.push_back(&gimbal_white);
  for (const Component* c : {&angle_walk, &drift_walk})
    if (declared.*(c->sigma) > 0.0) active.push_back(c);
  const auto curvature = [&] {
    VecX h(active.size());
    for (std::size_t k = 0; k < active.size(); ++k)
      h[k] = active[k] == &acc_white      ? 2.0 * static_cast<double>(acc_rows)
             : active[k] == &gimbal_white ? 2.0 * static_cast<double>(gimbal_rows)
                                          : 30.0;
    return h;
  };
  Ascent best = ascend(likelihood, out.model, active, curvature());
  out.model = at(out.model, active, best.log_sigma);
  std::vector<std::pair<const Component*, double>> gains;
  for (int added = 0; added < most_added; ++added) {
    const auto trials = all_trials(likelihood, out.model, best.value, problem);
    const auto top =
        std::max_element(trials.begin(), trials.end(),
                         [](const Trial& a, const Trial& b) { return a.gain < b.gain; });
    // On the ladder's rungs: what is close to enough is worth the ascent.
    if (top == trials.end() || top->gain < 0.5 * needed_gain) break;
    NoiseModel more = out.model;
    more.*(top->component->sigma) = top->sigma;
    if (top->component->tau) more.*(top->component->tau) = top->tau;
    active.push_back(top->component);
    const Ascent next = ascend(likelihood, more, active, curvature());
    if (next.value - best.value < needed_gain) {
      active.pop_back();
      break;
    }
    gains.emplace_back(top->component, next.value - best.value);
    out.model = at(more, active, next.log_sigma);
    best = next;
    out.driven = true;
  }
  out.log_likelihood2 = best.value;

  for (std::size_t k = 0; k < active.size(); ++k) {
    const Component& c = *active[k];
    const double sigma = std::exp(best.log_sigma[k]);
    if (&c == &acc_white || &c == &gimbal_white) {
      const std::size_t rows = &c == &acc_white ? acc_rows : gimbal_rows;
      out.findings.push_back(white_finding(c, declared.*(c.sigma), sigma,
                                           1.0 / std::sqrt(2.0 * static_cast<double>(rows)), rows));
      continue;
    }
    NoiseFinding f;
    f.component = c.name;
    f.value = sigma / c.to_unit;
    f.unit = c.unit;
    if (c.tau) f.tau_s = out.model.*(c.tau);
    const double was = declared.*(c.sigma);
    f.factor = was > 0.0 ? sigma / was : std::nan("");
    f.factor_sigma = was > 0.0 ? f.factor * std::sqrt(best.inverse_curvature(k, k)) : std::nan("");
    for (const auto& [component, gain] : gains)
      if (component == &c) {
        f.log_likelihood_gain = 0.5 * gain;
        f.p_value =
            std::min(1.0, 6.0 * 0.5 * std::exp(stats::log_tail(gain, 1.0)));  // six alternatives
        f.significant = gain > significant_gain;
      }
    if (was > 0.0) {
      const double z = std::log(f.factor) / std::sqrt(best.inverse_curvature(k, k));
      f.p_value = std::exp(stats::log_tail(z * z, 1.0));
      f.significant = f.p_value < 1e-3;
    }
    out.findings.push_back(f);
  }
  return out;
}

NoiseEstimate noise_of_differences(const LinearProblem& problem, const VecX& residual) {
  // Second differences of a channel within a position: variance 6 sigma^2, blind to slopes. Their
  // median is blind to outliers too.
  std::array<std::vector<double>, 2> squares;
  std::array<std::vector<double>, num_channels> last;
  std::array<int, num_channels> position{};
  for (std::size_t k = 0; k < problem.tags.size(); ++k) {
    const RowTag& t = problem.tags[k];
    auto& seen = last[t.channel];
    if (position[t.channel] != t.position) seen.clear();
    position[t.channel] = t.position;
    seen.push_back(residual[k]);
    if (const std::size_t n = seen.size(); n >= 3) {
      const double d = seen[n - 1] - 2.0 * seen[n - 2] + seen[n - 3];
      squares[t.accelerometer() ? 0 : 1].push_back(d * d / 6.0);
    }
  }
  constexpr double median_of_square = 0.4549;  // of a standard normal
  NoiseEstimate out;
  for (const int kind : {0, 1}) {
    auto& s = squares[kind];
    if (s.size() < 10) continue;
    std::nth_element(s.begin(), s.begin() + s.size() / 2, s.end());
    const double factor = std::sqrt(std::max(s[s.size() / 2] / median_of_square, 1e-6));
    (kind == 0 ? out.model.acc_factor : out.model.gimbal_factor) = factor;
    // The median has 37 % efficiency, differences about half of the rows' information.
    out.findings.push_back(
        white_finding(kind == 0 ? acc_white : gimbal_white, 1.0, factor,
                      1.0 / std::sqrt(2.0 * 0.37 * 0.5 * static_cast<double>(s.size())), s.size()));
  }
  return out;
}

}  // namespace drift::inference
