#include "analysis/planning/improve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/planning/greedy.hpp"
#include "analysis/planning/position_pool.hpp"
#include "core/base/check.hpp"
#include "core/config/nearest.hpp"
#include "core/estimate/triangle.hpp"

namespace drift::planning {
namespace {

using observability::InformationSum;
using observability::RankedModel;

/// What an addition tells of the attitude at the caging of its chain and of the parameters.
struct AddedRows {
  MatX rows;              ///< [psi | x]
  double duration = 0.0;  ///< slew and dwell [s]
};

/// Integrates a plan (empty: none) on to an addition. InputError if the gimbals do not allow it.
AddedRows added_rows(TestPlan plan, const Addition& addition, const RankedModel& model) {
  const auto first = static_cast<int>(plan.positions.size());
  plan.positions.insert(plan.positions.end(), addition.begin(), addition.end());
  const std::vector<observability::TimeBin> bins = observability::linearise(plan, model).bins;
  const auto start = std::ranges::find_if(
      bins, [&](const observability::TimeBin& b) { return b.position == first; });
  AddedRows out{start->rows, bins.back().t1 - start->t0};
  for (auto bin = start + 1; bin != bins.end(); ++bin)
    out.rows = triangle(stacked(out.rows, bin->rows));
  return out;
}

/// Whether a term knows the time or remembers, so that what a position tells depends on all that
/// came before it.
bool depends_on_the_past(const ModelSpec& spec) {
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    const Needs& needs = TermLibrary::owner(i).needs;
    if (spec.active[i] &&
        (needs.clock || needs.memory || needs.temperature || needs.field || needs.covariates != 0))
      return true;
  }
  return false;
}

/// What is to be integrated before an addition.
TestPlan before(const TestPlan& plan, Entry entry, const ModelSpec& spec) {
  if (depends_on_the_past(spec)) return plan;
  TestPlan part = plan;
  const auto caged = [](const Position& p) { return p.entry == Entry::caged; };
  const auto last = std::find_if(plan.positions.rbegin(), plan.positions.rend(), caged);
  if (entry == Entry::caged)
    part.positions.clear();
  else if (last != plan.positions.rend())
    part.positions.assign(last.base() - 1, plan.positions.end());
  return part;
}

/// "added 3: x=U y=N z=W", no name of the plan.
std::string free_name(const TestPlan& plan, const Position& position) {
  for (std::size_t number = 1;; ++number) {
    const std::string start = fmt::format("added {}: ", number);
    const bool taken = std::ranges::any_of(
        plan.positions, [&](const Position& p) { return p.name.starts_with(start); });
    if (!taken) return fmt::format("{}{}", start, position.axes);
  }
}

double value_of(const Criterion& criterion, const observability::Posterior& posterior) {
  switch (criterion.kind) {
    case Criterion::Kind::A:
      return posterior.sigma.squaredNorm();
    case Criterion::Kind::D:
      return -posterior.bits;
    case Criterion::Kind::parameter:
      break;
  }
  return posterior.sigma[static_cast<Eigen::Index>(criterion.state)];
}

}  // namespace

double Improvement::added() const {
  double sum = 0.0;
  for (const ImprovementStep& s : steps) sum += s.duration;
  return sum;
}

Criterion parse_criterion(const std::string& text, const Layout& layout) {
  if (text == "A") return {Criterion::Kind::A, 0, text};
  if (text == "D") return {Criterion::Kind::D, 0, text};
  std::vector<std::string_view> keys{"A", "D"};
  for (std::size_t k = 0; k < layout.size(); ++k) {
    keys.push_back(TermLibrary::specs[layout.params[k]].key.view());
    if (keys.back() == text) return {Criterion::Kind::parameter, k, text};
  }
  throw InputError(ExitCode::usage,
                   fmt::format("--criterion {}: unknown (expected A, D or a parameter that the "
                               "filter estimates). {}",
                               text, config::suggestion(text, keys)));
}

Improvement improve_plan(const TestPlan& plan, const RankedModel& model, const Criterion& criterion,
                         std::size_t count, int threads, const ImproveProgress& progress) {
  const observability::LinearisedPlan linear = observability::linearise(plan, model);
  InformationSum sum(linear.size());
  for (const observability::TimeBin& bin : linear.bins) sum.add(bin.chain, bin.rows);
  int chain = linear.chains - 1;
  observability::Posterior posterior = observability::posterior_of(sum.root());
  Improvement out{criterion, posterior.sigma, {}, plan};
  out.plan.preset.clear();

  const bool slews = std::ranges::any_of(
      plan.positions, [](const Position& p) { return p.entry == Entry::torqued; });
  const auto integrated_as = [&](Entry entry, std::vector<std::optional<double>> headings) {
    const Position& last = plan.positions.back();
    const TestPlan so_far = before(out.plan, entry, model.spec);
    return integrated(
        held(all_attitudes(), {entry, last.dwell, last.sample, std::move(headings)}),
        [&](const Addition& a) { return added_rows(so_far, a, model); }, threads);
  };
  std::vector<Candidate<AddedRows>> caged, slewed;
  const auto candidate = [&](std::size_t k) -> const Candidate<AddedRows>& {
    return k < caged.size() ? caged[k] : slewed[k - caged.size()];
  };
  const auto with = [&](std::size_t k) {
    InformationSum then = sum;
    then.add(k < caged.size() ? chain + 1 : chain, candidate(k).gain.rows);
    return then;
  };

  take_greedily(
      count,
      [&] {
        if (caged.empty() || depends_on_the_past(model.spec))
          caged = integrated_as(Entry::caged, {std::nullopt});
        if (slews) {
          // A heading that is asked for is written to the study file: whole degrees survive that
          // unchanged.
          const double left = lay_out(out.plan, model.site).intervals.back().heading1;
          const double turned = (std::round(left / detail::deg) + 180.0) * detail::deg;
          slewed = integrated_as(Entry::torqued, {std::nullopt, turned});
        }
        return caged.size() + slewed.size();
      },
      [&](std::size_t k) {
        const double value = value_of(criterion, observability::posterior_of(with(k).root()));
        return std::isfinite(value) ? -value : -HUGE_VAL;
      },
      [&](std::size_t k, double) {
        ImprovementStep step;
        step.before = value_of(criterion, posterior);
        step.feasible = caged.size() + slewed.size();
        step.position = candidate(k).positions.front();
        step.position.name = free_name(out.plan, step.position);
        step.duration = candidate(k).gain.duration;
        sum = with(k);
        chain += k < caged.size() ? 1 : 0;
        posterior = observability::posterior_of(sum.root());
        step.after = value_of(criterion, posterior);
        step.learning_ratios = posterior.sigma;
        out.plan.positions.push_back(step.position);
        out.steps.push_back(std::move(step));
        if (progress) progress(out.steps.size(), count);
        return true;
      },
      threads);
  return out;
}

}  // namespace drift::planning
