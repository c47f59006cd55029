#include "core/physics/parameters_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/nearest.hpp"

namespace drift {
namespace {

using config::Option;
constexpr auto& known = TermLibrary::specs;

/// Far outside the default prior a value is a slip of the unit; misalignments are small angles;
/// time constants, moments and sizes of random things are positive.
Option plausible(std::size_t param) {
  const ParamSpec& spec = known[param];
  // Of a setting that a study brings itself nobody knows what is plausible.
  if (param >= TermLibrary::num_known_params && spec.setting())
    return {.key = spec.key.view(), .unit = spec.unit, .doc = spec.enters};
  constexpr double sigmas = 1e4;
  constexpr double small_angle = 10.0 * detail::deg;
  double limit = sigmas * std::max(std::abs(spec.prior.a), std::abs(spec.prior.b));
  if (spec.unit.same_dimension(unit::rad)) limit = std::min(limit, small_angle / spec.unit.to_si);
  double least = -limit;
  if (spec.kind == ParamKind::noise || spec.kind == ParamKind::moment) least = 0.0;
  if (spec.kind == ParamKind::nonlinear)
    least = 1e-3 * *std::min_element(spec.grid.begin(), spec.grid.end());
  if (spec.kind == ParamKind::discrete) {
    least = 1.0;
    limit = 1e4;
  }
  return {spec.key.view(), spec.unit, least, limit, spec.enters};
}

std::size_t first_of(const ParamMask& mask) {
  std::size_t i = 0;
  while (!mask[i]) ++i;
  return i;
}

/// The axes or gimbals that parameters of a term belong to: "x", "middle".
std::vector<std::string_view> axes_of(const TermInfo& term) {
  std::vector<std::string_view> axes;
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (!known[i].axis.empty() && std::ranges::find(axes, known[i].axis) == axes.end())
      axes.push_back(known[i].axis);
  return axes;
}

/// The parameters of a term, or of one axis of it if one is named.
ParamMask term_mask(const TermInfo& term, std::string_view axis) {
  ParamMask mask;
  for (std::size_t i = term.first; i < term.first + term.count; ++i)
    if (axis.empty() || known[i].axis == axis) mask.set(i);
  return TermLibrary::completed(mask);
}

ParamMask parameters_in(std::string_view key) {  // one, or a group
  ParamMask mask;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i].key.view() == key || known[i].group.view() == key) mask.set(i);
  return mask;
}

void read_entry(config::Section& section, const config::Node& entry, ParamMask& mask) {
  const auto wrong = [&](const std::string& what, const std::string& fix) {
    section.report().error(
        entry.at,
        fmt::format("'{}' {} (expected terms such as \"g_drift\", \"g_drift.x\", \"D_I\" or "
                    "\"D_I_z\"). {}",
                    section.full("terms"), what, fix));
  };
  if (!entry.is(config::Node::Kind::string))
    return wrong("contains " + describe(entry), "Put the key of a term in quotes");
  const ParamMask named = params_named(entry.text);
  if (named.none()) {
    auto keys = term_keys();
    for (const auto key : parameter_keys()) keys.push_back(key);
    const auto dot = entry.text.find('.');
    return wrong(
        fmt::format("contains the unknown term '{}'", entry.text),
        config::suggestion(entry.text.substr(0, dot), keys, "`driftscope terms` lists them"));
  }
  if ((named & ~mask).none())
    return wrong(fmt::format("names '{}', which the entries before it hold already", entry.text),
                 "Remove one of them");
  mask |= TermLibrary::completed(named);
}

void read_value(config::Section& table, std::string_view key, const config::Node& node,
                const ParamMask& which, ModelSpec& spec, ParamMask& done) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!which[i] || done[i]) continue;
    const auto prior = read_prior(table.report(), node, table.full(key), plausible(i));
    if (!prior) return;  // a group has one mistake, not three
    spec.priors[i] = prior->scaled(known[i].unit.to_si);
    done.set(i);
    table.report().given(table.full(known[i].key.view()), config::prior_text(*prior, known[i].unit),
                         node.at);
  }
}

}  // namespace

ParamMask params_named(std::string_view key) {
  ParamMask mask = parameters_in(key);
  const auto dot = key.find('.');
  const auto term = TermLibrary::find_term(key.substr(0, dot));
  if (!term) return mask;
  if (dot == std::string_view::npos) return mask | term_mask(TermLibrary::terms[*term], {});
  const auto axes = axes_of(TermLibrary::terms[*term]);
  if (const auto axis = key.substr(dot + 1); std::ranges::find(axes, axis) != axes.end())
    mask |= term_mask(TermLibrary::terms[*term], axis);
  return mask;
}

std::vector<std::string_view> term_keys() {
  std::vector<std::string_view> keys;
  for (const auto& term : TermLibrary::terms) keys.push_back(term.key);
  return keys;
}

std::string term_keys(const TermMask& terms) {
  std::vector<std::string_view> keys;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t)
    if (terms[t]) keys.push_back(TermLibrary::terms[t].key);
  return fmt::format("{}", fmt::join(keys, ", "));
}

std::vector<std::string_view> parameter_keys() {
  std::vector<std::string_view> keys;
  for (const auto& spec : known) keys.push_back(spec.key.view());
  for (const auto& spec : known)
    if (std::find(keys.begin(), keys.end(), spec.group.view()) == keys.end())
      keys.push_back(spec.group.view());
  return keys;
}

ParamMask base_parameters() {
  ParamMask mask;
  for (std::size_t i = 0; i < known.size(); ++i) mask[i] = is_base(TermLibrary::owner(i));
  return mask;
}

std::vector<std::string> terms_text(const ParamMask& mask) {
  std::vector<std::string> entries;
  ParamMask left = mask;
  const auto use = [&](const std::string& key) {
    const ParamMask named = params_named(key);
    // What belongs to no axis may have been named by an axis before.
    if ((named & left).none() || (named & ~mask).any() ||
        (TermLibrary::completed(left) & named) != named)
      return;
    entries.push_back(key);
    left &= ~TermLibrary::completed(named);
  };
  for (const auto key : term_keys()) use(std::string(key));
  for (const auto key : term_keys())
    for (const std::string_view axis : axes_of(TermLibrary::terms[*TermLibrary::find_term(key)]))
      use(fmt::format("{}.{}", key, axis));
  for (const auto& spec : known) use(std::string(spec.group.view()));
  for (const auto& spec : known) use(std::string(spec.key.view()));
  return entries;
}

ParamMask read_terms(config::Section& section, Coupling coupling) {
  const std::string key = section.full("terms");
  const std::size_t errors = section.report().errors();
  const config::Node* node = section.take("terms");
  ParamMask mask;
  if (node == nullptr) {
    mask = base_parameters();
  } else if (!node->is(config::Node::Kind::array)) {
    section.report().error(
        node->at, fmt::format("'{}' is {} (expected a list of terms). Write [\"fixed_drift\", "
                              "\"g_drift\"]",
                              key, describe(*node)));
  } else {
    for (const auto& entry : node->items) read_entry(section, entry, mask);
    if (mask[closure_param] && coupling != Coupling::lambda)
      section.report().error(
          node->at,
          fmt::format("'{}' holds {}, the weight between eq. (5) and eq. (6), but "
                      "the coupling fixes the equation (expected coupling = \"lambda\"). Set "
                      "coupling = \"lambda\", or remove the term",
                      key, closure_term));
  }
  if (coupling == Coupling::lambda) mask.set(closure_param);
  const std::string text = fmt::format("{}", fmt::join(terms_text(mask), ", "));
  if (node == nullptr)
    section.report().assumed(key, text);
  else
    section.report().given(key, text, node->at);
  // A misspelt term shall not make its parameters mistakes too.
  return section.report().errors() == errors ? mask : ParamMask().set();
}

void read_parameters(config::Section& section, ModelSpec& spec) {
  for (std::size_t i = 0; i < known.size(); ++i) spec.priors[i] = known[i].prior_si();
  const config::Node* node = section.take("parameters");
  config::Section table(section.report(), node, node == nullptr ? section.at() : node->at,
                        section.full("parameters"));
  ParamMask done;
  std::vector<std::pair<std::string_view, ParamMask>> named;
  const auto members = node != nullptr ? node->members : std::vector<config::Member>{};
  for (const auto& member : members) {
    const ParamMask all = parameters_in(member.key);
    if (all.none()) {
      section.report().error(
          member.at,
          fmt::format(
              "unknown parameter '{}' (expected a key such as eta_x, or a group such "
              "as eta for all axes). {}",
              table.full(member.key),
              config::suggestion(member.key, parameter_keys(), "`driftscope terms` lists them")));
      continue;
    }
    if ((all & spec.active).none()) {
      const auto& term = TermLibrary::owner(first_of(all));
      section.report().error(
          member.at,
          fmt::format(
              "'{}' belongs to term '{}', which is not part of this model (expected {}). {}",
              table.full(member.key), term.key,
              spec.active.none()
                  ? "none: terms is empty"
                  : fmt::format("parameters of {}", fmt::join(terms_text(spec.active), ", ")),
              term.key == closure_term
                  ? std::string("Set coupling = \"lambda\", or remove the parameter")
                  : fmt::format("Add \"{}\" to terms, or remove the parameter", term.key)));
      continue;
    }
    named.emplace_back(member.key, all & spec.active);
  }
  // A parameter's own key goes before its group's.
  std::stable_partition(named.begin(), named.end(),
                        [](const auto& n) { return TermLibrary::find(n.first).has_value(); });
  for (const auto& [key, which] : named)
    read_value(table, key, *node->find(key), which, spec, done);
  for (std::size_t i = 0; i < known.size(); ++i)
    if (spec.active[i] && !done[i])
      section.report().assumed(table.full(known[i].key.view()),
                               config::prior_text(known[i].prior, known[i].unit), "default prior");
}

std::optional<double> read_parameter(config::Section& table, std::string_view key,
                                     std::size_t index) {
  const config::Node* node = table.take(key);
  if (node == nullptr) return std::nullopt;
  const auto q = read_quantity(table.report(), *node, table.full(key), plausible(index));
  if (!q) return std::nullopt;
  table.report().given(table.full(known[index].key.view()),
                       config::quantity_text(q->in(known[index].unit), known[index].unit),
                       node->at);
  return q->si();
}

}  // namespace drift
