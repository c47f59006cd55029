#include "analysis/report/blind/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

std::string share_text(const blind::Proportion& p) {
  return p.n == 0 ? "-" : fmt::format("{:.3f}", p.share());
}
std::string interval_text(const blind::Proportion& p) {
  return p.n == 0 ? "-" : fmt::format("{:.3f} to {:.3f}", p.low, p.high);
}

std::string wanted(const blind::Target& t) {
  if (t.low > 0.0 && t.high < 1.0) return fmt::format("{:.2f} to {:.2f}", t.low, t.high);
  return t.low > 0.0 ? fmt::format("at least {:.2f}", t.low)
                     : fmt::format("at most {:.2f}", t.high);
}

Cell judged(const blind::Target& t) {
  switch (t.standing()) {
    case blind::Standing::met:
      return {std::string(blind::text(blind::Standing::met)), Tone::good};
    case blind::Standing::missed:
      return {std::string(blind::text(blind::Standing::missed)), Tone::bad};
    case blind::Standing::met_within:
      return {std::string(blind::text(blind::Standing::met_within)), Tone::plain};
    case blind::Standing::missed_within:
      return {std::string(blind::text(blind::Standing::missed_within)), Tone::doubtful};
    case blind::Standing::not_decided:
      break;
  }
  return {std::string(blind::text(blind::Standing::not_decided)), Tone::plain};
}

Table targets_table(const blind::Summary& s) {
  Table t{
      "Targets",
      {{"score", Align::left},
       {"target"},
       {"measured"},
       {"95 % interval"},
       {"trials"},
       {"", Align::left}},
      {},
      fmt::format("Intervals: Clopper and Pearson. Met or missed within its interval: the share is "
                  "on this side of "
                  "the target, the interval reaches across it. Not decided: fewer than {} trials.",
                  blind::fewest_trials)};
  for (const blind::Target& x : s.targets)
    t.add({x.name, wanted(x), share_text(x.measured), interval_text(x.measured),
           std::to_string(x.measured.n), judged(x)});
  return t;
}

Table further_table(const blind::Summary& s) {
  Table t{"Further scores",
          {{"score", Align::left}, {"measured"}, {"95 % interval"}, {"trials"}},
          {},
          {}};
  const auto add = [&](const std::string& name, const blind::Proportion& p) {
    if (p.n > 0) t.add({name, share_text(p), interval_text(p), std::to_string(p.n)});
  };
  for (const auto& [name, p] : s.further) add(name, p);
  for (const auto& [name, p] : s.wrong_noise) add("false alarms, " + name, p);
  for (const auto& [name, p] : s.outside) add("unexplained, " + name, p);
  return t;
}

Table power_table(const blind::Summary& s) {
  Table t{"Single effects by size",
          {{"size [sigma]"},
           {"trials"},
           {"detected"},
           {"95 % interval"},
           {"theory"},
           {"exact"},
           {"in set"},
           {"subsystem"},
           {"wrong"}},
          {},
          "Size: what the nominal fit cannot absorb. Theory: one known signature against the "
          "threshold of about a "
          "hundred candidates, 5 % family-wise."};
  for (const blind::PowerPoint& p : s.power)
    t.add({number_text(p.mean, 3), std::to_string(p.detected.n), share_text(p.detected),
           interval_text(p.detected), fmt::format("{:.3f}", p.theory), share_text(p.exact),
           share_text(p.in_set), share_text(p.subsystem), share_text(p.wrong)});
  return t;
}

Table groups_table(const blind::Summary& s) {
  Table t{"By plan, command law and coupling of the truth",
          {{"group", Align::left},
           {"nulls"},
           {"false alarms"},
           {"effects >= 8 sigma"},
           {"detected"},
           {"exact"},
           {"in set"},
           {"subsystem"},
           {"wrong"}},
          {},
          {}};
  for (const auto* groups : {&s.plans, &s.modes, &s.couplings}) {
    for (const blind::GroupScore& g : *groups)
      t.add({g.name, std::to_string(g.false_alarms.n), share_text(g.false_alarms),
             std::to_string(g.detected.n), share_text(g.detected), share_text(g.exact),
             share_text(g.in_set), share_text(g.subsystem), share_text(g.wrong)});
  }
  return t;
}

Table confusion_table(const blind::Summary& s) {
  Table t{"What was hidden (rows) and what it was called",
          {{"hidden", Align::left}, {"called", Align::left}},
          {},
          {}};
  for (const blind::ConfusionRow& r : s.confusion.rows) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < r.called.size(); ++k)
      if (r.called[k] > 0)
        parts.push_back(fmt::format("{} {}", s.confusion.columns[k], r.called[k]));
    t.add({r.hidden, fmt::format("{}", fmt::join(parts, ", "))});
  }
  return t;
}

bool missed(const blind::TrialScore& s) {
  const blind::Stratum k = s.key.plan.stratum;
  if (s.answer.failed || s.false_alarm || s.confidently_wrong) return true;
  if (k == blind::Stratum::single) return s.size() >= blind::eight_sigma && !s.in_set;
  if (k == blind::Stratum::pair) return !s.in_set;
  return k == blind::Stratum::outside && !s.unexplained;
}

std::string hidden_text(const blind::TrialScore& s) {
  std::vector<std::string> parts;
  for (const blind::HiddenEffect& e : s.key.effects) {
    parts.push_back(e.axis.empty() ? e.term : e.term + "." + e.axis);
    if (!e.nearest.empty())
      parts.back() += fmt::format(" (cosine {:.2f} to {})", e.nearest_cosine, e.nearest);
  }
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, " + "));
}

std::string answer_text(const blind::Answer& a) {
  if (a.failed) return "failed: " + a.failure;
  std::string text(diagnosis::text(a.verdict));
  std::string between = ": ";
  for (const auto& alternative : a.alternatives()) {
    std::vector<std::string> parts;
    for (const blind::AnswerCause* c : alternative)
      parts.push_back(c->axis.empty() ? c->term : c->term + "." + c->axis);
    text += fmt::format("{}{}", between, fmt::join(parts, " + "));
    between = ", or ";
  }
  return text;
}

}  // namespace

std::string text_of(const blind::Proportion& p) {
  return p.n == 0 ? "-"
                  : fmt::format("{:.3f} [{:.3f}, {:.3f}] of {}", p.share(), p.low, p.high, p.n);
}

std::vector<Table> tables_of(const blind::Summary& s) {
  return {targets_table(s), power_table(s), groups_table(s), further_table(s), confusion_table(s)};
}

Table misses_table(const std::vector<blind::TrialScore>& scores) {
  Table t{"Trials that were answered wrong",
          {{"trial"},
           {"plan", Align::left},
           {"truth", Align::left},
           {"sigma"},
           {"absorbed"},
           {"hidden", Align::left},
           {"answered", Align::left}},
          {},
          {}};
  for (const blind::TrialScore& s : scores) {
    if (!missed(s)) continue;
    const bool effect = !s.key.effects.empty();
    t.add(
        {std::to_string(s.key.plan.number),
         fmt::format("{} {}", s.key.plan.plan, blind::name_in(blind::mode_names, s.key.plan.mode)),
         blind::name_in(blind::coupling_names, s.key.plan.coupling),
         effect ? number_text(s.size(), 3) : "-",
         effect ? fmt::format("{:.3f}", s.key.effects.front().absorbed) : "-", hidden_text(s),
         answer_text(s.answer)});
  }
  return t;
}

}  // namespace drift::report
