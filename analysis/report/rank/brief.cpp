#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <filesystem>

#include "analysis/report/page/planned_study.hpp"
#include "analysis/report/page/study_words.hpp"
#include "analysis/report/rank/sections.hpp"

namespace drift::report {
namespace {

constexpr double half_known = 0.5, hardly_known = 0.9;  // of the prior sigma

/// A model of the file, and what its test does not see.
struct Seen {
  const planning::ModelRanking& model;
  std::vector<NamedDirection> unseen;
  std::string_view drawn_from;  ///< of the truths elsewhere

  bool whole() const {
    return unseen.empty() && std::ranges::none_of(model.ranking.parameters, [](const auto& p) {
             return p.learning_ratio() > hardly_known;
           });
  }
};

std::vector<Seen> seen_by(const planning::PlanRanking& rank) {
  std::vector<Seen> all;
  for (const planning::RankingGroup& g : rank.groups)
    for (const planning::ModelRanking& m : g.models)
      if (m.of_the_file())
        all.push_back({m, unseen_directions(m), source_of_truths(rank.at_truth)});
  return all;
}

/// Combinations that are not seen for one reason: more than one parameter each, the others are
/// named as parameters.
using OfReason = std::vector<NamedDirection>;

std::vector<OfReason> combinations_of(const std::vector<NamedDirection>& directions) {
  std::vector<OfReason> all;
  for (const NamedDirection& d : directions) {
    if (d.parts.size() == 1) continue;
    const auto known = std::ranges::find_if(
        all, [&](const auto& group) { return group.front().reason == d.reason; });
    if (known == all.end())
      all.push_back({d});
    else
      known->push_back(d);
  }
  return all;
}

/// "; 3 combinations are not seen, and no position shows them".
std::string count_text(const OfReason& group) {
  const bool one = group.size() == 1;
  const NamedDirection& first = group.front();
  return fmt::format("; {} combination{} not seen{}", group.size(), one ? " is" : "s are",
                     first.reason.empty() ? ", for no known reason"
                     : !first.anywhere    ? ""
                     : one                ? ", and no position shows it"
                                          : ", and no position shows them");
}

/// "D_F_x - D_II_x - ..., ... (fixed drift with ...); ...". Empty where all are seen.
std::string combinations_text(const Seen& s) {
  constexpr std::size_t most = 3;
  std::vector<std::string> groups;
  for (const OfReason& group : combinations_of(s.unseen)) {
    std::vector<std::string> names;
    for (const NamedDirection& d : group) names.push_back(d.combination);
    const std::string& reason = group.front().reason;
    groups.push_back(listed_up_to(names, most) +
                     (reason.empty() ? "" : fmt::format(" ({})", reason)));
  }
  return fmt::format("{}", fmt::join(groups, "; "));
}

/// What is left of each prior sigma if positions show all that a position can: its part along the
/// directions that none shows.
VecX left_by_all_positions(const Seen& s) {
  const Layout& layout = s.model.ranking.layout;
  const auto n = static_cast<Eigen::Index>(layout.size());
  MatX hidden = MatX::Zero(n, std::ranges::count_if(s.unseen, &NamedDirection::anywhere));
  Eigen::Index column = 0;
  for (const NamedDirection& d : s.unseen) {
    if (!d.anywhere) continue;
    for (const NamedDirection::Part& part : d.parts) {
      const auto k = std::ranges::find(layout.params, part.param) - layout.params.begin();
      hidden(k, column) = part.coefficient * unit_of(part.param) / layout.sigma[k];
    }
    ++column;
  }
  if (column == 0) return VecX::Zero(n);
  const MatX basis = MatX(hidden.householderQr().householderQ() * MatX::Identity(n, hidden.cols()));
  return basis.rowwise().norm();
}

/// Whether what is not seen, or hardly, may be at other positions.
bool positions_may_help(const Seen& s) {
  if (!std::ranges::all_of(s.unseen, &NamedDirection::anywhere)) return true;
  const VecX left = left_by_all_positions(s);
  for (std::size_t k = 0; k < s.model.ranking.parameters.size(); ++k)
    if (s.model.ranking.learning_ratio(k) > hardly_known &&
        left[static_cast<Eigen::Index>(k)] <= hardly_known)
      return true;
  return false;
}

/// "14 of 18 parameters end below half their prior sigma; hardly seen: eta_y, xi_x (...); 3
/// combinations are not seen". Those that a product hides where the plan is linearised alone are
/// told apart. `said_before`: the combinations of the model before.
std::string seen_text(const Seen& s, const std::string& said_before) {
  const planning::ModelRanking& m = s.model;
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
  if (s.whole()) return said + "; every one is seen.";
  if (!unseen.empty())
    said += fmt::format("; hardly or not seen, at least 90 % of the prior sigma is left: {}",
                        listed_up_to(unseen, most));
  if (!hidden.empty())
    said += fmt::format(
        "; not seen where the plan is linearised, but at truths drawn from {} (what is "
        "left of the prior sigma at four): {}",
        s.drawn_from, listed_up_to(hidden, most));
  if (!said_before.empty() && combinations_text(s) == said_before)
    return said + "; the same combinations are not seen.";
  for (const OfReason& group : combinations_of(s.unseen)) said += count_text(group);
  return said + ".";
}

/// What a sigma is where the truth lies elsewhere, if that is something else. `where`: the truths.
std::string range_text(const observability::Ranking& r, std::size_t k, const planning::Elsewhere& e,
                       std::string_view where) {
  if (!e.other_than(r.learning_ratio(k))) return "";
  const double prior = r.parameters[k].prior_sigma / unit_of(r.parameters[k].param);
  return fmt::format(" ({} to {} {})", number_text(prior * e.low), number_text(prior * e.high),
                     where);
}

/// What is ranked, and for whom: "eq5 (filter corrected)".
std::string filter_text(const planning::ModelRanking& m) {
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
  std::string where = fmt::format("at four truths drawn from {}", source_of_truths(rank.at_truth));
  for (const std::size_t k : shown) {
    const std::string range = range_text(after, k, rank.better->elsewhere[k], where);
    if (!range.empty()) where = "there";  // of a second one
    const double unit = unit_of(before.parameters[k].param);
    const std::string symbol = parameter_unit(before.parameters[k].param);
    parts.push_back(fmt::format("{} from {} to {}{}{}{}", parameter_key(before.layout, k),
                                number_text(before.parameters[k].posterior_sigma / unit),
                                number_text(after.parameters[k].posterior_sigma / unit),
                                symbol == "1" ? "" : " ", symbol == "1" ? "" : symbol, range));
  }
  if (!has_better_plan(rank)) {
    const std::size_t k = asked.front();
    const bool seen = before.learning_ratio(k) <= hardly_known;
    const bool product = !seen && first.elsewhere[k].other_than(before.learning_ratio(k));
    return fmt::format(
        "No better plan was found for {} under {}: {} further position{} bring{} {}. {}",
        better.criterion.text, filter_text(first), better.steps.size(), plural(better.steps.size()),
        better.steps.size() == 1 ? "s" : "", listed(parts, "and"),
        product ? "It is in a product that is not seen where the plan is linearised: give the "
                  "numbers of the others in [truth.parameters], and it is linearised there."
        : seen  ? "None that the gimbals allow makes it smaller."
                : "None that the gimbals allow shows it.");
  }
  using Kind = planning::Criterion::Kind;
  const std::string judged = better.criterion.kind == Kind::A ? "over all parameters (criterion A)"
                             : better.criterion.kind == Kind::D ? "in bits (criterion D)"
                                                                : "for " + better.criterion.text;
  return fmt::format("A better plan under {}, {}: {} further position{} ({} h) bring{} {}.",
                     filter_text(first), judged, better.steps.size(), plural(better.steps.size()),
                     number_text(better.added() / 3600.0), better.steps.size() == 1 ? "s" : "",
                     listed(parts, "and"));
}

/// What to do about what is not seen.
std::string next_text(const mc::Study& study, const planning::PlanRanking& rank,
                      const std::string& folder, const std::vector<Seen>& seen) {
  const std::string fix =
      "of a combination that no position shows, fix one parameter or declare its prior";
  const bool any_hidden = std::ranges::any_of(
      seen, [](const Seen& s) { return std::ranges::any_of(s.unseen, &NamedDirection::anywhere); });
  std::string next;
  if (has_better_plan(rank)) {
    const bool one = rank.better->improvement.steps.size() == 1;
    next =
        folder.empty()
            ? fmt::format("the same command with -o DIR writes {} as a study", one ? "it" : "them")
            : fmt::format("go on with {}, the study with {} in its plan",
                          shell_word((std::filesystem::path(folder) / improved_study).string()),
                          one ? "this position" : "these positions");
  } else if (!rank.better && std::ranges::any_of(seen, positions_may_help)) {
    next = fmt::format("driftscope rank {} --improve 3 -o {} proposes positions to add",
                       study_words(study), folder.empty() ? "out/rank" : shell_word(folder));
  }
  if (any_hidden) next += (next.empty() ? "" : "; ") + fix;
  return next.empty() ? "" : fmt::format("Next: {}.", next);
}

}  // namespace

bool has_better_plan(const planning::PlanRanking& rank) {
  constexpr double rounding = 1e-3;  // of a sigma: what is shown has three digits
  if (!rank.better || rank.better->improvement.steps.empty()) return false;
  const observability::Ranking &before = rank.groups.front().models.front().ranking,
                               &after = rank.better->after;
  for (const std::size_t k : before.order)
    if (parameter_key(before.layout, k) == rank.better->improvement.criterion.text)
      return after.learning_ratio(k) < (1.0 - rounding) * before.learning_ratio(k);
  return true;
}

InBrief rank_in_brief(const mc::Study& study, const planning::PlanRanking& rank,
                      const std::string& folder) {
  InBrief brief;
  const std::vector<Seen> seen = seen_by(rank);
  brief.tone = std::ranges::all_of(seen, &Seen::whole) ? Tone::good : Tone::doubtful;
  // What was asked for, and what limits every number, before lists that take all the room.
  if (rank.better) brief.more.add(Weight::note, gain_text(rank));
  if (std::string walk = walk_text(rank); !walk.empty())
    brief.more.add(Weight::note, std::move(walk));
  std::string said_before;
  std::vector<std::string> lists;
  for (const Seen& s : seen) {
    const std::string said = fmt::format("{}: {}", filter_text(s.model), seen_text(s, said_before)),
                      list = combinations_text(s);
    if (!list.empty() && list != said_before)
      lists.push_back(fmt::format("Not seen under {}: {}.", filter_text(s.model), list));
    said_before = list;
    if (brief.verdict.empty())
      brief.verdict = "Seen under " + said;
    else
      brief.more.add(Weight::note, "Under " + said);
  }
  brief.asked = brief.more.texts().size();  // other filters of the study, too
  if (rank.assumed_field_l) brief.more.add(Weight::note, field_remark(rank));
  for (std::string& list : lists) brief.more.add(Weight::note, std::move(list));
  if (has_better_plan(rank) && !folder.empty())
    brief.more.add(Weight::note, unswept_text(improved_study, study));
  brief.next = next_text(study, rank, folder, seen);
  return brief;
}

}  // namespace drift::report
