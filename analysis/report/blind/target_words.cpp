#include "analysis/report/blind/target_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace drift::report {
namespace {

using blind::Goal;
using blind::Standing;
using blind::Target;

struct GoalWords {
  std::string_view in_full, in_brief, name;
};

GoalWords goal_words(Goal goal) {
  switch (goal) {
    case Goal::looks_healthy:
      return {"nominal fit of effect trials looks healthy", "nominal fit looks healthy",
              "nominal fit looks healthy on effect trials"};
    case Goal::alarm_on_null:
      return {"false alarms, nothing hidden", "alarms, nothing hidden", "false alarms on nulls"};
    case Goal::alarm_on_noise:
      return {"false alarms, noise not as declared", "alarms, noise not as declared",
              "false alarms on wrong-noise nulls"};
    case Goal::detected_at_8_sigma:
      return {"detected at 8 sigma", "detected at 8 sigma", "power at 8 sigma"};
    case Goal::in_set:
      return {"8 sigma and more: named exactly, or in a set of at most 3",
              "in a set of up to three",
              "8 sigma and above: named exactly or in a set of at most 3"};
    case Goal::right_name:
      return {"8 sigma and more: one name, the right one", "one right name",
              "8 sigma and above: exact single name"};
    case Goal::wrong_name:
      return {"8 sigma and more: one name, a wrong one", "one wrong name",
              "8 sigma and above: confidently wrong"};
    case Goal::pair_in_set:
      return {"two effects: the pair, or a set of at most 3 that holds it", "two effects found",
              "pairs found as pair or set"};
    case Goal::outside_unexplained:
      return {"effects that are not in the library: unexplained", "unknown effect unexplained",
              "outside the library: unexplained"};
    case Goal::size_within_two_sigma:
      break;
  }
  return {"recovered size within 2 sigma", "size within 2 sigma",
          "recovered parameter within 2 sigma"};
}

std::size_t targets_that_stand(const std::vector<Target>& targets, Standing standing) {
  return static_cast<std::size_t>(std::ranges::count(targets, standing, &Target::standing));
}

/// "one right name 4 of 8 (at least 0.75); two effects found 0 of 2 (at least 0.90)" of those that
/// stand so, and of what is not decided first what is missed by its share.
std::string standing_so(const std::vector<Target>& targets, Standing standing) {
  std::vector<std::string> items;
  for (const bool met : {false, true})
    for (const Target& t : targets)
      if (t.standing() == standing && (t.measured.n > 0 && t.met()) == met)
        items.push_back(t.measured.n == 0
                            ? fmt::format("{}, no trial ({})", in_brief(t.goal), wanted(t))
                            : fmt::format("{} {} of {} ({})", in_brief(t.goal), t.measured.k,
                                          t.measured.n, wanted(t)));
  return fmt::format("{}", fmt::join(items, "; "));
}

}  // namespace

std::string_view in_full(Goal goal) {
  return goal_words(goal).in_full;
}

std::string_view in_brief(Goal goal) {
  return goal_words(goal).in_brief;
}

std::string_view name_for_machines(Goal goal) {
  return goal_words(goal).name;
}

std::string wanted(const Target& t) {
  if (t.low > 0.0 && t.high < 1.0) return fmt::format("{:.2f} to {:.2f}", t.low, t.high);
  return t.low > 0.0 ? fmt::format("at least {:.2f}", t.low)
                     : fmt::format("at most {:.2f}", t.high);
}

std::string standings_text(const blind::Summary& s) {
  const auto count = [&](Standing standing) { return targets_that_stand(s.targets, standing); };
  std::vector<std::string> parts;
  for (const auto& [number, how] : {std::pair{count(Standing::missed), "missed"},
                                    {count(Standing::missed_within), "missed within its interval"},
                                    {count(Standing::not_decided), "not decided"}})
    if (number > 0)
      parts.push_back(
          fmt::format("{}{} {}", number,
                      parts.empty() ? fmt::format(" of {} targets", s.targets.size()) : "", how));
  if (parts.empty()) {
    const std::size_t within = count(Standing::met_within);
    parts.push_back(fmt::format("All {} targets met", s.targets.size()));
    if (within > 0)
      parts.push_back(
          fmt::format("{} within {}", within, within == 1 ? "its interval" : "their intervals"));
  }
  return fmt::format("{}: {} trials{}.", fmt::join(parts, ", "), s.trials,
                     s.failed > 0 ? fmt::format(", {} of them without an answer", s.failed) : "");
}

WeighedTexts targets_in_brief(const std::vector<Target>& targets) {
  WeighedTexts all;
  const auto add = [&](std::string_view head, Standing whole, Standing within, Weight weight) {
    const std::string sure = standing_so(targets, whole), near = standing_so(targets, within);
    if (sure.empty() && near.empty()) return;
    all.add(weight, fmt::format("{}{}{}{}{}.", head, sure.empty() ? ", " : ": ", sure,
                                sure.empty() || near.empty() ? "" : "; ",
                                near.empty() ? "" : "within its interval: " + near));
  };
  add("Missed", Standing::missed, Standing::missed_within,
      targets_that_stand(targets, Standing::missed) > 0 ? Weight::wrong : Weight::doubtful);
  const std::string open = standing_so(targets, Standing::not_decided);
  if (!open.empty()) all.add(Weight::note, fmt::format("Not decided: {}.", open));
  add("Met", Standing::met, Standing::met_within, Weight::note);
  return all;
}

}  // namespace drift::report
