#include "analysis/diagnosis/advice/patched_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/check.hpp"
#include "core/base/number_text.hpp"
#include "core/config/load.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::diagnosis {
namespace {

using config::list_node;
using config::Node;
using config::text_node;

constexpr int noise_digits = 3;  // it is never known better

/// The value of a key of a table, made if it is not there.
Node& at(Node& table, const std::string& key) {
  if (Node* found = table.find(key)) return *found;
  table.members.push_back({key, {}, {}});
  return table.members.back().value;
}

Node quantity_node(double si, const Unit& unit) {
  const double value = si / unit.to_si;
  if (unit.to_si != 1.0 || unit.dim != Dimension{})
    return text_node(fmt::format("{} {}", value, unit.symbol.view()));
  return config::real_node(value);
}

Node prior_node(const Prior& prior, const Unit& unit) {
  if (prior.kind == Prior::Kind::fixed) return quantity_node(prior.a, unit);
  Node node;
  node.members.push_back({prior.kind == Prior::Kind::normal ? "normal" : "uniform",
                          {},
                          list_node({quantity_node(prior.a, unit), quantity_node(prior.b, unit)})});
  return node;
}

/// A prior as wide as a value that is farther from its mean than it makes likely.
Prior with_room_for(Prior prior, double value) {
  const double off = std::abs(value - prior.a);
  if (prior.kind == Prior::Kind::normal && off > inference::WeighLimits::prior * prior.b)
    prior.b = off;
  return prior;
}

/// The nearest value that a prior allows.
double within(const Prior& prior, double value) {
  return prior.kind == Prior::Kind::uniform ? std::clamp(value, prior.a, prior.b) : value;
}

Node parsed(const mc::Study& study) {
  return config::parse_document(study.text, study.path);
}

Node& first_filter(Node& root, const mc::Study& study) {
  Node* filters = root.find("filter");
  if (filters == nullptr || filters->items.empty() || study.filters.empty())
    throw InputError(
        ExitCode::config,
        fmt::format("{}: no [[filter]] to be patched (expected the nominal model). Add "
                    "a section [[filter]]",
                    study.path));
  return filters->items.front();
}

}  // namespace

FilterSpec patched_filter(const FilterSpec& nominal, const std::vector<search::Cause>& causes) {
  FilterSpec library;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    library.priors[i] = TermLibrary::specs[i].prior_si();
  return patched_filter(nominal, causes, library);
}

FilterSpec patched_filter(const FilterSpec& nominal, const std::vector<search::Cause>& causes,
                          const FilterSpec& believed) {
  FilterSpec patched = nominal;
  for (const search::Cause& cause : causes)
    for (const search::CauseParameter& p : cause.parameters) {
      patched.active.set(p.param);
      const ParamSpec& spec = TermLibrary::specs[p.param];
      const double value = p.value * spec.unit.to_si;
      patched.priors[p.param] =
          p.profiled ? fixed(value) : with_room_for(believed.believed(p.param), value);
      if (p.param == closure_param) patched.coupling = family_of(patched.coupling);
    }
  // A term comes with its time constant and the like, known until the study says otherwise.
  const ParamMask whole = TermLibrary::completed(patched.active);
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (whole[i] && !patched.active[i]) patched.priors[i] = believed.believed(i);
  patched.active = whole;
  return patched;
}

FilterSpec with_room_for_causes(FilterSpec patched, const std::vector<search::Cause>& causes) {
  for (const search::Cause& cause : causes)
    for (const search::CauseParameter& p : cause.parameters) {
      if (cause.set != 0 || p.profiled || !patched.active[p.param]) continue;
      Prior& prior = patched.priors[p.param];
      const double value = p.value * TermLibrary::specs[p.param].unit.to_si;
      if (p.param != closure_param)
        prior = with_room_for(prior, value);
      else if (prior.sigma() < p.sigma)  // the profile's, held
        prior = fixed(value);
    }
  return patched;
}

FilterSpec started_where_found(FilterSpec patched, const std::vector<search::Cause>& causes) {
  std::vector<const search::CauseParameter*> far_from_linear, found;
  for (const search::Cause& cause : causes) {
    if (cause.set != 0) continue;
    for (const search::CauseParameter& p : cause.parameters) {
      if (!patched.active[p.param] || patched.priors[p.param].sigma() <= 0.0) continue;
      found.push_back(&p);
      if (p.param == closure_param || TermLibrary::specs[p.param].continuous())
        far_from_linear.push_back(&p);
    }
  }
  if (far_from_linear.empty()) return patched;
  if (patched.starts.empty()) patched.starts.emplace_back();
  for (Start& start : patched.starts)
    for (const search::CauseParameter* p : found) {
      std::erase_if(start, [&](const auto& given) { return given.first == p->param; });
      start.emplace_back(p->param, within(patched.priors[p->param],
                                          p->value * TermLibrary::specs[p->param].unit.to_si));
    }
  patched.drawn_starts = static_cast<int>(patched.starts.size());
  return patched;
}

std::string patched_study(const mc::Study& study, const FilterSpec& patched) {
  Node root = parsed(study);
  Node& filter = first_filter(root, study);
  const FilterSpec& nominal = study.filters.front();

  Node& terms = at(filter, "terms") = list_node({});
  for (const std::string& term : terms_text(patched.active)) terms.items.push_back(text_node(term));
  if (patched.coupling != nominal.coupling)
    at(filter, "coupling") = text_node(std::string(key_of(patched.coupling)));

  Node parameters = filter.find("parameters") ? *filter.find("parameters") : Node{};
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!patched.active[i] || (nominal.active[i] && patched.priors[i] == nominal.priors[i]))
      continue;
    const ParamSpec& spec = TermLibrary::specs[i];
    at(parameters, std::string(spec.key.view())) = prior_node(patched.priors[i], spec.unit);
  }
  if (!parameters.members.empty()) at(filter, "parameters") = std::move(parameters);

  if (patched.starts != nominal.starts) {
    Node& starts = at(filter, "starts") = list_node({});
    for (const Start& start : patched.starts) {
      Node one;
      for (const auto& [i, value] : start)
        at(one, std::string(TermLibrary::specs[i].key.view())) =
            quantity_node(value, TermLibrary::specs[i].unit);
      starts.items.push_back(std::move(one));
    }
  }

  const auto noise = [&](const char* key, double now, double before, const Unit& unit) {
    if (now != before) at(filter, key) = quantity_node(now, unit);
  };
  noise("angle_random_walk", patched.noise.angle_random_walk, nominal.noise.angle_random_walk,
        unit::deg_per_sqrt_h);
  noise("drift_random_walk", patched.noise.drift_random_walk, nominal.noise.drift_random_walk,
        unit::deg_per_h_per_sqrt_h);
  return config::to_document(root);
}

std::string study_with_field(const mc::Study& study, const Vec3& field_l) {
  constexpr CovariateSpec field = covariate("field");
  Node root = parsed(study);
  Node& environment = at(root, "environment");
  for (std::size_t k = 0; k < field.components(); ++k)
    at(environment, std::string(field.column(k).view())) =
        text_node(fmt::format("{:.4f} {}", field_l[static_cast<Eigen::Index>(k)] / field.unit.to_si,
                              field.unit.symbol.view()));
  return config::to_document(root);
}

namespace {

bool has_walk_term(const FilterSpec& filter) {
  return filter.active[TermLibrary::find("q_x").value()] ||
         filter.active[TermLibrary::find("q_y").value()] ||
         filter.active[TermLibrary::find("q_z").value()];
}

RecordingKind kind_of(const Diagnosis& d) {
  return d.of_case ? RecordingKind::strapdown : RecordingKind::platform;
}

void declare_walk(Node& root, const mc::Study& study, const inference::NoiseFinding& walk) {
  const auto of = [&](const FilterSpec& filter) {
    return walk.component == inference::angle_walk.name ? filter.noise.angle_random_walk
                                                        : filter.noise.drift_random_walk;
  };
  first_filter(root, study);  // there is one
  std::vector<Node>& filters = root.find("filter")->items;
  for (std::size_t k = 0; k < filters.size(); ++k)
    if (of(study.filters[k]) == of(study.filters.front()) && !has_walk_term(study.filters[k]))
      at(filters[k], walk.component) =
          text_node(fmt::format("{} {}", number_text(walk.value, noise_digits), walk.unit));
}

}  // namespace

bool can_be_declared(const inference::NoiseFinding& found, RecordingKind kind,
                     const FilterSpec& nominal) {
  const std::string& c = found.component;
  if (!found.significant) return false;
  if (c == inference::drift_walk.name) return !has_walk_term(nominal);
  return kind == RecordingKind::platform &&
         (c == inference::angle_walk.name || c == inference::acc_white.name ||
          c == inference::gimbal_white.name);
}

bool declares_noise(const Diagnosis& d) {
  const RecordingKind kind = kind_of(d);
  return !d.wrong_study() && (d.has_patch || d.verdict == Verdict::consistent) &&
         std::ranges::any_of(d.noise, [&](const inference::NoiseFinding& f) {
           return can_be_declared(f, kind, d.nominal);
         });
}

std::vector<std::string> not_declared(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const inference::NoiseFinding& f : d.noise)
    if (f.significant && f.component != "outliers" && !can_be_declared(f, kind_of(d), d.nominal))
      all.push_back(std::isfinite(f.factor)
                        ? fmt::format("{} ({} times)", f.component, number_text(f.factor, 2))
                        : fmt::format("{} {} {}", f.component, number_text(f.value, 2), f.unit));
  return all;
}

std::string study_with_noise(const mc::Study& study,
                             const std::vector<inference::NoiseFinding>& found) {
  Node root = parsed(study);
  const auto declare = [&](Node& table, const std::string& key, double si, const Unit& unit) {
    at(table, key) = text_node(
        fmt::format("{} {}", number_text(si / unit.to_si, noise_digits), unit.symbol.view()));
  };
  for (const inference::NoiseFinding& f : found) {
    if (!can_be_declared(f, study.kind, study.filters.front())) continue;
    if (f.component == inference::acc_white.name)
      declare(at(root, "readout"), "accelerometer_noise",
              f.factor * study.readout.accelerometer_noise, unit::ug);
    else if (f.component == inference::gimbal_white.name)
      declare(at(root, "readout"), "gimbal_noise", f.factor * study.readout.gimbal_noise,
              unit::arcsec);
    else
      declare_walk(root, study, f);
  }
  return config::to_document(root);
}

}  // namespace drift::diagnosis
