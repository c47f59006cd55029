#include "mc/task/left_out.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/estimate/layout.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/truth.hpp"

namespace drift::mc {
namespace {

/// Those that add to E.
constexpr std::size_t misalignment_terms[] = {TermLibrary::term_index("gyro_misalignment"),
                                              TermLibrary::term_index("misalignment_creep")};

/// Numbers that a study gives alike, whatever their units.
bool same(double a, double b) {
  constexpr double rounding = 1e-12;  // of a conversion, relative
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

bool is_less(double a, double b) {
  return a < b && !same(a, b);
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

/// Whether a model has a misalignment of the gyros' input axes, E, which is all that equations
/// close over in different ways: without it they are one.
bool is_misaligned(const ModelSpec& spec) {
  for (const std::size_t t : misalignment_terms) {
    const TermInfo& term = TermLibrary::terms[t];
    for (std::size_t i = term.first; i < term.first + term.count; ++i)
      if (spec.active[i] && has_size(spec.priors[i])) return true;
  }
  return false;
}

/// Whether the prior of an estimated parameter rules the truth's values out.
bool excludes(const Prior& own, const Prior& truth) {
  return std::hypot(truth.mean() - own.mean(), truth.sigma()) > far_off_prior * own.sigma();
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
  if (!is_misaligned(truth) || !is_misaligned(filter)) return true;
  if (filter.coupling == Coupling::lambda) {
    const Prior& own = filter.priors[closure_param];
    return own.sigma() > 0.0 || same(*lambda, own.mean());
  }
  // What the loop of a filter believes is what the truth's does, and that of another coupling
  // believes nothing.
  const auto own = lambda_compensating_nothing(filter.coupling);
  return own && same(*lambda, *own);
}

/// A filter that estimates lambda has the truth's equation, unless its prior is as good as a number
/// that the truth's is not.
void compare_lambda(const TruthSpec& truth, const FilterSpec& filter, LeftOut& out) {
  const Prior& own = filter.priors[closure_param];
  if (filter.coupling != Coupling::lambda || own.sigma() == 0.0) return;
  const std::optional<Prior> lambda = lambda_of(truth);
  if (lambda && is_misaligned(truth) && is_misaligned(filter) && excludes(own, *lambda))
    out.excluded.set(closure_param);
}

/// Notes the key of a noise, once, where the filter has none of it or less than the truth.
void compare_key(std::string_view key, double truth, double filter, LeftOut& out) {
  std::vector<std::string_view>& keys = filter > 0.0 ? out.smaller_keys : out.noise;
  if (is_less(filter, truth) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
}

/// Random walks of drifts, whether a term or a key of the model makes them.
void compare_walks(const TruthSpec& truth, const FilterSpec& filter, const Theta& known,
                   LeftOut& out) {
  constexpr std::size_t q = TermLibrary::index("q_x");
  const Theta sizes = make_layout(truth).theta;
  for (int axis = 0; axis < 3; ++axis) {
    const double walk = drift_walk(truth.noise, truth.model().terms, sizes, axis),
                 own = drift_walk(filter.noise, filter.model().terms, known, axis);
    if (truth.noise.drift_random_walk > 0.0)
      compare_key("drift_random_walk", walk, own, out);
    else if (is_less(own, walk))
      (own > 0.0 ? out.smaller : out.parameters).set(q + axis);
  }
}

/// A noise of a term that the filter has, too. The longer a level lasts the less it takes a drift
/// for free; what a gate and the outliers behind it are is the filter's own business.
void compare_noise(std::size_t param, double truth, double known, LeftOut& out) {
  if (param == TermLibrary::index("B_dwell")) {
    if (is_less(truth, known)) out.held.set(param);
  } else if (is_size(TermLibrary::specs[param]) && is_less(known, truth)) {
    out.smaller.set(param);
  }
}

}  // namespace

LeftOut left_out(const TruthSpec& truth, const FilterSpec& filter) {
  constexpr std::size_t walk = TermLibrary::term_index("drift_random_walk");
  const Layout layout = make_layout(filter);
  const Theta sizes = make_layout(truth).theta;  // of what is random, the root mean square
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
      else if (is_noise)
        compare_noise(i, sizes[i], layout.theta[i], out);
      else if (is_state && excludes(filter.priors[i], truth.priors[i]))
        out.excluded.set(i);
      else if (!is_state && !same(truth.priors[i], layout.theta[i]))
        out.held.set(i);
    }
  }
  compare_lambda(truth, filter, out);
  compare_walks(truth, filter, layout.theta, out);
  compare_key("angle_random_walk", truth.noise.angle_random_walk, filter.noise.angle_random_walk,
              out);
  if (is_less(filter.initial_attitude, truth.initial_attitude))
    out.smaller_keys.emplace_back("initial_attitude");
  const ServoOptions& servo = truth.servo;
  if (truth.coupling == Coupling::servo && servo.base_amplitude > 0.0 && servo.base_frequency > 0.0)
    out.noise.emplace_back("servo.base_amplitude");
  return out;
}

LeftOut left_out(const Study& study, std::size_t filter) {
  LeftOut out = left_out(study.truth, study.filters[filter]);
  const auto is_slewed = [](const Position& p) { return p.entry == Entry::torqued; };
  if (study.truth.coupling == Coupling::servo && study.truth.servo.coulomb > 0.0 &&
      std::ranges::any_of(study.plan.positions, is_slewed))
    out.noise.emplace_back("servo.coulomb");
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
