#include "core/plan/plan_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/config/nearest.hpp"
#include "core/plan/attitude/axis_turn_config.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/readout_config.hpp"

namespace drift {
namespace {

using config::Option;
using config::Section;

constexpr Named<RecordingKind> kinds[] = {{"platform", RecordingKind::platform},
                                          {"strapdown", RecordingKind::strapdown}};
constexpr Option dwell_option{"dwell", unit::minute, 1e-3, 1e5, "length of a dwell"};
constexpr Option sample_option{"sample", unit::s, 1e-3, 1e5, "sample interval"};

constexpr double most_samples = 1e7;  ///< of a dwell: beyond memory

/// The dwell of so many samples, or of the nearest number of them that a dwell may have: "99960
/// min".
std::string dwell_near(double count, double sample) {
  constexpr double rounding = 1e-9;  // of a number of samples
  const auto samples = [&](double dwell) { return dwell * dwell_option.unit.to_si / sample; };
  const double least = std::max(1.0, std::ceil(samples(dwell_option.min) * (1.0 - rounding))),
               most = std::floor(samples(dwell_option.max) * (1.0 + rounding)),
               dwell = sample * std::clamp(count, least, std::min(most, most_samples)),
               minutes = std::round(dwell / unit::minute.to_si);
  return std::abs(dwell - minutes * unit::minute.to_si) <= rounding * dwell
             ? fmt::format("{:.12g} min", minutes)
             : fmt::format("{:.12g} s", dwell);
}

/// A dwell is a whole number of sample intervals, at least one and not beyond memory.
void check_samples(Section& section, double dwell, double sample) {
  const config::Node* node = section.has("dwell") ? section.take("dwell") : section.take("sample");
  const config::Place at = node == nullptr ? section.at() : node->at;
  const double count = std::round(dwell / sample);
  if (!(std::abs(dwell / sample - count) <= 1e-9 * count && count >= 1.0))
    section.report().error(
        at,
        fmt::format(
            "'{}' = {:.12g} s is {:.6g} samples of {:.12g} s (expected a whole number, at least "
            "one). Choose a dwell such as \"{}\"",
            section.full("dwell"), dwell, dwell / sample, sample, dwell_near(count, sample)));
  else if (!(count <= most_samples))
    section.report().error(
        at, fmt::format("'{}' = {:.12g} s is {:.0f} samples of {:.12g} s (expected at most "
                        "{:.0f}). Choose a longer sample interval",
                        section.full("dwell"), dwell, count, sample, most_samples));
}

/// Where a dwell is held against its samples: what [plan] has by default may be nobody's, and what
/// a position takes over from it is said once.
enum class Checked { here, elsewhere };

void read_dwell(Section& section, double& dwell, double& sample, Checked where = Checked::here) {
  const std::size_t errors = section.report().errors();
  section.read(dwell_option, dwell);
  section.read(sample_option, sample);
  if (section.report().errors() == errors && where == Checked::here)
    check_samples(section, dwell, sample);
}

/// `inherited`: where the dwell of `defaults` is held against its samples.
Position read_position(Section section, std::size_t number, const PlanDefaults& defaults,
                       Checked inherited) {
  Position p;
  section.defaults_come_from("as [plan]");
  p.name = fmt::format("position {}", number);
  p.dwell = defaults.dwell;
  p.sample = defaults.sample;
  p.mode = defaults.mode.value_or(CommandLaw::free);
  p.entry = number == 1 ? Entry::caged : defaults.entry.value_or(Entry::caged);
  section.read(Option{.key = "name", .doc = "of the position"}, p.name);
  section.require("axes", "axes = \"x=N y=W z=U\"");
  std::string why;
  if (section.read(Option{.key = "axes", .doc = "local direction of each axis"}, p.axes)) {
    if (const auto R_lp = parse_axes(p.axes, why))
      p.R_lp = *R_lp;
    else
      section.report().error(
          section.take("axes")->at,
          fmt::format("'{}' = \"{}\": {} (expected a right-handed frame such as \"x=N "
                      "y=W z=U\"). Correct the directions N S E W U D",
                      section.full("axes"), p.axes, why));
  }
  p.turns = read_turns(section);
  p.R_lp = p.R_lp * rotation_of(p.turns);
  const bool own = section.has("dwell") || section.has("sample");
  read_dwell(section, p.dwell, p.sample, own ? Checked::here : inherited);
  section.read(Option{.key = "mode", .doc = "command law"}, p.mode, command_laws);
  if (section.read(Option{.key = "entry", .doc = "how it is entered"}, p.entry, ways_of_entry) &&
      number == 1 && p.entry == Entry::torqued)
    section.report().error(
        section.take("entry")->at,
        fmt::format("'{}' = \"torqued\" in the first position, which has none before it "
                    "to slew from (expected \"caged\"). Cage the first position",
                    section.full("entry")));
  section.read(Option{"case_heading", unit::deg, -most_case_heading_deg, most_case_heading_deg,
                      "of the case about Up"},
               p.case_heading);
  section.finish();
  return p;
}

void read_positions(Section& section, const PlanDefaults& defaults, Checked inherited,
                    PlanConfig& config) {
  constexpr std::size_t most = 10000;
  const config::Node* node = section.take("position");
  auto list = section.sections("position");
  if (node->is(config::Node::Kind::array) && (list.empty() || list.size() > most))
    section.report().error(node->at,
                           fmt::format("'{}' lists {} positions (expected 1 to {}). List the "
                                       "positions, or name a preset",
                                       section.full("position"), list.size(), most));
  std::vector<std::string> names;
  for (auto& position : list) {
    config.plan.positions.push_back(read_position(position, names.size() + 1, defaults, inherited));
    config.places.push_back(position.at());
    const auto& name = config.plan.positions.back().name;
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end())
      section.report().error(
          position.at(), fmt::format("the position name '{}' is {} (expected a name of its own for "
                                     "each position). Rename one",
                                     name, name.empty() ? "empty" : "used twice"));
    names.push_back(name);
  }
}

void read_preset(Section& section, const PlanDefaults& defaults, TestPlan& plan) {
  std::string name;
  if (!section.read(Option{.key = "preset", .doc = "a known plan"}, name)) return;
  if (auto preset = preset_plan(name, defaults)) {
    plan.preset = name;
    plan.positions = std::move(preset->positions);
    return;
  }
  section.report().error(
      section.take("preset")->at,
      fmt::format("'{}' = \"{}\" is no preset (expected one of \"{}\"). {}", section.full("preset"),
                  name, fmt::join(preset_names, "\", \""), config::suggestion(name, preset_names)));
}

template <class E, std::size_t N>
std::optional<E> read_optional(Section& section, std::string_view key,
                               const Named<E> (&choices)[N]) {
  E value{};
  std::vector<std::string_view> names;
  for (const Named<E>& choice : choices) names.push_back(choice.name);
  section.choices(key, names);
  if (!section.has(key)) return std::nullopt;
  if (!section.read(Option{.key = key}, value, choices)) return std::nullopt;
  return value;
}

void read_platform(Section& section, PlanConfig& config) {
  TestPlan& plan = config.plan;
  PlanDefaults defaults;
  const bool by_default = !section.has("dwell") && section.has("position");
  read_dwell(section, defaults.dwell, defaults.sample,
             by_default ? Checked::elsewhere : Checked::here);
  defaults.mode = read_optional(section, "mode", command_laws);
  defaults.entry = read_optional(section, "entry", ways_of_entry);
  section.read(Option{"slew_rate", unit::deg_per_s, 1e-4, 360.0, "of a torqued entry"},
               plan.slew_rate);
  section.read(Option{"case_rate", unit::deg_per_s, 1e-4, 360.0, "of the turntable"},
               plan.case_rate);
  const config::Node* position = section.take("position", Section::Kind::sections,
                                              config::expected_sections(section.full("position")));
  section.choices("preset", preset_names);
  const config::Node* preset = section.take("preset");
  if (position != nullptr && preset != nullptr)
    section.report().error(
        preset->at, fmt::format("'{}' is given together with [[plan.position]] (expected one of "
                                "them). Remove one",
                                section.full("preset")));
  if (position == nullptr && preset == nullptr)
    section.report().error(
        section.at(),
        fmt::format("[plan] has no positions (expected preset = \"six\" or another of {}, or "
                    "[[plan.position]] one by one). Add preset = \"six\"",
                    fmt::join(preset_names, ", ")));
  if (preset != nullptr) {
    read_preset(section, defaults, plan);
    config.places = {preset->at};
  }
  if (position != nullptr) {
    plan.positions.clear();
    read_positions(section, defaults, by_default ? Checked::here : Checked::elsewhere, config);
  }
}

/// Keys that have a meaning for the other kind of test alone.
void refuse_keys(Section& section, std::initializer_list<std::string_view> keys,
                 std::string_view kind) {
  for (const auto key : keys) {
    if (!section.has(key)) continue;
    section.report().error(
        section.take(key)->at,
        fmt::format("'{}' means nothing for this kind of test (expected with {} only). "
                    "Remove it, or set {}",
                    section.full(key), kind, kind));
  }
}

}  // namespace

PlanConfig read_plan(Section section) {
  PlanConfig config;
  if (!section.present()) {
    section.report().error(section.at(),
                           "section [plan] is missing (expected a test plan). Add [plan] "
                           "with preset = \"six\"");
    return config;
  }
  const std::size_t errors = section.report().errors();
  section.read(Option{.key = "kind", .doc = "of the test"}, config.kind, kinds);
  if (section.report().errors() != errors) return config;  // what is missing depends on it
  if (config.kind == RecordingKind::platform) {
    read_platform(section, config);
    refuse_keys(section, {"static_min", "accelerometers_in_turns"}, "kind = \"strapdown\"");
  } else {
    section.read(
        Option{"static_min", unit::s, 1e-2, 1e5, "shortest time for which a dwell is quiet"},
        config.static_min);
    section.read(Option{.key = "accelerometers_in_turns",
                        .doc = "what they read in turns counts, too: a turntable moves no origin"},
                 config.accelerometers_in_turns);
    refuse_keys(
        section,
        {"preset", "position", "dwell", "sample", "mode", "entry", "slew_rate", "case_rate"},
        "kind = \"platform\"");
  }
  section.finish();
  return config;
}

void check_headings(const PlanConfig& config, const Site& site, config::Report& report) {
  if (config.kind != RecordingKind::platform || config.places.empty()) return;
  try {
    plan_passages(config.plan, site);
  } catch (const GimbalLock& lock) {
    report.error(config.places[std::min(lock.position, config.places.size() - 1)], lock.text);
  }
}

Site read_site(Section section, RecordingKind kind) {
  Site site;
  std::string note;
  if (kind == RecordingKind::platform) section.require("latitude", "latitude = \"45.75 deg\"");
  section.read_options(site);
  if (section.has("note"))
    section.read(Option{.key = "note", .doc = "any text"}, note);
  else
    section.take("note", Section::Kind::text, config::expected_text());
  section.finish();
  return site;
}

Readout read_readout(Section section) {
  Readout readout;
  section.read_options(readout);
  if (!readout.accelerometers && !readout.gimbals)
    section.report().error(section.at(),
                           "neither accelerometers nor gimbals are read (expected at least one "
                           "kind of measurement). Set accelerometers = true or gimbals = true "
                           "in [readout]");
  section.finish();
  return readout;
}

}  // namespace drift
