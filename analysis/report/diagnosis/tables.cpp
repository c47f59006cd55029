#include "analysis/report/diagnosis/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/words.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

/// Near all and near nothing with decimals: 99.7 % absorbed is not 100 %.
std::string percent(double share) {
  const int decimals = share > 0.999 ? 2 : share > 0.99 || share < 0.1 ? 1 : 0;
  return std::isfinite(share) ? fmt::format("{:.{}f} %", 100.0 * share, decimals) : "-";
}

void say_left_out(Table& table, std::size_t all, std::size_t most) {
  if (all > most)
    table.note += fmt::format("{}{} weaker ones are in diagnosis.json.",
                              table.note.empty() ? "" : " ", all - most);
}

std::string unit_text(const std::string& unit) {
  return unit == "1" ? "" : unit;
}

std::string remark_of(const Diagnosis& d, const CandidateScore& c, int alternative) {
  if (alternative > 0 && d.verdict == Verdict::named) return "named";
  if (alternative > 0 && d.verdict == Verdict::ambiguous)
    return fmt::format("alternative {}", alternative);
  return c.observable ? "" : "not observable on this plan";
}

/// The likest, at most three. All axes of a term are passed over where one axis alone is as like.
std::string confusable_text(const Cause& c) {
  std::vector<std::string> parts;
  for (const Confusable& o : c.confusable_with) {
    const bool one_axis_does =
        o.axis.empty() && std::ranges::any_of(c.confusable_with, [&](const Confusable& k) {
          return k.term == o.term && !k.axis.empty() &&
                 std::abs(std::abs(k.cosine) - std::abs(o.cosine)) < 0.005;
        });
    if (one_axis_does || parts.size() == 3) continue;
    parts.push_back(
        fmt::format("{}{}{} ({:.2f})", o.term, o.axis.empty() ? "" : ".", o.axis, o.cosine));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

Table cause_table(const Diagnosis& d) {
  Table table;
  table.title = d.verdict == Verdict::ambiguous ? "Causes that remain possible" : "Causes";
  table.columns = {{"term", Align::left},
                   {"parameter", Align::left},
                   {"value"},
                   {"unit", Align::left},
                   {"p"},
                   {"probability"},
                   {"size [prior sigmas]"},
                   {"like (cosine)", Align::left}};
  int sets = 0;
  for (const Cause& c : d.causes) sets = std::max(sets, c.set);
  int set = -1;
  for (const Cause& c : d.causes) {
    if (d.verdict == Verdict::ambiguous && sets > 0 && c.set != set)
      table.add_heading(fmt::format("alternative {}", c.set + 1));
    set = c.set;
    const std::string probability =
        std::isfinite(c.probability) ? fmt::format("{:.2f}", c.probability) : "-";
    const auto head = [&](std::string key, std::string value, std::string unit) {
      table.add({label_of(c), std::move(key), std::move(value), std::move(unit), p_text(c.p_value),
                 probability, number_text(c.size_sigma, 2), confusable_text(c)});
    };
    if (c.parameters.empty()) head("", "", "");
    for (std::size_t k = 0; k < c.parameters.size(); ++k) {
      const CauseParameter& p = c.parameters[k];
      if (k == 0)
        head(p.key, with_sigma(p.value, p.sigma), unit_text(p.unit));
      else
        table.add({"", p.key, with_sigma(p.value, p.sigma), unit_text(p.unit), "", "", "", ""});
    }
  }
  return table;
}

Table candidate_table(const Diagnosis& d, std::size_t most) {
  Table table;
  table.title = "Candidates, strongest first";
  table.columns = {{"candidate", Align::left},
                   {"score"},
                   {"dof"},
                   {"p"},
                   {"absorbed"},
                   {"amplitude"},
                   {"detectable"},
                   {"unit", Align::left},
                   {"prob."},
                   {"", Align::left}};
  const auto shown = shown_candidates(d, most);
  for (const auto& [score, alternative] : shown) {
    const CandidateScore& c = *score;
    const Tone tone = alternative > 0 ? Tone::good : Tone::plain;
    table.add({{label_of(c), tone},
               number_text(c.score),
               fmt::format("{}", c.dof),
               p_text(c.p_value),
               percent(c.absorbed),
               c.sigma > 0.0 ? with_sigma(c.amplitude, c.sigma) : "",
               c.sigma > 0.0 ? number_text(c.smallest_detectable, 2) : "",
               unit_text(c.unit),
               c.probability < 5e-4 ? "0" : number_text(c.probability, 2),
               remark_of(d, c, alternative)});
  }
  table.note =
      "p: family-wise, over all that was tried. absorbed: part of the raw signature that fitted "
      "parameters take "
      "up. detectable: size found with 80 % probability.";
  say_left_out(table, d.candidates.size(), shown.size());
  return table;
}

Table fit_table(const Diagnosis& d) {
  const FitComparison& f = d.fit;
  Table table;
  // Without a cause in the model there is nothing to compare with.
  table.title = d.has_patch ? "Before and after" : "The nominal fit";
  table.columns = {{"", Align::left}, {"nominal"}};
  if (d.has_patch) table.columns.push_back({"with the cause"});
  table.columns.push_back({"expected", Align::left});
  const auto line = [&](const char* what, double before, double after, std::string expected) {
    if (!std::isfinite(before) && !std::isfinite(after)) return;
    std::vector<Cell> cells{what, number_text(before, 4)};
    if (d.has_patch) cells.emplace_back(number_text(after, 4));
    cells.emplace_back(std::move(expected));
    table.add(std::move(cells));
  };
  line("chi-square per degree of freedom", f.chi2_per_dof_before, f.chi2_per_dof_after,
       f.band_high > 0.0 ? fmt::format("{:.3f} to {:.3f} (95 %)", f.band_low, f.band_high) : "1");
  line("NIS per degree of freedom", f.whiteness.nis_per_dof_before, f.whiteness.nis_per_dof_after,
       "1");
  line("whiteness of innovations, p (calibrated)", f.whiteness.ljung_box_p_before,
       f.whiteness.ljung_box_p_after, "above 0.05");
  if (!f.held_out.folds.empty())
    line("held-out chi-square per degree of freedom", f.held_out.chi2_per_dof_before,
         f.held_out.chi2_per_dof_after, "1");
  if (!f.held_out.recordings.empty())
    line("recordings held out, chi-square per degree of freedom",
         f.held_out.recording_chi2_per_dof_before, f.held_out.recording_chi2_per_dof_after, "1");
  line("start spread, largest ratio", f.start_spread_before, f.start_spread_after, "below 2");
  if (std::isfinite(f.log_likelihood_ratio) && f.log_likelihood_ratio != 0.0) {
    table.note = fmt::format("The refit with the cause gains {} in twice the log likelihood",
                             number_text(f.log_likelihood_ratio));
    // From one drift equation to the other is no small step: what is seen near the first says
    // nothing of it.
    const bool small_step =
        std::ranges::none_of(d.causes, [](const Cause& c) { return c.term == "frame_closure"; });
    if (small_step && std::isfinite(f.linear_T))
      table.note +=
          fmt::format("; what the nominal model left over had let expect {}{}",
                      number_text(f.linear_T), f.sign_agrees ? "" : ", with the other sign");
    table.note += ".";
  }
  return table;
}

Table moved_table(const Diagnosis& d, std::size_t most) {
  Table table;
  table.title = "Parameters that moved";
  table.columns = {
      {"parameter", Align::left}, {"before"}, {"after"}, {"unit", Align::left}, {"shift [sigma]"}};
  for (std::size_t k = 0; k < std::min(most, d.fit.shifted.size()); ++k) {
    const ShiftedParameter& p = d.fit.shifted[k];
    const double size = std::abs(p.shift_sigma);
    table.add({p.key,
               with_sigma(p.before, p.sigma_before),
               with_sigma(p.after, p.sigma_after),
               p.unit,
               {decimal_text(p.shift_sigma, 1), size > 5.0   ? Tone::bad
                                                : size > 2.0 ? Tone::doubtful
                                                             : Tone::plain}});
  }
  say_left_out(table, d.fit.shifted.size(), most);
  return table;
}

Table noise_table(const Diagnosis& d) {
  Table table;
  table.title = "Noise against what is declared";
  table.columns = {{"component", Align::left}, {"factor"},  {"value"},
                   {"unit", Align::left},      {"tau [s]"}, {"p"},
                   {"", Align::left}};
  for (const NoiseFinding& n : d.noise)
    table.add(
        {n.component,
         with_sigma(n.factor, n.factor_sigma),
         number_text(n.value),
         n.unit,
         n.tau_s > 0.0 ? number_text(n.tau_s) : "",
         p_text(n.p_value),
         {n.significant ? (n.component == "outliers" ? fmt::format("{} samples left out", n.count)
                                                     : "not as declared")
                        : "as declared",
          n.significant ? Tone::doubtful : Tone::plain}});
  return table;
}

Table window_table(const Diagnosis& d, std::size_t most) {
  Table table;
  table.title = "Located windows";
  table.columns = {
      {"equation", Align::left}, {"position"}, {"from [s]"}, {"to [s]"}, {"score"}, {"p"}};
  const auto& recordings = d.where.recordings;
  if (!recordings.empty())
    table.columns.insert(table.columns.end(),
                         {{"recording", Align::left}, {"there [s]", Align::left}});
  for (std::size_t k = 0; k < std::min(most, d.where.windows.size()); ++k) {
    const ScanHit& w = d.where.windows[k];
    std::vector<Cell> cells{w.equation,
                            w.position > 0 ? fmt::format("{}", w.position) : "",
                            decimal_text(w.start_s, 0),
                            decimal_text(w.end_s, 0),
                            number_text(w.T),
                            p_text(w.p_value)};
    if (const RecordingSpan* r = recording_at(recordings, 0.5 * (w.start_s + w.end_s)))
      cells.insert(cells.end(), {r->name, fmt::format("{:.0f} to {:.0f}", w.start_s - r->offset_s,
                                                      w.end_s - r->offset_s)});
    table.add(std::move(cells));
  }
  say_left_out(table, d.where.windows.size(), most);
  return table;
}

Table advice_table(const Advice& advice) {
  Table table;
  table.title = "Positions to add";
  table.columns = {{"name", Align::left}, {"axes", Align::left},  {"dwell"},
                   {"mode", Align::left}, {"entry", Align::left}, {"case heading"}};
  for (const Position& p : advice.plan)
    table.add(
        {p.name, p.axes, fmt::format("{:.0f} min", p.dwell / 60.0),
         p.mode == CommandLaw::level ? "level" : "free",
         p.entry == Entry::torqued ? "torqued" : "caged",
         p.case_heading ? fmt::format("{:.0f} deg", *p.case_heading / unit::deg.to_si) : "chosen"});
  return table;
}

}  // namespace drift::report
