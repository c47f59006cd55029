#include <cmath>

#include "analysis/report/blind/sections.hpp"
#include "analysis/report/blind/target_words.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/figure.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

Cell share_cell(const stats::Proportion& p) {
  return p.n == 0 ? Cell("-") : Cell(p.share(), fmt::format("{:.3f}", p.share()));
}

Cell interval_cell(const stats::Proportion& p) {
  if (p.n == 0) return "-";
  return {std::vector{p.low, p.high}, fmt::format("{:.3f} to {:.3f}", p.low, p.high)};
}

Tone tone_of(blind::Standing standing) {
  switch (standing) {
    case blind::Standing::met:
      return Tone::good;
    case blind::Standing::missed:
      return Tone::bad;
    case blind::Standing::missed_within:
      return Tone::doubtful;
    default:
      return Tone::plain;
  }
}

Chart power_chart(const blind::Summary& s) {
  Panel panel;
  panel.x_label = "size, not absorbed by the nominal fit [sigma]";
  panel.y_label = "share of trials";
  panel.y_range = Range{0.0, 1.02};
  Series detected = curve("detected", 0), theory = curve("theory", 6, Stroke::dashed),
         exact = curve("named exactly", 2),
         in_set = curve("in a set of at most 3", 1, Stroke::dashed);
  ExpectedBand band{"95 % interval of detection", {}, {}, {}};
  for (const blind::PowerPoint& p : s.power) {
    for (Series* c : {&detected, &theory, &exact, &in_set}) c->x.push_back(p.mean);
    detected.y.push_back(p.detected.share());
    theory.y.push_back(p.theory);
    exact.y.push_back(p.exact.share());
    in_set.y.push_back(p.in_set.share());
    band.x.push_back(p.mean);
    band.low.push_back(p.detected.low);
    band.high.push_back(p.detected.high);
  }
  if (s.power.empty()) panel.note = "no single effects";
  panel.expected = {band};
  panel.series = {detected, theory, exact, in_set};
  return {"Detection and naming of single effects", {panel}, 1, narrow_page, 320.0};
}

/// Sorted values against the share of them that is smaller.
Series distribution(std::string_view label, std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::ranges::sort(values);
  Series s = curve(label, 0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    s.x.push_back(values[k]);
    s.y.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(values.size()));
  }
  return s;
}

Chart pulls_chart(const blind::Summary& s) {
  Panel panel;
  panel.x_label = "(estimate - truth) / sigma";
  panel.y_label = "share below";
  Series normal = curve("normal distribution", 6, Stroke::dashed);
  for (double x = -3.5; x <= 3.5; x += 0.1) {
    normal.x.push_back(x);
    normal.y.push_back(stats::normal_distribution(x));
  }
  panel.series = {distribution("recovered", s.pulls), normal};
  if (s.pulls.empty()) panel.note = "nothing was named exactly";
  return {"Recovered parameters against the truth", {panel}, 1, narrow_page, 300.0};
}

}  // namespace

Section targets(const BlindResults& results) {
  Table t("Targets", "<score | target | measured | 95 % interval | trials | <",
          fmt::format("Intervals: Clopper and Pearson. Met or missed within its interval: the "
                      "share is on this side of the target, the interval reaches across it. Not "
                      "decided: fewer than {} trials.",
                      blind::fewest_trials));
  for (const blind::Target& x : results.summary.targets)
    t.add({std::string(in_full(x.goal)), wanted(x), share_cell(x.measured),
           interval_cell(x.measured), x.measured.n,
           Cell(std::string(blind::text(x.standing())), tone_of(x.standing()))});
  return {"Targets", {t}};
}

Section power(const BlindResults& results) {
  Table t("Single effects by size",
          "size [sigma] | trials | detected | 95 % interval | theory | exact | in set | subsystem "
          "| wrong",
          "Size: what the nominal fit cannot absorb. Theory: one known signature against the "
          "threshold of about a hundred candidates, 5 % family-wise.");
  for (const blind::PowerPoint& p : results.summary.power)
    t.add({p.mean, p.detected.n, share_cell(p.detected), interval_cell(p.detected),
           decimals(p.theory, 3), share_cell(p.exact), share_cell(p.in_set),
           share_cell(p.subsystem), share_cell(p.wrong)});
  return {
      "Power and naming",
      {figure_of(power_chart(results.summary), "Shares of single effects by size.", "power.svg"),
       t}};
}

Section groups(const BlindResults& results) {
  const blind::Summary& s = results.summary;
  Table t("By plan, command law and coupling of the truth",
          "<group | nulls | false alarms | effects >= 8 sigma | detected | exact | in set | "
          "subsystem | wrong");
  for (const auto* list : {&s.plans, &s.modes, &s.couplings})
    for (const blind::GroupScore& g : *list)
      t.add({g.name, g.false_alarms.n, share_cell(g.false_alarms), g.detected.n,
             share_cell(g.detected), share_cell(g.exact), share_cell(g.in_set),
             share_cell(g.subsystem), share_cell(g.wrong)});
  return {"Groups", {t}};
}

Section further(const BlindResults& results) {
  const blind::Summary& s = results.summary;
  Table t("Further scores", "<score | measured | 95 % interval | trials");
  const auto add = [&](const std::string& name, const stats::Proportion& p) {
    if (p.n > 0) t.add({name, share_cell(p), interval_cell(p), p.n});
  };
  for (const auto& [name, p] : s.further) add(name, p);
  for (const auto& [name, p] : s.wrong_noise) add("false alarms, " + name, p);
  for (const auto& [name, p] : s.outside) add("unexplained, " + name, p);
  // How long diagnoses took is no result: blind.json and the terminal say it, and the page is the
  // same wherever they were made.
  const std::string pulls = fmt::format(
      "Pulls of the recovered parameters have a robust rms of {} (1 if their sigmas are right).",
      number_text(s.pull_rms));
  return {"Further scores",
          {t, Paragraph{pulls},
           figure_of(pulls_chart(s),
                     "Distribution of the recovered parameters where the cause was named exactly.",
                     "pulls.svg")}};
}

}  // namespace drift::report
