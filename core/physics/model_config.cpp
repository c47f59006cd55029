#include "core/physics/model_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/nearest.hpp"
#include "core/physics/coupling_names.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/physics/servo_config.hpp"

namespace drift {
namespace {

using config::Option;
using config::Section;

constexpr Named<LoopEstimate> loop_estimates[] = {{"given", LoopEstimate::given},
                                                  {"feedback", LoopEstimate::feedback}};

/// [deg/h/sqrt(h)] A gyro that walks by the 20 deg/s of a micromechanical one in an hour.
constexpr double most_walk = 1e5;

/// names: of the choices, for people.
template <class Row, std::size_t N>
void read_coupling(Section& section, Coupling& coupling, const Row (&choices)[N],
                   const std::string& names) {
  section.require("coupling", fmt::format("coupling = {}: no equation is the default", names));
  // Where the coupling is wrong, lambda allows whatever the terms and parameters ask for.
  coupling = Coupling::lambda;
  section.read(Option{.key = "coupling", .doc = "the drift equation"}, coupling, choices);
}

/// One that a truth alone can have is refused with the reason.
void read_coupling_of_filter(Section& section, FilterSpec& spec) {
  const std::string names = names_of_couplings(is_algebraic);
  const config::Node* given = section.take("coupling");
  const bool word = given != nullptr && given->is(config::Node::Kind::string);
  const auto of_truths = word ? value_in(couplings, given->text) : std::nullopt;
  if (!of_truths || is_algebraic(*of_truths)) {
    read_coupling(section, spec.coupling, couplings_of_filters, names);
    return;
  }
  spec.coupling = Coupling::lambda;
  section.report().error(
      given->at,
      fmt::format("'{}' = \"{}\" cannot be estimated with: the loop settles within a sample and "
                  "its states are not observable (expected {}). Choose the equation the loop "
                  "settles to, \"eq5\" or \"eq6\"",
                  section.full("coupling"), given->text, names));
}

/// Terms, parameters and noise: what truth and filters have in common. Their coupling is read.
void read_model(Section& section, ModelSpec& spec) {
  spec.active = read_terms(section, spec.coupling);
  read_parameters(section, spec);
  section.read(Option{"initial_attitude", unit::arcsec, 0.0, 36000.0, "1 sigma per axis at caging"},
               spec.initial_attitude);
  section.read(Option{"angle_random_walk", unit::deg_per_sqrt_h, 0.0, 100.0, "of each gyro"},
               spec.noise.angle_random_walk);
  section.read(
      Option{"drift_random_walk", unit::deg_per_h_per_sqrt_h, 0.0, most_walk, "of each D_F"},
      spec.noise.drift_random_walk);
}

void refuse_unused(Section& section, std::string_view table, std::string_view coupling) {
  section.report().error(
      section.at(), fmt::format("'truth.{}' is not used by this coupling (expected with coupling = "
                                "\"{}\" only). Remove the table, or set that coupling",
                                table, coupling));
}

/// The misalignments the compensating loop believes in; those not named are zero.
void read_loop(Section loop, TruthSpec& spec) {
  loop.read(Option{.key = "estimate", .doc = "where the loop's estimate comes from"}, spec.loop,
            loop_estimates);
  const ParamMask angles = params_named("gyro_misalignment");
  for (const std::string_view group : {"eta", "xi"}) {
    const ParamMask members = params_named(group);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      if (!members[i]) continue;
      const std::string_view own = TermLibrary::specs[i].key;
      const std::string_view key = loop.has(own) ? own : group;
      loop.take(own);
      const config::Node* node = loop.take(key);
      if (node == nullptr) continue;
      if (spec.loop == LoopEstimate::feedback)
        loop.report().error(node->at,
                            fmt::format("'{}' is given, but the loop uses the running estimate "
                                        "of the filter (expected with estimate = \"given\" "
                                        "only). Remove one of them",
                                        loop.full(key)));
      if (const auto value = read_parameter(loop, key, i))
        spec.theta_loop[static_cast<long>(i)] = *value;
      else if (key == group)
        break;  // one mistake, not three
    }
  }
  loop.finish();
}

/// One explicit start: parameter keys and plain values, of parameters that the filter estimates.
Start read_start(Section table, const config::Node& node, const FilterSpec& spec) {
  Start start;
  for (const auto& member : node.members) {
    const auto wrong = [&](std::string_view what, const std::string& fix) {
      table.report().error(member.at, fmt::format("'{}' {} (expected parameters that the filter "
                                                  "estimates). {}",
                                                  table.full(member.key), what, fix));
    };
    const auto own = TermLibrary::find(member.key);
    const ParamMask named = own ? ParamMask().set(*own) : params_named(member.key);
    table.take(member.key);
    if (named.none() || TermLibrary::find_term(member.key)) {
      wrong("is no parameter",
            config::suggestion(member.key, parameter_keys(), "`driftscope terms` lists them"));
      continue;
    }
    ParamMask states = named & spec.active;
    for (std::size_t i = 0; i < states.size(); ++i)
      if (spec.priors[i].kind == Prior::Kind::fixed) states.reset(i);
    if (states.none()) {
      wrong("is not estimated by this filter",
            "Add its term to terms, or remove it from the start");
      continue;
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (!states[i] || (!own && table.has(TermLibrary::specs[i].key.view()))) continue;
      const auto value = read_parameter(table, member.key, i);
      if (!value) break;
      start.emplace_back(i, *value);
    }
  }
  return start;
}

void read_starts(Section& section, FilterSpec& spec) {
  constexpr int most = 1000;
  const config::Node* node = section.take("starts");
  if (node == nullptr || !node->is(config::Node::Kind::array)) {
    section.read(Option{"starts", unit::one, 1, most, "number of starts"}, spec.drawn_starts);
    return;
  }
  if (node->items.empty() || node->items.size() > most)
    section.report().error(node->at,
                           fmt::format("'{}' lists {} starts (expected 1 to {}). List at least "
                                       "one, or give a number",
                                       section.full("starts"), node->items.size(), most));
  for (const auto& item : node->items) {
    const auto path = section.full(fmt::format("starts.{}", spec.starts.size()));
    spec.starts.push_back(read_start(Section(section.report(), &item, item.at, path), item, spec));
  }
  spec.drawn_starts = static_cast<int>(spec.starts.size());
}

FilterSpec read_filter(Section section, std::size_t number, const Mounting& mounting) {
  FilterSpec spec;
  spec.mounting = mounting;
  spec.name = fmt::format("filter {}", number);
  section.read(Option{.key = "name", .doc = "of the filter"}, spec.name);
  read_coupling_of_filter(section, spec);
  read_model(section, spec);
  read_starts(section, spec);
  section.finish();
  return spec;
}

}  // namespace

TruthSpec read_truth(Section section, const Mounting& mounting, UnusedTables unused) {
  TruthSpec spec;
  spec.mounting = mounting;
  if (!section.present()) return spec;
  const std::size_t errors = section.report().errors();
  read_coupling(section, spec.coupling, couplings, names_of_couplings());
  read_model(section, spec);
  const bool right = section.report().errors() == errors && unused == UnusedTables::refused;
  Section servo = section.section("servo");
  if (servo.present()) {
    servo.read_options(spec.servo);
    servo.finish();
    if (right && spec.coupling != Coupling::servo) refuse_unused(servo, "servo", "servo");
  } else if (spec.coupling == Coupling::servo) {
    servo.read_options(spec.servo);
  }
  Section loop = section.section("loop");
  if (loop.present()) {
    if (right && spec.coupling != Coupling::compensated) refuse_unused(loop, "loop", "compensated");
    read_loop(loop, spec);
  } else if (spec.coupling == Coupling::compensated) {
    read_loop(loop, spec);
  }
  section.finish();
  return spec;
}

std::vector<FilterSpec> read_filters(Section& root, const Mounting& mounting) {
  std::vector<FilterSpec> filters;
  std::vector<Section> sections = root.sections("filter");
  for (auto& section : sections) {
    filters.push_back(read_filter(section, filters.size() + 1, mounting));
    const FilterSpec& filter = filters.back();
    bool estimates = false;
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      estimates = estimates || (filter.active[i] && filter.priors[i].sigma() > 0.0);
    if (!estimates)
      root.report().error(
          section.at(),
          fmt::format("the filter '{}' estimates nothing (expected at least one parameter "
                      "that is not a known constant). Add terms, or leave `terms` out for "
                      "the six base terms",
                      filter.name));
    const auto& name = filter.name;
    const bool again = std::any_of(filters.begin(), filters.end() - 1,
                                   [&](const FilterSpec& f) { return f.name == name; });
    if (name.empty() || again)
      root.report().error(section.at(),
                          fmt::format("the filter name '{}' is {} (expected a name of its "
                                      "own for each filter). Rename one",
                                      name, again ? "used twice" : "empty"));
  }
  return filters;
}

}  // namespace drift
