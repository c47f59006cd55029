#include "analysis/report/diagnosis/html.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/report/diagnosis/figures.hpp"
#include "analysis/report/diagnosis/tables.hpp"
#include "analysis/report/diagnosis/words.hpp"
#include "core/physics/coupling_text.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

constexpr std::size_t most_candidates = 40, most_moved = 40, most_windows = 12;

std::string verdict_word(Verdict v) {
  switch (v) {
    case Verdict::consistent:
      return "Consistent: nothing significant is missing.";
    case Verdict::named:
      return "Named: the data single out what is missing.";
    case Verdict::ambiguous:
      return "Ambiguous: something is missing, and several causes remain possible.";
    case Verdict::unexplained:
      break;
  }
  return "Unexplained: something is missing that no candidate fits.";
}

void add_pictures(Section& section, const std::vector<Figure>& figures) {
  for (const Figure& f : figures) section.blocks.emplace_back(Picture{f.svg, f.caption});
}

void add_section(HtmlReport& report, Section section) {
  if (!section.blocks.empty()) report.sections.push_back(std::move(section));
}

Section where_section(const Diagnosis& d) {
  Section section{"Where", {}};
  if (const auto sentence = where_sentence(d.where); !sentence.empty())
    section.blocks.emplace_back(Paragraph{sentence});
  add_pictures(section, where_figures(d));
  for (const RecoveredSignal& s : d.signals)
    if (!s.shape.empty())
      section.blocks.emplace_back(Paragraph{
          s.shape.starts_with(s.equation) ? s.shape : fmt::format("{}: {}", s.equation, s.shape)});
  if (!d.where.windows.empty()) section.blocks.emplace_back(window_table(d, most_windows));
  return section;
}

Section name_section(const Diagnosis& d) {
  Section section{"What", {}};
  if (!d.causes.empty()) section.blocks.emplace_back(cause_table(d));
  std::vector<std::string> explained;
  for (const Cause& c : d.causes)
    if (const auto term = TermLibrary::find_term(c.term)) {
      const TermInfo& info = TermLibrary::terms[*term];
      auto line = fmt::format("{}, {}: {}", info.key, info.title, info.equation);
      if (std::ranges::find(explained, line) == explained.end())
        explained.push_back(std::move(line));
    }
  if (!explained.empty()) section.blocks.emplace_back(Sentences{explained});
  const auto figures = name_figures(d);
  add_pictures(section, figures);
  if (!d.candidates.empty()) section.blocks.emplace_back(candidate_table(d, most_candidates));
  if (!d.inseparable.empty()) {
    section.blocks.emplace_back(Paragraph{"This plan can never tell these apart:"});
    section.blocks.emplace_back(Sentences{d.inseparable});
  }
  return section;
}

Section fit_section(const Diagnosis& d) {
  Section section{d.has_patch ? "Before and after" : "The nominal fit", {}};
  section.blocks.emplace_back(fit_table(d));
  if (const auto sentence = held_out_sentence(d.fit.held_out); !sentence.empty())
    section.blocks.emplace_back(Paragraph{sentence});
  if (!d.has_patch) section.blocks.emplace_back(Paragraph{"No cause is in the model."});
  add_pictures(section, fit_figures(d));
  if (!d.fit.shifted.empty()) section.blocks.emplace_back(moved_table(d, most_moved));
  return section;
}

Section advice_section(const Diagnosis& d) {
  Section section{"Advice", {}};
  for (const Advice& a : d.advice) {
    section.blocks.emplace_back(Paragraph{a.text});
    if (a.plan.empty()) continue;
    section.blocks.emplace_back(advice_table(a));
    section.blocks.emplace_back(Preformatted{positions_toml(a.plan)});
  }
  return section;
}

std::string model_text(const FilterSpec& f) {
  return fmt::format("{}, terms {}", key_of(f.coupling), fmt::join(terms_text(f.active), ", "));
}

Section source_section(const mc::Study& study, const Diagnosis& d, const DiagnosisSource& source) {
  Section section{"Where this came from", {}};
  Table table;
  table.columns = {{"", Align::left}, {"", Align::left}};
  table.add({"study file", study.path});
  for (const auto& r : source.recordings) table.add({"recording", r});
  table.add({"nominal model", model_text(d.nominal)});
  if (d.has_patch) table.add({"patched model (patched.toml)", model_text(d.patched)});
  table.add({"seed", fmt::format("{}", study.monte_carlo.seed)});
  for (const auto& [stage, seconds] : d.seconds)
    table.add({stage, fmt::format("{:.2f} s", seconds)});
  section.blocks.emplace_back(std::move(table));
  if (!source.details.empty()) section.blocks.emplace_back(Preformatted{source.details});
  return section;
}

}  // namespace

std::vector<Figure> diagnosis_figures(const Diagnosis& d) {
  std::vector<Figure> all = where_figures(d);
  for (auto&& figures : {name_figures(d), fit_figures(d)})
    all.insert(all.end(), figures.begin(), figures.end());
  return all;
}

HtmlReport diagnosis_html(const mc::Study& study, const Diagnosis& d,
                          const DiagnosisSource& source) {
  HtmlReport report;
  report.title = study.title.empty() ? "Diagnosis" : study.title;
  report.subtitle =
      fmt::format("{} {}", verdict_word(d.verdict), fmt::join(source.recordings, ", "));
  report.headlines.push_back(verdict_sentence(d));
  if (d.verdict != Verdict::consistent) {
    for (const auto& sentence : {where_sentence(d.where), held_out_sentence(d.fit.held_out)})
      if (!sentence.empty()) report.headlines.push_back(sentence);
  }
  if (!d.advice.empty()) report.headlines.push_back(d.advice.front().text);
  if (auto remarks = remarks_of(d); !remarks.empty())
    add_section(report, {"To be kept in mind", {Sentences{std::move(remarks)}}});
  add_section(report, where_section(d));
  add_section(report, name_section(d));
  add_section(report, fit_section(d));
  if (!d.noise.empty()) add_section(report, {"Noise", {noise_table(d)}});
  add_section(report, advice_section(d));
  add_section(report, source_section(study, d, source));
  report.footer = "Written by driftscope diagnose. Values stand with their units; ± is 1 sigma.";
  return report;
}

}  // namespace drift::report
