#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "core/config/nearest.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/physics/term_library.hpp"
#include "core/sim/surroundings.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {
namespace {

std::string prior_text(const ParamSpec& spec) {
  switch (spec.prior.kind) {
    case Prior::Kind::normal:
      return fmt::format("normal({:g}, {:g})", spec.prior.a, spec.prior.b);
    case Prior::Kind::uniform:
      return fmt::format("uniform({:g}, {:g})", spec.prior.a, spec.prior.b);
    case Prior::Kind::fixed:
      break;
  }
  return fmt::format("known, {:g}", spec.prior.a);
}

/// Which equations a term acts on.
std::string acts_on(const TermInfo& term) {
  std::string where;
  const auto add = [&](bool acts, std::string_view what) {
    if (acts) where += (where.empty() ? "" : ", ") + std::string(what);
  };
  add(term.in_rates, "the platform's rate");
  add(term.in_readout, "the accelerometers");
  add(term.in_gimbals, "the gimbal readout");
  add(term.in_offset, "the attitude, as an offset");
  return where.empty() ? "random numbers: the truth draws them, a filter allows for their variance"
                       : where;
}

/// What a term must be given, beyond attitude and command.
std::string asks_for(const TermInfo& term) {
  std::string what;
  const auto add = [&](std::string_view more) {
    what += (what.empty() ? "" : "; ") + std::string(more);
  };
  for (const CovariateSpec& c : known_covariates)
    if ((term.needs.covariates & c.set()) != 0)
      add(columns_in_words(c) + " of the recording" +
          (c.is_vector() ? " or of [environment]" : ""));
  if (term.needs.turning)
    add("a strapdown unit whose accelerometers are read in turns (plan.accelerometers_in_turns)");
  for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
    if ((term.needs.covariates & further_column(k)) != 0)
      add(fmt::format("the column {} of the recording", own_terms().covariates[k]));
  return what.empty() ? "nothing beyond attitude, command and time" : what;
}

std::string grid_text(const ParamSpec& spec) {
  if (spec.kind == ParamKind::moment) return "; profiled over the test";
  std::string text;
  for (const double v : spec.grid)
    text += fmt::format("{}{:g}", text.empty() ? "; profiled over " : ", ", v);
  return text;
}

void explain(const TermInfo& term) {
  show("{}: {}\n  equation  {}\n  source    {}\n  acts on   {}\n  needs     {}\n", term.key,
       term.title, term.equation, term.source, acts_on(term), asks_for(term));
  if (term.memory > 0)
    show("  memory    {} states, carried along the nominal path of each recording{}\n", term.memory,
         term.needs.gimbals ? "; what drift turns the gimbals by beside it is left out" : "");
  show("  {:<14} {:<14} {:<18} {}\n", "parameter", "unit", "default prior", "enters");
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    show("  {:<14} {:<14} {:<18} {}{}\n", spec.key.view(), spec.unit.symbol.view(),
         prior_text(spec), spec.enters, grid_text(spec));
  }
}

struct TermsArguments {
  std::string key, config;
};

ExitCode terms(const TermsArguments& arguments) {
  if (!arguments.config.empty()) mc::read_study(arguments.config);  // its own terms come with it
  const std::string& key = arguments.key;
  if (key.empty()) {
    show("{:<32} {:>3}  {}\n", "term", "par", "equation");
    for (const TermInfo& term : TermLibrary::terms)
      show("{:<32} {:>3}  {}\n", term.key, term.count, term.equation);
    show("{} terms, {} parameters. `driftscope terms KEY` explains a term or a parameter.\n",
         TermLibrary::terms.size(), TermLibrary::specs.size());
    return ExitCode::ok;
  }
  // Whatever a study file may call them: a term, one axis of it, a parameter, a group of them.
  const ParamMask named = params_named(key);
  for (std::size_t i = 0; i < named.size(); ++i)
    if (named[i]) {
      explain(TermLibrary::owner(i));
      return ExitCode::ok;
    }
  std::vector<std::string_view> known = term_keys();
  for (const std::string_view parameter : parameter_keys()) known.push_back(parameter);
  throw InputError(ExitCode::usage,
                   fmt::format("terms: no term or parameter '{}'. {} `driftscope terms` "
                               "lists all",
                               key, config::suggestion(key, known, "See the list:")));
}

}  // namespace

Command terms_command() {
  const auto add = [](CLI::App& app, TermsArguments& a) {
    app.add_option("key", a.key,
                   "a term, an axis of one (g_drift.x), a parameter or a group of them (eta)");
    app.add_option("--config", a.config, "a study file whose own terms, [[term]], are listed too");
  };
  return {"terms", group::plans, "list the physics terms, or explain one",
          "driftscope terms gyro_misalignment", with_arguments<TermsArguments>(add, terms)};
}

}  // namespace drift::cli
