#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/too_large.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace search;

/// Near all and near nothing with decimals: 99.7 % absorbed is not 100 %.
Cell percent_cell(double share) {
  const int decimals = share > 0.999 ? 2 : share > 0.99 || share < 0.1 ? 1 : 0;
  return {share, std::isfinite(share) ? fmt::format("{:.{}f} %", 100.0 * share, decimals) : "-"};
}

Cell unit_cell(const std::string& unit) {
  return {unit.empty() ? Value() : Value(unit), unit == "1" ? "" : unit};
}

/// Why a candidate is none of the causes. best: the largest log evidence among those.
std::string why_not(const Diagnosis& d, const CandidateScore& c, double best) {
  if (!c.observable) return "not observable on this plan";
  if (c.p_value > inference::RemarkLimits::chance_p) return "no stronger than chance";
  if (c.size_sigma > unusual_size)
    return fmt::format("would be {} times its usual size", number_text(c.size_sigma, 2));
  if (!c.leaves_nothing) return "with it, others stay significant";
  if (d.causes.empty() || !(best > c.log_bayes)) return "did not hold in the refit";
  return fmt::format("less likely by a factor of {}", number_text(std::exp(best - c.log_bayes), 2));
}

std::string remark_of(const Diagnosis& d, const CandidateScore& c, int alternative, double best) {
  if (alternative > 0 && d.verdict == Verdict::named) return "named";
  if (alternative > 0 && d.verdict == Verdict::ambiguous)
    return fmt::format("alternative {}", alternative);
  return why_not(d, c, best);
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
    if (!one_axis_does && parts.size() < 3)
      parts.push_back(fmt::format("{} ({:.2f})", keyed(o.term, o.axis), o.cosine));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Table cause_table(const Diagnosis& d) {
  constexpr const char* marked = "*";  // what the note below the table is about
  Table table(d.verdict == Verdict::ambiguous ? "Causes that remain possible" : "Causes",
              "<term | <parameter | value | <unit | p | probability | size [prior sigmas] | "
              "<like (cosine)");
  const bool alternatives = d.verdict == Verdict::ambiguous &&
                            std::ranges::any_of(d.causes, [](const Cause& c) { return c.set > 0; });
  int set = -1;
  for (const Cause& c : d.causes) {
    if (alternatives && c.set != set) table.add_heading(fmt::format("alternative {}", c.set + 1));
    set = c.set;
    const auto add = [&](std::size_t k, const Cell& key, const Cell& value, const Cell& unit) {
      std::vector<Cell> row{k == 0 ? shown_label(d, c) : "", key, value, unit, "", "", "", ""};
      if (k == 0) {
        row[4] = p_cell(c.p_value);
        row[5] = decimals(c.probability, 2);
        row[6] = digits(c.size_sigma, 2);
        row[7] = confusable_text(c);
      }
      table.add(std::move(row));
    };
    if (c.parameters.empty()) add(0, "", "", "");
    for (std::size_t k = 0; k < c.parameters.size(); ++k) {
      const CauseParameter& p = c.parameters[k];
      const std::string note = note_in_words(p);
      if (!note.empty()) table.note = fmt::format("{}: {}.", marked, note);
      add(k, note.empty() ? p.key : p.key + marked, value_in_words(p), unit_cell(p.unit));
    }
  }
  return table;
}

/// Scores of the strongest candidates.
Blocks candidate_figure(const Diagnosis& d) {
  BarChart bars{"Candidates", "projected score, chi-square", {}, std::nullopt, 860.0};
  for (const auto& [c, alternative] : shown_candidates(d, 20)) {
    if (!std::isfinite(c->score)) continue;
    const std::string named = alternative == 0 ? ""
                              : d.verdict == Verdict::named
                                  ? ", named"
                                  : fmt::format(", alternative {}", alternative);
    bars.bars.push_back(
        {.label = shown_label(d, *c),
         .value = c->score,
         .colour = alternative > 0 ? 1u : 6u,
         .text = fmt::format("{}, p {}{}", number_text(c->score), p_text(c->p_value), named)});
  }
  if (bars.bars.empty()) return {};
  return {figure_of(
      std::move(bars),
      fmt::format("Strength of the strongest candidates, each alone, after what the "
                  "fitted parameters absorb.{}",
                  d.causes.empty() ? "" : " Orange: the causes of the verdict, always shown."),
      "candidates.svg")};
}

/// Cosines between causes.
Blocks likeness_figure(const CosineMatrix& m) {
  if (m.cosine.rows() < 2 || m.cosine.rows() != std::ssize(m.labels)) return {};
  HeatMap map;
  map.title = "Likeness of the causes on this plan";
  map.value_label = "cosine: ±1 cannot be told apart";
  map.rows = map.columns = m.labels;
  map.value = m.cosine;
  map.most = 1.0;
  return {figure_of(
      std::move(map),
      "Cosines between what is left of the signatures when the fitted parameters took their part.",
      "cosines.svg")};
}

/// The terms of the causes with their equations, each once.
Sentences equations_of(const std::vector<Cause>& causes, Instrument instrument) {
  Sentences said;
  for (const Cause& c : causes)
    if (const auto term = TermLibrary::find_term(c.term)) {
      const TermInfo& info = TermLibrary::terms[*term];
      auto line = fmt::format("{}, {}: {}", info.key, title_of(info, instrument),
                              equation_of(info, instrument));
      if (std::ranges::find(said.items, line) == said.items.end())
        said.items.push_back(std::move(line));
    }
  return said;
}

/// A size of a cause is given with all at zero that the same effect could have on that axis
/// besides.
Sentences taken_as_zero(const Diagnosis& d) {
  Sentences said;
  for (const Cause& c : d.causes) {
    const auto term = TermLibrary::find_term(c.term);
    if (!term || c.axis.empty()) continue;
    const TermInfo& info = TermLibrary::terms[*term];
    std::vector<std::string> zero;
    for (std::size_t i = info.first; i < info.first + info.count; ++i) {
      const ParamSpec& spec = TermLibrary::specs[i];
      if (spec.amplitude() && spec.axis == c.axis && !d.nominal.active[i] &&
          std::ranges::find(c.parameters, i, &CauseParameter::param) == c.parameters.end())
        zero.emplace_back(spec.key.view());
    }
    if (!zero.empty())
      said.items.push_back(fmt::format(
          "{}: its size is that with {} at zero, which the same effect may have too and this "
          "recording does not ask for.",
          shown_label(d, c), listed(zero, "and")));
  }
  return said;
}

}  // namespace

Table candidate_table(const Diagnosis& d) {
  Table table(
      "Candidates, strongest first",
      "term= | axis= | label= | <candidate | score=score | dof=dof | p_value=p | "
      "p_value_alone= | absorbed=absorbed | amplitude=amplitude | sigma= | "
      "smallest_detectable=detectable | unit=<unit | size_sigma= | log_bayes= | "
      "probability_alone=prob. alone | adequate= | observable= | why_not=<verdict, or why not",
      "p: family-wise, over all that was tried. absorbed: part of the raw signature that "
      "fitted parameters take up. detectable: size found with 80 % probability. prob. alone: of "
      "this candidate by itself against all others and nothing; not that of what is named.");
  table.limit = {6, 40, "diagnosis.json"};
  const std::vector<ShownCandidate> all = shown_candidates(d, d.candidates.size());
  double best = -std::numeric_limits<double>::infinity();
  for (const ShownCandidate& c : all)
    if (c.alternative > 0) best = std::max(best, c.score->log_bayes);
  for (const auto& [c, alternative] : all) {
    const bool one = c->sigma > 0.0;  // of several parameters there is no single amplitude
    const Tone tone = alternative > 0 ? Tone::good : Tone::plain;
    table.add({c->term, text_or_nothing(c->axis), c->label, Cell(shown_label(d, *c), tone),
               c->score, c->dof, p_cell(c->p_value), c->p_marginal, percent_cell(c->absorbed),
               one ? plus_minus(c->amplitude, c->sigma) : only_value(Value()),
               only_value(one ? Value(c->sigma) : Value()),
               one ? digits(c->smallest_detectable, 2) : only_value(Value()), unit_cell(c->unit),
               c->size_sigma, c->log_bayes,
               Cell(c->probability, c->probability < 5e-4 ? "0" : number_text(c->probability, 2)),
               c->adequate, c->observable, remark_of(d, *c, alternative, best)});
    table.rows.back().always = alternative > 0;
  }
  return table;
}

Section what(const Diagnosis& d) {
  Section section{"What", {}};
  section.add(cause_figure(d));
  if (!d.causes.empty()) section.add({cause_table(d)});
  if (Sentences said = equations_of(d.causes, instrument_of(d)); !said.items.empty())
    section.add({{std::move(said), On::page}});
  if (Sentences said = taken_as_zero(d); !said.items.empty())
    section.add({{std::move(said), On::page}});
  if (!d.inseparable.empty())
    section.add(
        {{Paragraph{fmt::format(
              "Unlike by less than a thousandth on this plan, so that it takes an effect of "
              "{:.0f} sigma to tell them apart by 2:",
              2.0 / std::sqrt(inference::TraceLimits::unlike))},
          On::page},
         {Sentences{twins_in_words(d.inseparable, instrument_of(d))}, On::page}});
  return section;
}

Section likeness(const Diagnosis& d) {
  return {"Likeness of the causes", likeness_figure(d.cosines), On::page};
}

/// All that was tried.
Section rivals(const Diagnosis& d) {
  Section section{"Candidates", candidate_figure(d)};
  if (!d.candidates.empty()) section.add({candidate_table(d)});
  return section;
}

}  // namespace drift::report
