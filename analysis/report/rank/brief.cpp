#include <algorithm>

#include "analysis/report/page/study_words.hpp"
#include "analysis/report/rank/sections.hpp"

namespace drift::report {
namespace {

constexpr double half_known = 0.5, hardly_known = 0.9;  // of the prior sigma

/// "14 of 18 parameters end below half their prior sigma; hardly seen: eta_y, xi_x (...)".
/// Those that a product hides where the plan is linearised alone are told apart.
std::string seen_text(const planning::ModelRanking& m) {
  constexpr std::size_t most = 8;
  const observability::Ranking& r = m.ranking;
  std::vector<std::string> unseen, hidden;
  std::size_t known = 0;
  for (const std::size_t k : r.order) {
    const double here = r.learning_ratio(k);
    known += here < half_known;
    if (here <= hardly_known) continue;
    const planning::Elsewhere& e = m.elsewhere[k];
    if (e.other_than(here) && e.low <= hardly_known)
      hidden.push_back(fmt::format("{} ({} to {})", parameter_key(r.layout, k),
                                   number_text(e.low, 2), number_text(e.high, 2)));
    else
      unseen.push_back(parameter_key(r.layout, k));
  }
  std::string said = fmt::format("{} of {} parameters end below half their prior sigma", known,
                                 r.parameters.size());
  if (unseen.empty() && hidden.empty()) return said + "; every one is seen.";
  if (!unseen.empty())
    said += fmt::format("; hardly or not seen, at least 90 % of the prior sigma is left: {}",
                        listed_up_to(unseen, most));
  if (!hidden.empty())
    said += fmt::format(
        "; not seen where the plan is linearised, but at truths drawn from the priors (what is "
        "left of the prior sigma at four): {}",
        listed_up_to(hidden, most));
  return said + ".";
}

/// What a sigma is where the truth lies elsewhere, if that is something else.
std::string range_text(const observability::Ranking& r, std::size_t k,
                       const planning::Elsewhere& e) {
  if (!e.other_than(r.learning_ratio(k))) return "";
  const double prior = r.parameters[k].prior_sigma / unit_of(r.parameters[k].param);
  return fmt::format(" ({} to {} at four truths drawn from the priors)", number_text(prior * e.low),
                     number_text(prior * e.high));
}

/// Whether the proposed positions do anything to the parameter that was asked for; of a criterion
/// over all they do.
bool gains(const planning::PlanRanking& rank) {
  constexpr double rounding = 1e-3;  // of a sigma: what is shown has three digits
  const observability::Ranking &before = rank.groups.front().models.front().ranking,
                               &after = rank.better->after;
  for (const std::size_t k : before.order)
    if (parameter_key(before.layout, k) == rank.better->improvement.criterion.text)
      return after.learning_ratio(k) < (1.0 - rounding) * before.learning_ratio(k);
  return true;
}

/// What is ranked, and for whom: "eq5 (filter corrected)".
std::string model_text(const planning::ModelRanking& m) {
  return fmt::format("{} (filter {})", key_of(m.model.spec.coupling), m.filters);
}

/// What the proposed positions do to the parameter that gains most, or that was asked for.
std::string gain_text(const planning::PlanRanking& rank) {
  const planning::Improvement& better = rank.better->improvement;
  if (better.steps.empty()) return "A better plan: the gimbals allow no further position.";
  const planning::ModelRanking& first = rank.groups.front().models.front();
  const observability::Ranking &before = first.ranking, &after = rank.better->after;
  const auto gain = [&](std::size_t k) {
    return before.learning_ratio(k) / after.learning_ratio(k);
  };
  std::vector<std::size_t> shown = before.order;
  std::ranges::stable_sort(shown, std::greater{}, gain);
  std::vector<std::size_t> asked;
  for (const std::size_t k : before.order)
    if (parameter_key(before.layout, k) == better.criterion.text) asked.push_back(k);
  if (!asked.empty()) shown = asked;
  shown.resize(std::min<std::size_t>(shown.size(), 2));
  std::vector<std::string> parts;
  for (const std::size_t k : shown) {
    const double unit = unit_of(before.parameters[k].param);
    const std::string symbol = parameter_unit(before.parameters[k].param);
    parts.push_back(fmt::format("{} from {} to {}{}{}{}", parameter_key(before.layout, k),
                                number_text(before.parameters[k].posterior_sigma / unit),
                                number_text(after.parameters[k].posterior_sigma / unit),
                                symbol == "1" ? "" : " ", symbol == "1" ? "" : symbol,
                                range_text(after, k, rank.better->elsewhere[k])));
  }
  if (!gains(rank)) {
    const std::size_t k = asked.front();
    const bool product = first.elsewhere[k].other_than(before.learning_ratio(k));
    return fmt::format(
        "No better plan was found for {} under {}: {} further position{} bring{} {}. {}",
        better.criterion.text, model_text(first), better.steps.size(), plural(better.steps.size()),
        better.steps.size() == 1 ? "s" : "", listed(parts, "and"),
        product ? "It is in a product that is not seen where the plan is linearised: give the "
                  "numbers of the others in [truth.parameters], and it is linearised there."
                : "None that the gimbals allow shows it.");
  }
  using Kind = planning::Criterion::Kind;
  const std::string judged = better.criterion.kind == Kind::A ? "over all parameters (criterion A)"
                             : better.criterion.kind == Kind::D ? "in bits (criterion D)"
                                                                : "for " + better.criterion.text;
  return fmt::format("A better plan under {}, {}: {} further position{} ({} h) bring{} {}.",
                     model_text(first), judged, better.steps.size(), plural(better.steps.size()),
                     number_text(better.added() / 3600.0), better.steps.size() == 1 ? "s" : "",
                     listed(parts, "and"));
}

}  // namespace

InBrief rank_in_brief(const mc::Study& study, const planning::PlanRanking& rank) {
  InBrief brief;
  brief.tone = Tone::good;
  if (rank.better) brief.more.add(Weight::note, gain_text(rank));
  for (const planning::RankingGroup& g : rank.groups)
    for (const planning::ModelRanking& m : g.models) {
      if (!m.of_the_file()) continue;
      const std::string said = fmt::format("{}: {}", model_text(m), seen_text(m));
      if (brief.verdict.empty())
        brief.verdict = "Seen under " + said;
      else
        brief.more.add(Weight::note, "Under " + said);
      if (std::ranges::any_of(m.ranking.parameters,
                              [](const auto& p) { return p.learning_ratio() > hardly_known; }))
        brief.tone = Tone::doubtful;
    }
  if (rank.process_noise)
    brief.more.add(Weight::note,
                   "A filter has process noise, which this information does not know: what is "
                   "said here is the least that is left.");
  if (rank.assumed_field_l) brief.more.add(Weight::note, field_remark(rank));
  if (rank.better && gains(rank)) {
    brief.next =
        study.plan.preset.empty()
            ? "Next: put the positions of proposed_positions.toml behind the last "
              "[[plan.position]] of the study."
            : "Next: put the positions of proposed_positions.toml, which are all of the plan, in "
              "the place of the study's plan.preset.";
  } else if (!rank.better && brief.tone == Tone::doubtful) {
    brief.next = fmt::format("Next: driftscope rank {} --improve 3 proposes positions to add.",
                             study_words(study));
  }
  return brief;
}

}  // namespace drift::report
