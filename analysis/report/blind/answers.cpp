#include <numeric>

#include "analysis/blind/key.hpp"
#include "analysis/report/blind/sections.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"

namespace drift::report {
namespace {

/// Shares of each row of the confusion table.
HeatMap confusion_map(const blind::Confusion& c) {
  HeatMap map;
  map.title = "What was hidden (rows) and what it was called (columns)";
  map.value_label = "share of the row";
  map.columns = c.columns;
  map.most = 1.0;
  map.value = MatX::Zero(static_cast<Eigen::Index>(c.rows.size()),
                         static_cast<Eigen::Index>(c.columns.size()));
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    const auto& called = c.rows[r].called;
    map.rows.push_back(c.rows[r].hidden);
    const auto total =
        static_cast<double>(std::accumulate(called.begin(), called.end(), std::size_t{0}));
    for (std::size_t k = 0; k < called.size(); ++k)
      map.value(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) =
          static_cast<double>(called[k]) / total;
  }
  return map;
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
    parts.push_back(search::keyed(e.term, e.axis));
    if (!e.nearest.empty())
      parts.back() += fmt::format(" (cosine {:.2f} to {})", e.nearest_cosine, e.nearest);
  }
  return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, " + "));
}

std::string answer_text(const blind::Answer& a) {
  if (a.failed) return "failed: " + a.failure;
  std::vector<std::string> alternatives;
  for (const auto& alternative : a.alternatives()) {
    std::vector<std::string> parts;
    for (const blind::AnswerCause* c : alternative)
      parts.push_back(search::keyed(c->term, c->axis));
    alternatives.push_back(fmt::format("{}", fmt::join(parts, " + ")));
  }
  return fmt::format("{}{}{}", diagnosis::text(a.verdict), alternatives.empty() ? "" : ": ",
                     fmt::join(alternatives, ", or "));
}

}  // namespace

Section confusion(const BlindResults& results) {
  const blind::Confusion& c = results.summary.confusion;
  Table t("What was hidden (rows) and what it was called", "<hidden | <called");
  for (const blind::ConfusionRow& r : c.rows) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < r.called.size(); ++k)
      if (r.called[k] > 0) parts.push_back(fmt::format("{} {}", c.columns[k], r.called[k]));
    t.add({r.hidden, fmt::format("{}", fmt::join(parts, ", "))});
  }
  return {"Confusion",
          {figure_of(confusion_map(c),
                     "Of all trials with this thing hidden, the share that got this answer.",
                     "confusion.svg"),
           t}};
}

/// Every trial whose answer is wrong: what was hidden, what was answered.
Section misses(const BlindResults& results) {
  Table t("Trials that were answered wrong",
          "trial | <plan | <truth | sigma | absorbed | <hidden | <answered");
  for (const blind::TrialScore& s : results.scores) {
    if (!missed(s)) continue;
    const auto& plan = s.key.plan;
    const bool effect = !s.key.effects.empty();
    t.add({plan.number, fmt::format("{} {}", plan.plan, key_of(plan.mode)), key_of(plan.coupling),
           effect ? Cell(s.size()) : "-",
           effect ? decimals(s.key.effects.front().absorbed, 3) : "-", hidden_text(s),
           answer_text(s.answer)});
  }
  return {"Trials that were answered wrong", {t}};
}

}  // namespace drift::report
