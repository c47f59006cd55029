#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/config/nearest.hpp"
#include "core/config/override.hpp"
#include "core/estimate/layout.hpp"
#include "core/physics/model_config.hpp"
#include "core/physics/mounting_config.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/own/own_terms_config.hpp"
#include "core/plan/environment_config.hpp"
#include "core/plan/plan_config.hpp"
#include "core/recording/own/format_config.hpp"
#include "mc/study/blind_config.hpp"
#include "mc/study/declared_keys.hpp"
#include "mc/study/idle_axes.hpp"
#include "mc/study/published_config.hpp"
#include "mc/study/servo_check.hpp"
#include "mc/study/study.hpp"
#include "mc/study/sweep_config.hpp"

namespace drift::mc {
namespace {

using config::Node;
using config::Option;
using config::Report;
using config::Section;

void read_schema(Section& root) {
  constexpr std::uint64_t schema = 1;
  if (!root.require("schema", "schema = 1")) {
    root.take("schema");
    return;
  }
  std::uint64_t given = schema;
  if (root.read(Option{"schema", unit::one, 0.0, 1e9, "of the file"}, given) && given != schema)
    root.report().error(
        root.take("schema")->at,
        fmt::format("'schema' = {} is not known to this program (expected {}). Use a newer "
                    "program, or write the file in schema {}",
                    given, schema, schema));
}

/// A stop rule must be able to end: what it waits for is estimated, and its interval means
/// something.
void check_stop(Report& report, const Node& root, const Study& study) {
  if (!study.monte_carlo.stop) return;
  const Node& section = *root.find("monte_carlo");
  const auto& stop = *section.find("stop");
  if (study.monte_carlo.design != DesignKind::random)
    report.error(section.find("design")->at,
                 "'monte_carlo.design' does not go with [monte_carlo.stop] (expected \"random\": "
                 "the interval that a stop rule "
                 "waits for supposes independent runs, and the first runs of a spread-out design "
                 "are not spread out). Remove one "
                 "of the two");
  constexpr std::string_view rmse = "rmse.";
  const std::string& quantity = study.monte_carlo.stop->quantity;
  const Node* given = stop.find("quantity");
  if (given == nullptr || !quantity.starts_with(rmse) ||
      !TermLibrary::find(quantity.substr(rmse.size())))
    return;
  std::vector<std::string_view> estimated;
  for (const FilterSpec& filter : study.filters)
    for (const std::size_t i : make_layout(filter).params)
      if (const auto key = TermLibrary::specs[i].key.view();
          std::ranges::find(estimated, key) == estimated.end())
        estimated.push_back(key);
  if (std::ranges::find(estimated, std::string_view(quantity).substr(rmse.size())) ==
      estimated.end())
    report.error(
        given->at,
        fmt::format(
            "'monte_carlo.stop.quantity' = \"{}\" waits for a parameter that no filter estimates "
            "(expected \"rmse.\" and one of {}). {}",
            quantity, fmt::join(estimated, ", "),
            config::suggestion(std::string_view(quantity).substr(rmse.size()), estimated,
                               "Choose one of them, or add its term to a filter")));
}

constexpr std::string_view swept_of_monte_carlo[] = {"monte_carlo.design", "monte_carlo.estimator"};

/// The number of runs, the seed and the like are the study's: points share their runs. So are its
/// own terms, of which the library holds one set; their settings are parameters of [truth] too.
bool can_be_swept(std::string_view key) {
  if (key.starts_with("monte_carlo"))
    return std::ranges::find(swept_of_monte_carlo, key) != std::end(swept_of_monte_carlo);
  return !key.starts_with("sweep") && !key.starts_with("schema") && !key.starts_with("term");
}

/// Whether a sweep changes what decides the attitudes of the plan.
bool sweeps_the_plan(const std::vector<SweepAxis>& sweep) {
  return std::ranges::any_of(sweep, [](const SweepAxis& axis) {
    return axis.key.starts_with("plan") || axis.key.starts_with("site");
  });
}

/// Whether a sweep changes what decides how the loop of [truth] settles.
bool sweeps_the_loop(const std::vector<SweepAxis>& sweep) {
  return std::ranges::any_of(sweep,
                             [](const SweepAxis& axis) { return axis.key.starts_with("truth"); });
}

/// Every value of the sweep is tried in its place, so that no point of a study fails for its file.
void try_sweep(const Node& root, const Study& study) {
  constexpr std::size_t most_messages = 20;
  std::vector<std::string> messages;
  const Node& sweep = study.sweep.empty() ? root : *root.find("sweep");
  for (const auto& axis : study.sweep) {
    const Node& values = *sweep.find(axis.key);
    std::vector<std::string> told;  // what is wrong with the key is wrong with each of its values
    for (std::size_t i = 0; i < axis.values.size() && messages.size() < most_messages; ++i) {
      const auto& at = values.items[i].at;
      const std::string where = at.set_key.empty()
                                    ? fmt::format("{}:{}:{}", study.path, at.line, at.column)
                                    : fmt::format("--set {}", at.set_key);
      try {
        if (!can_be_swept(axis.key))
          throw InputError(
              ExitCode::config,
              fmt::format("'{}' cannot be swept: all study points have it in common (expected a "
                          "key of what is simulated or estimated, {}). Remove the line",
                          axis.key, fmt::join(swept_of_monte_carlo, ", ")));
        Node point = root;
        apply_sweep_value(point, axis.key, axis.values[i]);
        read_study_tree(point, study.path);
      } catch (const InputError& error) {
        const std::string own = fmt::format("--set {}: ", axis.key);
        for (const auto& message : error.messages()) {
          const std::string what = message.starts_with(own) ? message.substr(own.size()) : message;
          if (std::ranges::find(told, what) != told.end()) continue;
          told.push_back(what);
          messages.push_back(fmt::format("{}: with this value of the sweep: {}", where, what));
        }
      }
    }
  }
  if (!messages.empty()) throw InputError(ExitCode::config, messages);
}

Node tree_of(std::string_view text, const std::string& path, const Overrides& overrides) {
  Node root = config::parse_document(text, path);
  std::vector<std::string> messages;
  for (const auto& [key, value] : overrides) {
    try {
      if (key.ends_with('+'))
        config::apply_addition(root, key.substr(0, key.size() - 1), value);
      else
        config::apply_override(root, key, value);
    } catch (const InputError& error) {
      messages.insert(messages.end(), error.messages().begin(), error.messages().end());
    }
  }
  if (!messages.empty()) throw InputError(ExitCode::config, messages);
  return root;
}

/// Puts the study's own terms into the library, for the sections that name them.
void read_terms_into_library(Section& top, RecordingKind kind) {
  OwnTermSet own = read_own_terms(top);
  if (kind == RecordingKind::strapdown && !own.terms.empty())
    top.report().error(top.take("term")->at,
                       "[[term]] in a study of a strapdown recording (expected in a study of a "
                       "platform: its effects are added to the platform's drift equation and "
                       "readout). Remove it");
  set_own_terms(std::move(own));
}

/// Reads a tree; what is wrong with it is in the report.
Study read_tree(const Node& root, const std::string& path, Report& report) {
  Study study;
  study.path = path;
  Section top(report, &root, config::Place{}, "");
  read_schema(top);
  top.read(Option{.key = "title", .doc = "of the study"}, study.title);
  const Mounting mounting = read_mounting(top.section("mounting"));
  const PlanConfig plan = read_plan(top.section("plan"));
  study.kind = plan.kind;
  study.plan = plan.plan;
  study.static_min = plan.static_min;
  study.accelerometers_in_turns = plan.accelerometers_in_turns;
  study.site = read_site(top.section("site"), plan.kind);
  study.readout = read_readout(top.section("readout"));
  std::vector<std::string> positions;
  for (const Position& position : plan.plan.positions) positions.push_back(position.name);
  study.recording = read_recording_format(top.section("recording"), plan.kind, positions);
  study.environment = read_environment(top.section("environment"));
  read_terms_into_library(top, plan.kind);
  study.own_terms = std::make_shared<const OwnTermSet>(own_terms());
  study.recording.of_terms = own_terms().covariates;
  top.take("sweep");
  // A blind study has truths of several couplings too.
  const bool swept = sweeps(root, "truth.coupling") || top.has("blind");
  Section truth = top.section("truth");
  study.has_truth = truth.present();
  study.truth = read_truth(truth, mounting, swept ? UnusedTables::allowed : UnusedTables::refused);
  study.filters = read_filters(top, mounting);
  study.monte_carlo = read_monte_carlo(top.section("monte_carlo"));
  study.sweep = read_sweep(report, root);
  study.published = read_published(top);
  if (Section blind = top.section("blind"); blind.present()) {
    study.blind = read_blind(blind);
    study.has_blind = true;
  }
  top.finish();
  if (report.errors() == 0) check_stop(report, root, study);
  // Of a sweep over the plan the points are read one by one; the file's own may be none of them.
  if (report.errors() == 0 && !sweeps_the_plan(study.sweep))
    check_headings(plan, study.site, report);
  if (report.errors() == 0 && !sweeps_the_loop(study.sweep)) check_servo(root, study, report);
  return study;
}

}  // namespace

Study read_study_tree(const Node& root, const std::string& path) {
  Report report(path);
  KeptOwnTerms kept;
  Study study = read_tree(root, path, report);
  report.throw_if_wrong();
  kept.forget();
  for (const auto& value : report.resolved())
    study.resolved.push_back({value.key, value.text, value.origin});
  return study;
}

std::vector<config::DeclaredKey> declared_keys(const Node& root) {
  Report report("", config::Declared::kept);
  const KeptOwnTerms kept;
  try {
    read_tree(root, "", report);
  } catch (const InputError&) {
    // What came after it is declared in another reading, of a tree that it is content with.
  }
  return report.declared();
}

Study read_study(const std::string& path, const Overrides& overrides, IdleAxes idle) {
  return read_study_text(config::load_text(path), path, overrides, idle);
}

Study read_study_text(std::string_view text, const std::string& path, const Overrides& overrides,
                      IdleAxes idle) {
  const Node root = tree_of(text, path, overrides);
  KeptOwnTerms kept;
  Study study = read_study_tree(root, path);
  study.overrides = overrides;
  try_sweep(root, study);
  if (idle == IdleAxes::refused) refuse_idle_axes(root, study);
  kept.forget();
  study.text = config::to_document(root);
  return study;
}

}  // namespace drift::mc
