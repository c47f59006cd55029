#include "analysis/diagnosis/located.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>

#include "analysis/diagnosis/acting.hpp"
#include "analysis/diagnosis/locate.hpp"
#include "analysis/search/scores/explained.hpp"
#include "core/base/named.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift::diagnosis {
namespace {

constexpr int bins_per_position = 6;
constexpr std::size_t most_signals = 2, most_windows = 8;

/// The axis on which something of an equation is seen best: by the inputs of free form, strongest
/// first, where there are any, else by the windows.
std::optional<int> seen_axis(const search::Fitted& nominal,
                             const std::vector<InputEstimate>& inputs,
                             inference::Equation equation) {
  for (const InputEstimate& input : inputs)
    if (input.equation == equation) return input.axis;
  std::optional<int> axis;
  double strongest = 0.0;
  for (const inference::PositionScan& scan : nominal.scans)
    for (std::size_t k = 0; k < scan.windows.size(); ++k)
      if (scan.windows[k].equation == equation &&
          scan.T[static_cast<Eigen::Index>(k)] > strongest) {
        strongest = scan.T[static_cast<Eigen::Index>(k)];
        axis = scan.windows[k].axis;
      }
  return axis;
}

/// An equation on one axis.
struct Place {
  inference::Equation equation;
  int axis;
  bool operator==(const Place&) const = default;
  std::string name() const { return inference::equation_name(equation, axis); }
};

/// Drift of a gyro moves the platform.
inference::Equation equation_of(OwnSlot slot) {
  if (slot == OwnSlot::accelerometer) return inference::Equation::accelerometer;
  return slot == OwnSlot::gimbal ? inference::Equation::gimbal : inference::Equation::rate;
}

/// Where causes act, each place once. What has no axis of its own is where its kind is seen best;
/// left out where it is not.
std::vector<Place> places_of(const std::vector<Acting>& acting, const search::Fitted& nominal,
                             const std::vector<InputEstimate>& inputs) {
  std::vector<Place> all;
  for (const Acting& a : acting) {
    std::optional<int> axis = a.axis;
    if (!axis) axis = seen_axis(nominal, inputs, a.equation);
    if (!axis) continue;
    const Place place{a.equation, *axis};
    if (std::ranges::find(all, place) == all.end()) all.push_back(place);
  }
  return all;
}

std::string equation_of(const Judged& judged, const std::vector<InputEstimate>& inputs,
                        const inference::Window* window) {
  using Equation = inference::Equation;
  if (judged.one_gyro) return inference::equation_name(Equation::rate, judged.one_gyro->axis);
  if (judged.verdict == Verdict::consistent) return "";
  if (!inputs.empty() && inputs.front().gain > 0.0)
    return inference::equation_name(inputs.front().equation, inputs.front().axis);
  return window ? inference::equation_name(window->equation, window->axis) : "";
}

/// The time in which a cause acts that sets in once.
ScanHit window_of(const Place& place, double onset, const search::Cause& cause,
                  const Timeline& timeline) {
  const auto& all = timeline.intervals;
  const auto at = std::ranges::find_if(all, [&](const Interval& i) { return i.t1 > onset; });
  ScanHit hit;
  hit.equation = place.name();
  hit.position = (at == all.end() ? all.back() : *at).position + 1;
  hit.start_s = onset;
  hit.end_s = all.back().t1;
  hit.T = cause.T;
  hit.p_value = cause.p_value;
  return hit;
}

/// Those of all causes.
std::vector<ScanHit> windows_of(const std::vector<search::Cause>& causes,
                                const std::vector<Acting>& acting, const search::Fitted& nominal,
                                const std::vector<InputEstimate>& inputs,
                                const Timeline& timeline) {
  std::vector<ScanHit> all;
  for (std::size_t k = 0; k < acting.size(); ++k) {
    if (!acting[k].onset) continue;
    for (const Place& place : places_of({acting[k]}, nominal, inputs))
      all.push_back(window_of(place, *acting[k].onset, causes[k], timeline));
  }
  return all;
}

/// The input at a place before all others.
void put_first(std::vector<InputEstimate>& inputs, const Place& place) {
  const auto its = std::ranges::find_if(inputs, [&](const InputEstimate& i) {
    return place == Place{i.equation, i.axis};
  });
  if (its != inputs.end()) std::rotate(inputs.begin(), its, its + 1);
}

/// The inputs at some places, in their order.
std::vector<InputEstimate> inputs_at(const std::vector<Place>& places,
                                     const std::vector<InputEstimate>& inputs) {
  std::vector<InputEstimate> all;
  for (const Place& place : places)
    for (const InputEstimate& input : inputs)
      if (place == Place{input.equation, input.axis}) all.push_back(input);
  return all;
}

}  // namespace

inference::NoiseModel noise_without_effect(const search::Fitted& nominal,
                                           const search::Search& found) {
  if (found.significant) return nominal.noise.model;
  inference::NoiseModel white = search::declared_noise(nominal.filter);
  white.acc_factor = nominal.noise.model.acc_factor;
  white.gimbal_factor = nominal.noise.model.gimbal_factor;
  return white;
}

Located located(const search::Fitted& nominal, const search::Search& found, const Judged& judged,
                const std::vector<search::Cause>& causes, const Timeline& timeline,
                const std::vector<preparation::Covariate>& covariates, Signals signals) {
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();
  // What the cause explains, by the refit: what it takes out of the residuals.
  inference::LinearProblem shown = nominal.problem.bare();
  shown.extra.resize(shown.rows(), best ? 1 : 0);
  std::vector<std::pair<int, double>> cause;
  if (best) {
    shown.extra.col(0) = search::taken_out(nominal.problem, nominal.filter, nominal.fit,
                                           best->filter, best->after.fit);
    cause.emplace_back(0, 1.0);
  }
  std::vector<InputEstimate> inputs;
  if (signals == Signals::recovered && judged.verdict != Verdict::consistent)
    inputs = estimate_inputs(shown, timeline,
                             inference::Projector(shown, noise_without_effect(nominal, found)),
                             bins_per_position);

  const inference::Window* window = strongest_window(nominal);
  const inference::PeriodicInput* period =
      judged.verdict == Verdict::unexplained && !judged.one_gyro ? nominal.leading_period()
                                                                 : nullptr;
  // Where nothing explains it: what the nearest effect takes, or one window, is a part that was
  // chosen for being where it is.
  std::optional<VecX> signature;
  if (period)
    signature = inference::trace_of(*period, nominal.problem, *nominal.projector);
  else if (best && judged.verdict != Verdict::unexplained)
    signature = signature_of(inference::Projector(shown, nominal.noise.model), cause);
  Located out{locate(nominal, found.thresholds, signature, most_windows), {}};
  std::vector<search::Cause> named;
  if (judged.verdict == Verdict::named)
    std::ranges::copy_if(causes, std::back_inserter(named),
                         [](const search::Cause& c) { return c.set == 0; });
  const std::vector<Acting> acting = acting_of(std::span<const search::Cause>(named));
  const std::vector<Place> places = places_of(acting, nominal, inputs);
  if (places.empty()) {
    if (period) put_first(inputs, {period->equation, period->axis});
    out.where.equation = period ? inference::equation_name(period->equation, period->axis)
                                : equation_of(judged, inputs, window);
    ShapeFrom shape =
        judged.verdict == Verdict::ambiguous && best ? ShapeFrom::alternative : ShapeFrom::signal;
    for (std::size_t k = 0; k < std::min(most_signals, inputs.size()); ++k) {
      out.signals.push_back(recovered_signal(inputs[k], timeline, covariates, cause, shape));
      // The second is the same misfit as another equation would take it: one shape is enough.
      if (shape == ShapeFrom::signal) shape = ShapeFrom::nothing;
    }
    if (period && !out.signals.empty()) {  // bins may be too long to show it
      out.signals.front().say_no_shape();
      out.signals.front().shape.kind = Shape::Kind::period;
      out.signals.front().shape.seconds = period->period_s;
    }
    return out;
  }
  out.where.equation = places.front().name();
  for (const Place& place : places) out.where.equations.push_back(place.name());
  out.where.windows = windows_of(named, acting, nominal, inputs, timeline);
  if (named.size() == 1 && acting.front().onset) out.where.onset_s = *acting.front().onset;
  for (const InputEstimate& input : inputs_at(places, inputs))
    out.signals.push_back(recovered_signal(input, timeline, covariates, cause, ShapeFrom::cause));
  return out;
}

void move_to(Located& place, const Proposal& form) {
  const OwnTarget on = *value_in(own_targets, form.acts_on);
  const std::string equation = Place{equation_of(on.slot), on.axis}.name();
  place.where.equation = equation;
  const auto its = std::ranges::find(place.signals, equation, &RecoveredSignal::equation);
  if (its == place.signals.end()) return;
  std::rotate(place.signals.begin(), its, its + 1);
  for (RecoveredSignal& s : place.signals) s.say_no_shape();
  place.signals.front().shape.kind = Shape::Kind::of_form;
}

}  // namespace drift::diagnosis
