#include "analysis/planning/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/triangle.hpp"
#include "core/physics/stochastic.hpp"
#include "core/plan/case_heading.hpp"

namespace drift::planning {
namespace {

using observability::RankedModel;

/// Integrates a plan (empty: none) on to an addition. InputError if the gimbals do not allow it.
AddedRows added_rows(TestPlan plan, const Addition& addition, const RankedModel& model) {
  const auto first = static_cast<int>(plan.positions.size());
  plan.positions.insert(plan.positions.end(), addition.begin(), addition.end());
  const std::vector<observability::TimeBin> bins = observability::linearise(plan, model).bins;
  const auto start = std::ranges::find_if(
      bins, [&](const observability::TimeBin& b) { return b.position == first; });
  AddedRows out{start->rows, bins.back().walked, bins.back().t1 - start->t0};
  for (auto bin = start + 1; bin != bins.end(); ++bin)
    out.rows = triangle(stacked(out.rows, bin->rows));
  return out;
}

/// Whether a term knows the time or remembers, or a drift walks, so that what a position tells
/// depends on all that came before it.
bool depends_on_the_past(const ModelSpec& spec) {
  if (drift_varies(spec)) return true;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    const Needs& needs = TermLibrary::owner(i).needs;
    if (spec.active[i] && (needs.clock || needs.memory || needs.turning || needs.covariates != 0))
      return true;
  }
  return false;
}

/// What is to be integrated before an addition.
TestPlan before(const TestPlan& plan, Entry entry, bool past) {
  if (past) return plan;
  TestPlan part = plan;
  const auto caged = [](const Position& p) { return p.entry == Entry::caged; };
  const auto last = std::find_if(plan.positions.rbegin(), plan.positions.rend(), caged);
  if (entry == Entry::caged)
    part.positions.clear();
  else if (last != plan.positions.rend())
    part.positions.assign(last.base() - 1, plan.positions.end());
  return part;
}

}  // namespace

std::vector<std::optional<double>> headings_after(double left) {
  std::vector<std::optional<double>> headings{std::nullopt};
  // What is asked for is written to the study file: whole degrees survive that unchanged.
  const double degrees = std::round(left / detail::deg);
  for (const double turn : {180.0, -180.0, 360.0, -360.0})
    if (std::abs(degrees + turn) <= most_case_heading_deg)
      headings.emplace_back((degrees + turn) * detail::deg);
  return headings;
}

Candidates::Candidates(const TestPlan& plan, const RankedModel& model)
    : model_(model),
      past_(depends_on_the_past(model.spec)),
      slews_(std::ranges::any_of(plan.positions,
                                 [](const Position& p) { return p.entry == Entry::torqued; })),
      dwell_(plan.positions.back().dwell),
      sample_(plan.positions.back().sample) {
  take(Entry::caged, {std::nullopt});
  caged_ = pool_.size();
  renew(plan);
}

void Candidates::take(Entry entry, std::vector<std::optional<double>> headings) {
  for (Addition& a : held(all_attitudes(), {entry, dwell_, sample_, std::move(headings)}))
    pool_.push_back(std::move(a));
  gains_.resize(pool_.size());
}

void Candidates::renew(const TestPlan& plan) {
  pool_.resize(caged_);
  gains_.resize(past_ ? 0 : caged_);
  gains_.resize(caged_);
  before_caged_ = before(plan, Entry::caged, past_);
  if (!slews_) return;
  before_slewed_ = before(plan, Entry::torqued, past_);
  take(Entry::torqued, headings_after(lay_out(plan, model_.site).intervals.back().heading1));
}

const std::optional<AddedRows>& Candidates::gain(std::size_t k) {
  if (gains_[k]) return *gains_[k];
  try {
    gains_[k].emplace(added_rows(is_caged(k) ? before_caged_ : before_slewed_, pool_[k], model_));
  } catch (const InputError&) {
    gains_[k].emplace(std::nullopt);
  }
  return *gains_[k];
}

}  // namespace drift::planning
