#include "mc/task/left_out.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/estimate/layout.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/truth.hpp"

namespace drift::mc {
namespace {

/// Numbers that a study gives alike, whatever their units.
bool same(double a, double b) {
  constexpr double rounding = 1e-12;  // of a conversion, relative
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// Whether something believed known is what the truth always has.
bool same(const Prior& truth, double known) {
  return truth.sigma() == 0.0 && same(truth.mean(), known);
}

bool has_size(const Prior& prior) {
  return prior.sigma() > 0.0 || prior.mean() != 0.0;
}

/// The size of something, or one of what it cannot do without.
bool is_size(const ParamSpec& spec) {
  return spec.amplitude() || (spec.kind == ParamKind::noise && !spec.axis.empty());
}

/// Whether a term of the truth does anything: one that has sizes by one of them, another (outliers)
/// by all it has.
bool acts(const TruthSpec& truth, const TermInfo& term) {
  bool has_sizes = false, any = false, all = true;
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    has_sizes = has_sizes || is_size(TermLibrary::specs[i]);
    if (!truth.active[i]) continue;
    const bool there = has_size(truth.priors[i]);
    any = any || (there && is_size(TermLibrary::specs[i]));
    all = all && there;
  }
  return has_sizes ? any : all;
}

/// Lambda of a coupling whose loop compensates nothing; nothing if it is no member of the family by
/// name.
std::optional<double> lambda_compensating_nothing(Coupling coupling) {
  return facts(facts(coupling).compensating_nothing).lambda;
}

/// Lambda of the equation that the truth obeys; nothing if it is no member of the family.
std::optional<Prior> lambda_of(const TruthSpec& truth) {
  if (truth.coupling == Coupling::lambda) return truth.priors[closure_param];
  const auto lambda = lambda_compensating_nothing(truth.coupling);
  if (lambda && truth.loop == LoopEstimate::given && truth.theta_loop.isZero(0.0))
    return fixed(*lambda);
  Theta theta = Theta::Zero();
  set_lambda(truth, theta);
  if (!std::isfinite(theta[closure_param])) return std::nullopt;
  return fixed(theta[closure_param]);
}

bool same_equation(const TruthSpec& truth, const FilterSpec& filter) {
  if (truth.coupling == filter.coupling && truth.coupling != Coupling::lambda) return true;
  const std::optional<Prior> lambda = lambda_of(truth);
  if (!lambda) return false;
  if (filter.coupling == Coupling::lambda) {
    const Prior& own = filter.priors[closure_param];
    return own.sigma() > 0.0 || same(*lambda, own.mean());
  }
  // What the loop of a filter believes is what the truth's does, and that of another coupling
  // believes nothing.
  const auto own = lambda_compensating_nothing(filter.coupling);
  return own && same(*lambda, *own);
}

/// Random walks of drifts, whether a term or a key of the model makes them.
void compare_walks(const TruthSpec& truth, const FilterSpec& filter, const Theta& known,
                   LeftOut& out) {
  constexpr std::size_t q = TermLibrary::index("q_x");
  const Theta sizes = make_layout(truth).theta;
  for (int axis = 0; axis < 3; ++axis) {
    if (drift_walk(truth.noise, truth.model().terms, sizes, axis) == 0.0 ||
        drift_walk(filter.noise, filter.model().terms, known, axis) > 0.0)
      continue;
    if (truth.noise.drift_random_walk == 0.0)
      out.parameters.set(q + axis);
    else if (std::ranges::find(out.noise, "drift_random_walk") == out.noise.end())
      out.noise.emplace_back("drift_random_walk");
  }
}

}  // namespace

LeftOut left_out(const TruthSpec& truth, const FilterSpec& filter) {
  constexpr std::size_t walk = TermLibrary::term_index("drift_random_walk");
  const Layout layout = make_layout(filter);
  LeftOut out;
  out.equation = !same_equation(truth, filter);
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (t == walk || term.first == closure_param || !acts(truth, term)) continue;
    for (std::size_t i = term.first; i < term.first + term.count; ++i) {
      const ParamSpec& spec = TermLibrary::specs[i];
      if (!truth.active[i] || (is_size(spec) && !has_size(truth.priors[i]))) continue;
      const bool is_state = filter.priors[i].sigma() > 0.0 && can_be_state(spec);
      // Of a noise the filter allows for the size that it believes in.
      const bool is_noise = spec.kind == ParamKind::noise;
      if (!filter.active[i] || (is_noise && layout.theta[i] == 0.0))
        out.parameters.set(i);
      else if (!is_state && !is_noise && !same(truth.priors[i], layout.theta[i]))
        out.held.set(i);
    }
  }
  compare_walks(truth, filter, layout.theta, out);
  if (truth.noise.angle_random_walk > 0.0 && filter.noise.angle_random_walk == 0.0)
    out.noise.emplace_back("angle_random_walk");
  return out;
}

bool drawn_from_beliefs(const TruthSpec& truth, const FilterSpec& filter) {
  if (truth.coupling != filter.coupling || !left_out(truth, filter).nothing()) return false;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (filter.active[i] && !(truth.active[i] && truth.priors[i] == filter.priors[i])) return false;
  return truth.initial_attitude == filter.initial_attitude &&
         truth.noise.angle_random_walk == filter.noise.angle_random_walk &&
         truth.noise.drift_random_walk == filter.noise.drift_random_walk &&
         (filter.starts.empty() || filter.starts.front().empty());
}

}  // namespace drift::mc
