#include "analysis/planning/rank.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "analysis/observability/learning_at_truth.hpp"
#include "analysis/preparation/assumed_field.hpp"
#include "core/base/check.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/truth.hpp"
#include "mc/study/own_terms_check.hpp"
#include "mc/study/simulated_surroundings.hpp"
#include "mc/task/campaign.hpp"

namespace drift::planning {
namespace {

bool equal_axes(const Triads& a, const Triads& b) {
  const auto equal = [](const SignedAxis& x, const SignedAxis& y) {
    return x.index == y.index && x.sign == y.sign;
  };
  return std::ranges::equal(a.second, b.second, equal) &&
         std::ranges::equal(a.third, b.third, equal);
}

/// Whether two filters are ranked alike, but for eq. (5) or (6).
bool alike(const ModelSpec& a, const ModelSpec& b) {
  if (a.active != b.active || a.initial_attitude != b.initial_attitude || a.noise != b.noise)
    return false;
  if (!equal_axes(a.mounting.gyro, b.mounting.gyro)) return false;
  if (!equal_axes(a.mounting.accelerometer, b.mounting.accelerometer)) return false;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (a.active[i] && !(a.priors[i] == b.priors[i])) return false;
  return a.coupling == b.coupling || (facts(a.coupling).other && facts(b.coupling).other);
}

/// Whether a filter follows a magnetic field that the study does not declare.
bool must_assume_field(const mc::Study& study) {
  constexpr CovariateSpec field = covariate("field");
  return !study.environment[field].declared() &&
         std::ranges::any_of(study.filters, [&](const FilterSpec& f) {
           return (TermLibrary::needs(f.model().terms).covariates & field.set()) != 0;
         });
}

/// The surroundings of a test that is planned.
Environment surroundings_of(const mc::Study& study) {
  Environment all = study.environment;
  if (must_assume_field(study)) preparation::assume_field(all, study.site.latitude);
  return all;
}

/// Groups with models that are not ranked yet.
std::vector<RankingGroup> groups_of(const mc::Study& study) {
  const Environment environment = surroundings_of(study);
  std::vector<RankingGroup> groups;
  for (const FilterSpec& filter : study.filters) {
    const auto known = std::ranges::find_if(
        groups, [&](const RankingGroup& g) { return alike(g.models.front().model.spec, filter); });
    if (known != groups.end()) {
      known->filters += ", " + filter.name;
      known->each.push_back({filter.name, filter.coupling});
      for (ModelRanking& m : known->models)
        if (m.model.spec.coupling == filter.coupling)
          m.filters += (m.filters.empty() ? "" : ", ") + filter.name;
      continue;
    }
    RankingGroup group{filter.name, {{filter.name, filter.coupling}}, {}};
    const auto add = [&](Coupling coupling) {
      ModelSpec spec = filter;
      spec.coupling = coupling;
      ModelRanking m;
      m.model = observability::ranked_model(spec, study.has_truth ? &study.truth : nullptr,
                                            study.site, study.readout, environment);
      if (coupling == filter.coupling) m.filters = filter.name;
      group.models.push_back(std::move(m));
    };
    add(filter.coupling);
    if (const auto other = facts(filter.coupling).other) add(*other);
    if (make_layout(filter).size() == 0)
      throw InputError(
          ExitCode::config,
          fmt::format("{}: filter '{}' estimates no parameter (expected at least one that "
                      "is not fixed). Give it terms",
                      study.path, filter.name));
    groups.push_back(std::move(group));
  }
  return groups;
}

/// What may be true of the parameters of a model: what [truth] says of those that it has (a number
/// is one truth alone), the filter's priors of the others; the noise that it allows for stays.
/// lambda is that of the truth's coupling.
ModelSpec open_to_truth(const mc::Study& study, const observability::RankedModel& model) {
  ModelSpec open = model.spec;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (TermLibrary::specs[i].kind == ParamKind::noise) open.priors[i] = fixed(model.nominal[i]);
  if (!study.has_truth) return open;
  const TruthSpec& truth = study.truth;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (open.active[i] && truth.active[i] && open.priors[i].sigma() > 0.0)
      open.priors[i] = truth.priors[i];
  if (open.active[closure_param] && facts(facts(truth.coupling).settles_to).lambda)
    open.priors[closure_param] = fixed(model.nominal[closure_param]);
  return open;
}

/// Where parameters multiply (misalignment times drift), the point where the plan is linearised may
/// be a special one: the information at truths that are drawn says so. Where none is open there is
/// nothing to draw.
std::vector<Elsewhere> ranges_elsewhere(const mc::Study& study, const TestPlan& plan,
                                        const observability::RankedModel& model) {
  constexpr std::uint64_t draws = 4;
  const Layout layout = make_layout(model.spec);
  std::vector<Elsewhere> ranges(layout.size());
  const ModelSpec open = open_to_truth(study, model);
  if (std::ranges::all_of(layout.params,
                          [&](std::size_t i) { return open.priors[i].sigma() == 0.0; }))
    return ranges;
  std::ranges::fill(ranges, Elsewhere{std::numeric_limits<double>::infinity(), 0.0});
  for (std::uint64_t k = 0; k < draws; ++k) {
    observability::RankedModel drawn = model;
    drawn.nominal = draw_parameters(open, study.monte_carlo.seed, k, Purpose::parameters);
    const std::vector<double> ratios = observability::learning_at_truth(plan, drawn);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i].low = std::min(ranges[i].low, ratios[i]);
      ranges[i].high = std::max(ranges[i].high, ratios[i]);
    }
  }
  return ranges;
}

void rank_model(const mc::Study& study, const RankOptions& options, ModelRanking& m,
                double& duration) {
  observability::LinearisedPlan plan =
      observability::linearise(study.plan, m.model, options.bins_per_dwell);
  m.ranking = observability::rank_parameters(plan);
  m.course = observability::information_course(plan);
  m.pwcs = observability::pwcs_rank(study.plan, study.site, m.model.spec, study.readout);
  m.drivers = observability::drivers_of(plan, study.plan, m.model);
  m.elsewhere = ranges_elsewhere(study, study.plan, m.model);
  m.methods = observability::compare_methods({m.ranking, m.pwcs, plan, m.course, study.plan});
  duration = plan.duration;
  m.bins = std::move(plan.bins);
  for (observability::TimeBin& bin : m.bins) bin.rows.resize(0, 0);
}

void require_ranked(const mc::Study& study) {
  mc::require_own_terms(study);
  if (study.kind != RecordingKind::platform)
    throw InputError(ExitCode::config,
                     fmt::format("{}: plans are ranked of platforms; [plan] has kind = "
                                 "\"strapdown\". What turns of a case would tell, the sigmas of "
                                 "`driftscope identify` say of a recording of them, a trial run or "
                                 "a simulated one",
                                 study.path));
  if (study.filters.empty())
    throw InputError(ExitCode::config,
                     fmt::format("{}: no [[filter]]: nothing to rank. Add a section [[filter]] "
                                 "with name and coupling",
                                 study.path));
  mc::require_planned_filters(study, surroundings_of(study));
}

}  // namespace

Criterion criterion_of(const mc::Study& study, const std::string& name) {
  require_ranked(study);
  return parse_criterion(name, make_layout(groups_of(study).front().models.front().model.spec));
}

std::optional<Improvement> improve_study(const mc::Study& study, const RankOptions& options,
                                         const JudgeStep& judge, const ImproveProgress& progress) {
  require_ranked(study);
  const std::vector<RankingGroup> groups = groups_of(study);
  const observability::RankedModel& model = groups.front().models.front().model;
  const Criterion criterion = parse_criterion(options.criterion, make_layout(model.spec));
  return improve_plan(study.plan, model, criterion, options.improve, judge, progress);
}

PlanRanking rank_plan(const mc::Study& study, const RankOptions& options,
                      const ImproveProgress& progress) {
  require_ranked(study);
  PlanRanking out;
  out.at_truth = study.has_truth;
  out.groups = groups_of(study);
  std::vector<ModelRanking*> models;
  for (RankingGroup& g : out.groups)
    for (ModelRanking& m : g.models) models.push_back(&m);
  for (const FilterSpec& f : study.filters) out.process_noise |= has_process_noise(f);
  if (must_assume_field(study))
    out.assumed_field_l = preparation::dipole_field_l(study.site.latitude);

  ModelRanking& first = *models.front();
  Criterion criterion;
  if (options.improve > 0)
    criterion = parse_criterion(options.criterion, make_layout(first.model.spec));
  const auto durations = mc::run_campaign(
      models.size(),
      [&](std::size_t k) {
        double duration = 0.0;
        rank_model(study, options, *models[k], duration);
        return duration;
      },
      options.threads);
  out.duration = durations.front();
  if (options.improve > 0) {
    PlanImprovement better;
    better.improvement = options.improvement
                             ? *options.improvement
                             : improve_plan(study.plan, first.model, criterion, options.improve,
                                            options.threads, progress);
    better.after = observability::rank_parameters(
        observability::linearise(better.improvement.plan, first.model));
    better.elsewhere = ranges_elsewhere(study, better.improvement.plan, first.model);
    out.better = std::move(better);
  }
  return out;
}

}  // namespace drift::planning
