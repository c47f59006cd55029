#include "analysis/inference/candidate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "analysis/inference/thresholds.hpp"
#include "core/estimate/strapdown/case_test.hpp"

namespace drift::inference {
namespace {

/// The parameters that a filter finds by itself.
ParamMask estimated(const FilterSpec& filter) {
  ParamMask mask = filter.active;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (filter.priors[i].sigma() <= 0.0) mask.reset(i);
  return mask;
}

/// Whether a strapdown unit can have an effect: one of its sensors. It has no servo, no gimbals and
/// no pier to lean. Of what torquers do to a command its gyros do four things to a rate;
/// cross-talk of theirs is misalignment by another name.
bool is_of_case(const TermInfo& term) {
  constexpr std::string_view of_rate[] = {"torquer_scale", "torquer_asymmetry",
                                          "torquer_nonlinearity", "torquer_temperature"};
  if (term.key == closure_term || std::ranges::find(of_rate, term.key) != std::end(of_rate))
    return true;
  return (term.subsystem == Subsystem::gyro || term.subsystem == Subsystem::accelerometers) &&
         !term.needs.gimbals && !term.in_gimbals && !term.in_offset;
}

bool by_definition(std::size_t param) {
  return std::ranges::find(strapdown::zero_by_definition, param) !=
         strapdown::zero_by_definition.end();
}

/// The other parameters of a term that is not in the nominal model are at their defaults.
Theta with_defaults(const TermInfo& term, const FilterSpec& nominal, Theta theta) {
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (!nominal.active[i] && !TermLibrary::specs[i].amplitude())
      theta[i] = nominal.believed(i).mean();
  return theta;
}

/// Whether the parameters of a term that have one unit are offered together, of all axes and of
/// one: its linear, its quadratic and its cubic part.
enum class Kinds { offered, left_out };

/// Sets of parameters that may be missing together; all of them, however many: whoever leaves a
/// term out does not know that it is needed. kinds: of sensors whose data sheets allow much, a part
/// must not bring in all of its term: sizes that the data do not show would be carried into
/// predictions.
std::vector<std::vector<std::size_t>> subsets_of(const std::vector<std::size_t>& missing,
                                                 Kinds kinds) {
  constexpr std::size_t most = 9;  // parameters of one candidate
  std::vector<std::vector<std::size_t>> sets;
  const auto add = [&](const std::vector<std::size_t>& set) {
    if (!set.empty() && set.size() <= most &&
        std::find(sets.begin(), sets.end(), set) == sets.end())
      sets.push_back(set);
  };
  std::map<std::string_view, std::vector<std::size_t>> axes, groups, units;
  std::map<std::pair<std::string_view, std::string_view>, std::vector<std::size_t>> units_of_axes;
  for (const std::size_t i : missing) {
    add({i});
    axes[TermLibrary::specs[i].axis].push_back(i);
    groups[TermLibrary::specs[i].group.view()].push_back(i);
    const std::string_view unit = TermLibrary::specs[i].unit.symbol.view();
    units[unit].push_back(i);
    units_of_axes[{TermLibrary::specs[i].axis, unit}].push_back(i);
  }
  for (const auto& [key, set] : groups) add(set);
  if (groups.size() > 1)
    for (const auto& [key, set] : axes) add(set);
  if (kinds == Kinds::offered) {
    for (const auto& [key, set] : units) add(set);
    for (const auto& [key, set] : units_of_axes) add(set);
  }
  add(missing);
  if (missing.size() > most) sets.push_back(missing);
  return sets;
}

std::string common_axis(const std::vector<std::size_t>& params) {
  const std::string_view first = TermLibrary::specs[params.front()].axis;
  for (const std::size_t i : params)
    if (TermLibrary::specs[i].axis != first) return {};
  return std::string(first);
}

std::size_t of_axis(const std::vector<std::size_t>& params, std::string_view axis) {
  return static_cast<std::size_t>(std::ranges::count_if(
      params, [&](std::size_t i) { return TermLibrary::specs[i].axis == axis; }));
}

std::string label_of(const TermInfo& term, const std::vector<std::size_t>& set,
                     const std::vector<std::size_t>& missing) {
  const std::string axis = common_axis(set);
  std::string label(term.key);
  if (!axis.empty()) label += "." + axis;
  // Where a term holds several groups, say which parameters are meant.
  if (missing.size() > 3 && set.size() < missing.size()) {
    std::string_view group = TermLibrary::specs[set.front()].group.view();
    std::vector<std::string_view> groups;
    for (const std::size_t i : set)
      if (std::ranges::find(groups, TermLibrary::specs[i].group.view()) == groups.end())
        groups.push_back(TermLibrary::specs[i].group.view());
    if (groups.size() == 1)
      label +=
          fmt::format(" {}", set.size() == 1 ? TermLibrary::specs[set.front()].key.view() : group);
    else if (axis.empty() || set.size() < of_axis(missing, axis))
      label += fmt::format(" {}", fmt::join(groups, " "));
  } else if (set.size() < (axis.empty() ? missing.size() : of_axis(missing, axis))) {
    // Of the few that no axis tells apart: the cosine, the sine, both.
    for (const std::size_t i : set) label += fmt::format(" {}", TermLibrary::specs[i].key.view());
  }
  return label;
}

/// Over which a setting is profiled, SI. A moment may be any of the test: equal parts of it are
/// equally likely, and each is stood for by its middle.
std::vector<double> values_of(const ParamSpec& spec, const Timeline& timeline) {
  std::vector<double> values;
  if (spec.kind == ParamKind::moment && !timeline.intervals.empty()) {
    const double begin = timeline.intervals.front().t0, end = timeline.intervals.back().t1;
    for (std::size_t k = 0; k < Grid::capacity; ++k)
      values.push_back(begin + (static_cast<double>(k) + 0.5) / Grid::capacity * (end - begin));
  }
  for (const double v : spec.grid) values.push_back(v * spec.unit.to_si);
  return values;
}

}  // namespace

std::vector<Settings> settings_of(const TermInfo& term, const ParamMask& known,
                                  const Timeline& timeline) {
  std::vector<Settings> all{{}};
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    if (!TermLibrary::specs[i].setting() || known[i]) continue;
    const std::vector<double> values = values_of(TermLibrary::specs[i], timeline);
    if (values.empty()) continue;
    std::vector<Settings> next;
    for (const Settings& s : all)
      for (const double v : values) {
        next.push_back(s);
        next.back().emplace_back(i, v);
      }
    all = std::move(next);
  }
  return all;
}

bool has_swing_for(const TermInfo& term, const Timeline& timeline) {
  if (!term.wants_swing) return true;
  if (!timeline.carries(covariate("temperature"))) return false;
  double low = 0.0, high = 0.0;  // deviations from their mean
  for (const Interval& i : timeline.intervals) {
    low = std::min(low, i.around1[covariate("temperature")]);
    high = std::max(high, i.around1[covariate("temperature")]);
  }
  return high - low >= TemperatureLimits::swing;
}

bool Candidate::contains(const Candidate& other) const {
  return term == other.term && params.size() > other.params.size() &&
         std::all_of(other.params.begin(), other.params.end(), [&](std::size_t i) {
           return std::find(params.begin(), params.end(), i) != params.end();
         });
}

bool Candidate::overlaps(const Candidate& other) const {
  return std::ranges::any_of(params, [&](std::size_t i) {
    return std::ranges::find(other.params, i) != other.params.end();
  });
}

CandidateSet library_candidates(const FilterSpec& nominal, const Theta& theta,
                                const Timeline& timeline) {
  CandidateSet out;
  const ParamMask known = estimated(nominal);
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    std::vector<std::size_t> missing;
    for (std::size_t i = term.first; i < term.first + term.count; ++i)
      if (!known[i] && TermLibrary::specs[i].amplitude() && !(timeline.of_case && by_definition(i)))
        missing.push_back(i);
    if (missing.empty() || (term.needs.turning && !timeline.of_case)) continue;
    // Where no temperature is known the terms of first order stand for all that follow it.
    if (term.wants_swing && !timeline.carries(covariate("temperature"))) continue;
    if (!timeline.carries(term.needs) || !has_swing_for(term, timeline)) {
      out.without_covariate.push_back(t);
      continue;
    }
    if (timeline.of_case && !is_of_case(term)) continue;
    // The couplings that are no member of the lambda family have no lambda to add.
    if (term.key == closure_term && family_of(nominal.coupling) != Coupling::lambda) continue;
    const auto settings = settings_of(term, known, timeline);
    const auto first = static_cast<int>(out.signatures.size());
    for (const Settings& s : settings)
      for (const std::size_t i : missing) {
        SignatureSpec spec{i, with_defaults(term, nominal, theta), nominal.believed(i).sigma()};
        for (const auto& [param, value] : s) spec.theta[param] = value;
        out.signatures.push_back(spec);
      }
    for (const auto& set :
         subsets_of(missing, timeline.of_case ? Kinds::offered : Kinds::left_out)) {
      Candidate c{std::string(term.key), common_axis(set), label_of(term, set, missing), set, {}};
      for (std::size_t v = 0; v < settings.size(); ++v) {
        Variant variant{{}, settings[v]};
        for (const std::size_t i : set) {
          const auto place = std::find(missing.begin(), missing.end(), i) - missing.begin();
          variant.columns.push_back(first + static_cast<int>(v * missing.size() + place));
        }
        c.variants.push_back(std::move(variant));
      }
      out.candidates.push_back(std::move(c));
    }
  }
  return out;
}

}  // namespace drift::inference
