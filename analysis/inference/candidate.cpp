#include "analysis/inference/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace drift::inference {
namespace {

/// "y" of "M_y"; empty if the key belongs to no axis.
std::string axis_of(const ParamSpec& spec) {
  const std::string_view key = spec.key.view();
  const auto bar = key.rfind('_');
  const std::string_view suffix = bar == key.npos ? "" : key.substr(bar + 1);
  for (const std::string_view axis : {"x", "y", "z", "outer", "middle", "inner"})
    if (suffix == axis) return std::string(axis);
  return {};
}

bool is_amplitude(const ParamSpec& spec) {
  return spec.kind == ParamKind::linear && spec.prior.sigma() > 0.0;
}

/// Whether the test carries what a term wants to see.
bool can_be_seen(const TermInfo& term, const Timeline& timeline) {
  return (!term.needs.temperature || timeline.has_temperature) &&
         (!term.needs.field || timeline.has_field);
}

using Settings = std::vector<std::pair<std::size_t, double>>;

/// Every combination of the grids of a term's nonlinear parameters; one empty setting without any.
std::vector<Settings> settings_of(const TermInfo& term, const FilterSpec& nominal) {
  std::vector<Settings> all{{}};
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    if (spec.grid.size == 0 || (nominal.active[i] && nominal.priors[i].sigma() > 0.0)) continue;
    std::vector<Settings> next;
    for (const Settings& s : all)
      for (const double v : spec.grid) {
        next.push_back(s);
        next.back().emplace_back(i, v * spec.unit.to_si);
      }
    all = std::move(next);
  }
  return all;
}

/// The other parameters of a term that is not in the nominal model are at their defaults.
Theta with_defaults(const TermInfo& term, const FilterSpec& nominal, Theta theta) {
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (!nominal.active[i] && !is_amplitude(TermLibrary::specs[i]))
      theta[i] = TermLibrary::specs[i].prior_si().mean();
  return theta;
}

/// Sets of parameters that may be missing together. whole: all of them, however many.
std::vector<std::vector<std::size_t>> subsets_of(const std::vector<std::size_t>& missing,
                                                 bool whole) {
  constexpr std::size_t most = 9;  // parameters of one candidate
  std::vector<std::vector<std::size_t>> sets;
  const auto add = [&](const std::vector<std::size_t>& set) {
    if (!set.empty() && set.size() <= most &&
        std::find(sets.begin(), sets.end(), set) == sets.end())
      sets.push_back(set);
  };
  std::map<std::string, std::vector<std::size_t>> axes, groups;
  for (const std::size_t i : missing) {
    add({i});
    axes[axis_of(TermLibrary::specs[i])].push_back(i);
    groups[std::string(TermLibrary::specs[i].group.view())].push_back(i);
  }
  for (const auto& [key, set] : groups) add(set);
  if (groups.size() > 1)
    for (const auto& [key, set] : axes) add(set);
  add(missing);
  if (whole && missing.size() > most) sets.push_back(missing);
  return sets;
}

std::string common_axis(const std::vector<std::size_t>& params) {
  const std::string first = axis_of(TermLibrary::specs[params.front()]);
  for (const std::size_t i : params)
    if (axis_of(TermLibrary::specs[i]) != first) return {};
  return first;
}

std::string label_of(const TermInfo& term, const std::vector<std::size_t>& set,
                     std::size_t in_term) {
  const std::string axis = common_axis(set);
  std::string label(term.key);
  if (!axis.empty()) label += "." + axis;
  // Where a term holds several groups, say which parameters are meant.
  if (in_term > 3 && set.size() < in_term) {
    std::string_view group = TermLibrary::specs[set.front()].group.view();
    bool one_group = true;
    for (const std::size_t i : set)
      one_group = one_group && TermLibrary::specs[i].group.view() == group;
    if (one_group)
      label +=
          fmt::format(" {}", set.size() == 1 ? TermLibrary::specs[set.front()].key.view() : group);
  }
  return label;
}

}  // namespace

bool Candidate::contains(const Candidate& other) const {
  return term == other.term && params.size() > other.params.size() &&
         std::all_of(other.params.begin(), other.params.end(), [&](std::size_t i) {
           return std::find(params.begin(), params.end(), i) != params.end();
         });
}

CandidateSet library_candidates(const FilterSpec& nominal, const Theta& theta,
                                const Timeline& timeline) {
  CandidateSet out;
  for (const TermInfo& term : TermLibrary::terms) {
    if (!can_be_seen(term, timeline)) continue;
    std::vector<std::size_t> missing;
    for (std::size_t i = term.first; i < term.first + term.count; ++i)
      if (!(nominal.active[i] && nominal.priors[i].sigma() > 0.0) &&
          is_amplitude(TermLibrary::specs[i]))
        missing.push_back(i);
    if (missing.empty()) continue;
    // The couplings that are no member of the lambda family have no lambda to add.
    if (term.key == "frame_closure" && nominal.coupling != Coupling::eq5 &&
        nominal.coupling != Coupling::eq6 && nominal.coupling != Coupling::lambda)
      continue;
    const auto settings = settings_of(term, nominal);
    const auto first = static_cast<int>(out.signatures.size());
    for (const Settings& s : settings)
      for (const std::size_t i : missing) {
        SignatureSpec spec{i, with_defaults(term, nominal, theta),
                           TermLibrary::specs[i].prior_si().sigma()};
        for (const auto& [param, value] : s) spec.theta[param] = value;
        out.signatures.push_back(spec);
      }
    // A base term is left out by whoever does not know that it is needed: then all of it is
    // missing.
    const bool base = *TermLibrary::find_term(term.key) < *TermLibrary::find_term("frame_closure");
    for (const auto& set : subsets_of(missing, base)) {
      Candidate c{
          std::string(term.key), common_axis(set), label_of(term, set, missing.size()), set, {}};
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
