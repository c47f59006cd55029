#include "analysis/planning/improve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/planning/candidates.hpp"
#include "core/base/check.hpp"
#include "core/config/nearest.hpp"

namespace drift::planning {
namespace {

using observability::InformationSum;
using observability::RankedModel;

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

/// A key without its last word: "D_F" of "D_F_x".
std::string_view stem_of(std::string_view key) {
  return key.substr(0, key.rfind('_'));
}

/// Whether a name was typed, but for capitals or a doubled letter.
bool is_name(std::string_view typed, std::string_view name) {
  constexpr double another_letter = 0.9;  // costs that at least
  return config::typing_distance(typed, name) < another_letter;
}

/// Whether a key may be what was typed: a stem of a letter or two, s of s_x, that another takes the
/// place of is another name, but for capitals.
bool may_be_meant(std::string_view typed, std::string_view key) {
  constexpr std::size_t a_letter_tells = 3;  // letters
  const std::string_view stem = stem_of(key);
  return stem.size() >= a_letter_tells || typed.find('_') == std::string_view::npos ||
         is_name(stem_of(typed), stem);
}

/// What to name where no parameter has the name: those that it begins, the nearest, or all, of a
/// triad the first.
std::string instead_of(const std::string& typed, const std::vector<std::string_view>& keys) {
  std::vector<std::string_view> begun, near{"A", "D"}, first;
  for (const std::string_view key : keys) {
    if (stem_of(key) != key && is_name(typed, stem_of(key))) begun.push_back(key);
    if (may_be_meant(typed, key)) near.push_back(key);
    const bool of_triad = key.ends_with("_y") || key.ends_with("_z");
    if (!of_triad || first.empty() || stem_of(first.back()) != stem_of(key)) first.push_back(key);
  }
  if (!begun.empty()) return fmt::format("Use one of {}", fmt::join(begun, ", "));
  return config::suggestion(
      typed, near,
      fmt::format("Use A, D or one of {} (of _x also _y and _z)", fmt::join(first, ", ")));
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
  std::vector<std::string_view> keys;
  for (std::size_t k = 0; k < layout.size(); ++k) {
    keys.push_back(TermLibrary::specs[layout.params[k]].key.view());
    if (keys.back() == text) return {Criterion::Kind::parameter, k, text};
  }
  if (TermLibrary::find(text))
    throw InputError(
        ExitCode::usage,
        fmt::format("--criterion {}: the filter does not estimate it (expected A, D or a parameter "
                    "that it estimates). Name another, or let the filter estimate it: by a term "
                    "that has it and a prior that is no number",
                    text));
  throw InputError(ExitCode::usage,
                   fmt::format("--criterion {}: unknown (expected A, D or a parameter that the "
                               "filter estimates). {}",
                               text, instead_of(text, keys)));
}

JudgeStep judge_here(int threads) {
  return [threads](std::size_t, std::size_t candidates, const Judge& judge) {
    return std::optional(mc::run_campaign(candidates, judge, threads));
  };
}

Improvement improve_plan(const TestPlan& plan, const RankedModel& model, const Criterion& criterion,
                         std::size_t count, int threads, const ImproveProgress& progress) {
  return *improve_plan(plan, model, criterion, count, judge_here(threads), progress);
}

std::optional<Improvement> improve_plan(const TestPlan& plan, const RankedModel& model,
                                        const Criterion& criterion, std::size_t count,
                                        const JudgeStep& judge, const ImproveProgress& progress) {
  const observability::LinearisedPlan linear = observability::linearise(plan, model);
  InformationSum sum(linear.size());
  for (const observability::TimeBin& bin : linear.bins) sum.add(bin.chain, bin.rows);
  int chain = linear.chains - 1;
  observability::Posterior posterior =
      observability::posterior_of(sum.root(), linear.bins.back().walked);
  Improvement out{criterion, posterior.sigma, {}, plan};
  out.plan.preset.clear();
  Candidates candidates(plan, model);
  const auto with = [&](std::size_t k) {
    InformationSum then = sum;
    then.add(candidates.is_caged(k) ? chain + 1 : chain, candidates.gain(k)->rows);
    return then;
  };
  const auto after = [&](const InformationSum& all, std::size_t k) {
    return observability::posterior_of(all.root(), candidates.gain(k)->walked);
  };
  const auto merit = [&](std::size_t k) -> std::optional<double> {
    if (!candidates.gain(k)) return std::nullopt;
    const double value = value_of(criterion, after(with(k), k));
    return std::isfinite(value) ? -value : -HUGE_VAL;
  };
  for (std::size_t number = 0; number < count; ++number) {
    if (number > 0) candidates.renew(out.plan);
    const auto merits = judge(number, candidates.size(), merit);
    if (!merits) return std::nullopt;
    const auto best = std::ranges::max_element(*merits);  // what is impossible is less than all
    if (best == merits->end() || !*best) break;
    const auto k = static_cast<std::size_t>(best - merits->begin());
    ImprovementStep step;
    step.before = value_of(criterion, posterior);
    step.feasible = static_cast<std::size_t>(
        std::ranges::count_if(*merits, [](const auto& m) { return m.has_value(); }));
    step.position = candidates.position(k);
    step.position.name = free_name(out.plan, step.position);
    step.duration = candidates.gain(k)->duration;
    sum = with(k);
    chain += candidates.is_caged(k) ? 1 : 0;
    posterior = after(sum, k);
    step.after = value_of(criterion, posterior);
    step.learning_ratios = posterior.sigma;
    out.plan.positions.push_back(step.position);
    out.steps.push_back(std::move(step));
    if (progress) progress(out.steps.size(), count);
  }
  return out;
}

}  // namespace drift::planning
