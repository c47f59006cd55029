#include "analysis/blind/library_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/blind/generate.hpp"
#include "analysis/inference/candidate.hpp"
#include "core/base/shuffle.hpp"

namespace drift::blind {
namespace {

template <class T>
const T& one_of(const std::vector<T>& list, Stream& stream) {
  return list[static_cast<std::size_t>(stream.uniform() * static_cast<double>(list.size()))];
}

/// A value of a nonlinear parameter [SI]: between the ends of its grid, not on it; a moment is any
/// of the test.
double draw_setting(const ParamSpec& spec, double duration, Stream& stream) {
  const Grid& grid = spec.grid;
  if (spec.kind == ParamKind::moment) return duration * stream.uniform();
  if (grid.size == 0) return spec.prior_si().mean();
  if (spec.kind == ParamKind::discrete)
    return grid.values[static_cast<std::size_t>(stream.uniform() *
                                                static_cast<double>(grid.size))] *
           spec.unit.to_si;
  double low = *std::min_element(grid.begin(), grid.end()) * spec.unit.to_si;
  double high = *std::max_element(grid.begin(), grid.end()) * spec.unit.to_si;
  if (spec.unit.same_dimension(unit::s)) high = std::max(low, std::min(high, 0.9 * duration));
  return low > 0.0 && high > 4.0 * low ? low * std::pow(high / low, stream.uniform())
                                       : low + (high - low) * stream.uniform();
}

HiddenParameter numbers_of(std::size_t param, double si) {
  const ParamSpec& spec = TermLibrary::specs[param];
  return {std::string(spec.key.view()), si / spec.unit.to_si, std::string(spec.unit.symbol.view())};
}

/// The model form itself: lambda moved away from where the nominal filter has it. A servo closes
/// like eq. (6) whatever is asked.
std::optional<Source> frame_closure(const World& world, const FilterSpec& nominal) {
  if (world.truth.coupling == Coupling::servo || nominal.active[closure_param] ||
      !facts(nominal.coupling).lambda)
    return std::nullopt;
  const double from = *facts(nominal.coupling).lambda;
  const auto value = [from](double strength) { return from + (from > 0.0 ? -strength : strength); };
  Source s;
  s.effect.term = closure_term;
  s.effect.words = "the loop closes between eq. (5) and eq. (6)";
  s.first = 0.2;
  s.most = 1.0;
  s.put = [value](World& w, double strength) {
    w.truth.coupling = Coupling::lambda;
    w.truth.active.set(closure_param);
    w.draw.theta[closure_param] = value(strength);
  };
  s.parameters = [value](double strength) {
    return std::vector<HiddenParameter>{numbers_of(closure_param, value(strength))};
  };
  return s;
}

}  // namespace

std::vector<std::size_t> missing_parameters(const TermInfo& term, const FilterSpec& nominal) {
  std::vector<std::size_t> missing;
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (!nominal.active[i] && TermLibrary::specs[i].amplitude()) missing.push_back(i);
  return missing;
}

std::vector<std::size_t> hideable_terms(const FilterSpec& nominal, const Timeline& timeline) {
  std::vector<std::size_t> terms;
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (!missing_parameters(term, nominal).empty() && inference::has_swing_for(term, timeline))
      terms.push_back(t);
  }
  return terms;
}

std::vector<std::size_t> in_turn(std::vector<std::size_t> terms, std::uint64_t seed,
                                 std::size_t index) {
  Stream mix(seed, 0, Purpose::design, choice_stream);
  shuffle(terms, mix);
  if (!terms.empty())
    std::rotate(terms.begin(), terms.begin() + static_cast<long>(index % terms.size()),
                terms.end());
  return terms;
}

std::optional<Source> library_source(std::size_t t, const World& world, const FilterSpec& nominal,
                                     double most, Stream& stream) {
  const TermInfo& term = TermLibrary::terms[t];
  if (term.key == closure_term) return frame_closure(world, nominal);
  if (!world.timeline.carries(term.needs)) return std::nullopt;
  const auto missing = missing_parameters(term, nominal);
  std::vector<std::string_view> axes;
  for (const std::size_t i : missing)
    if (const auto axis = TermLibrary::specs[i].axis; std::ranges::find(axes, axis) == axes.end())
      axes.push_back(axis);
  const std::string axis(one_of(axes, stream));
  std::vector<std::size_t> params;
  for (const std::size_t i : missing)
    if (TermLibrary::specs[i].axis == axis) params.push_back(i);
  constexpr double share_of_one = 0.6;
  if (stream.uniform() < share_of_one) params = {one_of(params, stream)};

  Theta direction = Theta::Zero(), settings = Theta::Zero();
  ParamMask active;
  double norm = 0.0;
  for (const std::size_t i : params) {
    const double share = stream.normal();
    direction[i] = share * nominal.believed(i).sigma();
    norm += share * share;
    active.set(i);
  }
  direction /= std::sqrt(norm);
  const double duration = world.timeline.intervals.back().t1 - world.timeline.intervals.front().t0;
  std::vector<std::size_t> profiled;
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    if (spec.amplitude() || nominal.active[i]) continue;
    settings[i] = draw_setting(spec, duration, stream);
    active.set(i);
    profiled.push_back(i);
  }
  Source s;
  s.effect.term = std::string(term.key);
  s.effect.axis = axis;
  s.effect.words = std::string(term.title);
  s.first = 0.3;
  s.most = most;
  s.put = [=](World& w, double strength) {
    w.truth.active |= active;
    w.draw.theta += strength * direction + settings;
  };
  s.parameters = [=](double strength) {
    std::vector<HiddenParameter> all;
    for (const std::size_t i : params) all.push_back(numbers_of(i, strength * direction[i]));
    for (const std::size_t i : profiled) all.push_back(numbers_of(i, settings[i]));
    return all;
  };
  return s;
}

}  // namespace drift::blind
