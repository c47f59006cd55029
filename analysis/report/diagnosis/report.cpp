#include "analysis/report/diagnosis/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/planning/position_toml.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/advice_words.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/form_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/page/planned_study.hpp"
#include "core/base/results/folder.hpp"
#include "core/physics/parameters_config.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

std::string model_text(const FilterSpec& f) {
  return fmt::format("{}, terms {}", key_of(f.coupling), fmt::join(terms_text(f.active), ", "));
}

Section origin(const mc::Study& study, const Diagnosis& d, const DiagnosisSource& source) {
  Table table("", "< | <");
  table.add({"study file", study.path});
  for (const auto& r : source.recordings) table.add({"recording", r});
  table.add({"nominal model", model_text(d.nominal)});
  if (d.has_patch) table.add({"patched model (patched.toml)", model_text(d.patched)});
  table.add({"seed", study.monte_carlo.seed});
  for (const auto& [stage, seconds] : d.seconds)
    table.add({stage, fmt::format("{:.2f} s", seconds)});
  Section section{"Where this came from", {table}, On::page, Part::provenance};
  if (!source.details.empty()) section.add({Preformatted{source.details}});
  return section;
}

/// The sizes that lie beyond what was believed of them, whose priors are wider in the patched
/// study.
std::string widened_text(const Diagnosis& d) {
  std::vector<std::string> priors;
  for (const search::Cause& c : d.causes)
    for (const search::CauseParameter& p : c.parameters) {
      const double was = d.nominal.believed(p.param).sigma(),
                   is = d.patched.priors[p.param].sigma();
      if (c.set == 0 && d.patched.active[p.param] && was > 0.0 && is > was)
        priors.push_back(fmt::format("{} ({} {}, {} times what was believed)", p.key,
                                     number_text(is / unit_of(p.param)), p.unit,
                                     number_text(is / was, 2)));
    }
  if (priors.empty()) return "";
  return fmt::format(
      "As wide as the size that was found {} the prior of {}: a narrower one would hold it back.",
      priors.size() > 1 ? "are" : "is", listed(priors, "and"));
}

std::string undeclared_text(const Diagnosis& d) {
  const std::vector<std::string> left = not_declared(d);
  return left.empty() ? ""
                      : fmt::format(
                            "Not in it, for want of a key: {}. For identify it is a misfit, or "
                            "sigmas that are too small.",
                            listed(left, "and"));
}

/// The patched study, headed by what it holds where several causes remain possible, and by the
/// priors that are wider than those of the library. With the noise that was found, without which
/// its sigmas would not hold.
std::string patched_file(const mc::Study& study, const Diagnosis& d) {
  std::string out;
  for (const std::string& head : {patch_text(d), widened_text(d), undeclared_text(d)})
    out += as_comment(head);
  mc::Study there = study;
  if (d.field && d.field->another()) there.text = study_with_field(there, d.field->field_l);
  if (declares_noise(d)) there.text = study_with_noise(there, d.noise);
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  const bool has_room = beyond != nullptr && beyond->noise_beside;
  return out + (d.has_patch || has_room ? patched_study(there, d.patched) : there.text);
}

}  // namespace

/// What the page says in its headlines.
Section verdict(const Diagnosis& d) {
  const bool found = d.verdict != Verdict::consistent && !d.wrong_study();
  Sentences said{{headline(d)}, ""};
  if (const auto sentence = where_sentence(d.where, time_unit(d)); found && !sentence.empty())
    said.items.push_back("Where: " + sentence);
  if (const auto sentence = held_out_sentence(d.fit.held_out); found && !sentence.empty())
    said.items.push_back("Held out: " + sentence);
  return {"", {std::move(said)}, On::terminal};
}

Section kept_in_mind(const Diagnosis& d) {
  const auto remarks = remarks_of(d);
  if (remarks.empty()) return {};
  return {"To be kept in mind", {Sentences{remarks}}, On::page};
}

Table noise_table(const Diagnosis& d) {
  Table table("Noise against what is declared",
              "component=<component | factor=factor | factor_sigma= | value=value | unit=<unit | "
              "tau_s=tau [s] | log_likelihood_gain= | p_value=p | significant= | count= | <");
  for (const inference::NoiseFinding& n : d.noise) {
    const std::string said = !n.significant ? "as declared"
                             : n.component == "outliers"
                                 ? fmt::format("{} samples left out", n.count)
                                 : "not as declared";
    table.add({n.component, plus_minus(n.factor, n.factor_sigma), n.factor_sigma, n.value,
               text_or_nothing(n.unit), n.tau_s > 0.0 ? Cell(n.tau_s) : only_value({}),
               n.log_likelihood_gain, p_cell(n.p_value), n.significant, n.count,
               Cell(said, n.significant ? Tone::doubtful : Tone::plain)});
  }
  return table;
}

Section noise(const Diagnosis& d) {
  if (d.noise.empty()) return {};
  const bool told = std::ranges::any_of(d.noise, &inference::NoiseFinding::significant);
  return {"Noise", {noise_table(d)}, told ? On::both : On::page};
}

Section advice(const Diagnosis& d) {
  Section section{"Advice", {}};
  Sentences all{{}, "Advice: "};
  for (const Advice& a : d.advice) {
    all.items.push_back(advice_text(a));
    section.add({{Paragraph{advice_text(a)}, On::page}});
    if (a.plan.empty()) continue;
    Table table("Positions to add", "<name | <axes | dwell | <mode | <entry | case heading");
    for (const Position& p : a.plan)
      table.add({p.name, attitude_text(p), fmt::format("{:.0f} min", p.dwell / 60.0),
                 key_of(p.mode), key_of(p.entry),
                 p.case_heading ? fmt::format("{:.0f} deg", *p.case_heading / unit::deg.to_si)
                                : "chosen"});
    section.add({{table, On::page}, {Preformatted{planning::positions_toml(a.plan)}, On::page}});
  }
  section.add({{std::move(all), On::terminal}, {Sentences{remarks_of(d), "! "}, On::terminal}});
  return section;
}

std::string to_text(const Diagnosis& d) {
  return text_of(sections_of(d, diagnosis_sections));
}

Report diagnosis_report(const mc::Study& study, const Diagnosis& d, const DiagnosisSource& source) {
  mc::require_own_terms(study);
  Report report{.command = "diagnose"};
  report.title = study.title.empty() ? "Diagnosis" : study.title;
  report.subtitle = fmt::format("{} {}", verdict_word(d), fmt::join(source.recordings, ", "));
  report.brief = diagnosis_in_brief(d);
  report.headlines.push_back(sentence(d));
  if (!d.wrong_study())
    for (const auto& [head, sentence] : doubts_of(d)) report.headlines.push_back(sentence);
  if (d.verdict != Verdict::consistent && !d.wrong_study())
    for (const auto& sentence :
         {where_sentence(d.where, time_unit(d)), held_out_sentence(d.fit.held_out)})
      if (!sentence.empty()) report.headlines.push_back(sentence);
  if (d.proposal) report.headlines.push_back(form_sentence(*d.proposal));
  if (!d.advice.empty()) report.headlines.push_back(advice_text(d.advice.front()));
  report.add(sections_of(d, diagnosis_sections));
  report.add(source.more);
  report.add({origin(study, d, source)});
  Json document = diagnosis_document(d);
  add_tables(document, report.sections);
  report.document = {"diagnosis.json", dumped(document)};
  report.files = {{"residual_signal.csv", residual_signal_csv(d.signals, d.where.recordings)},
                  {"study.toml", study.text}};
  if (d.has_patch || declares_noise(d))
    report.files.emplace_back("patched.toml", patched_file(study, d));
  if (d.proposal) report.files.emplace_back("proposal.toml", d.proposal->text);
  if (!d.advice.empty() && !d.advice.front().plan.empty() && study.kind == RecordingKind::platform)
    report.files.push_back(extended_study_file("advised.toml", study, d.advice.front().plan));
  if (d.heading_doubt)
    report.files.push_back(
        study_file_with_positions("corrected.toml", study, d.heading_doubt->positions));
  report.footer = "Values stand with their units; ± is 1 sigma.";
  return source.provenance.version.empty() ? report
                                           : with_provenance(std::move(report), source.provenance);
}

std::vector<std::string> write_results(const mc::Study& study, const Diagnosis& d,
                                       const DiagnosisSource& source, const std::string& folder,
                                       const std::vector<TextFile>& beside) {
  const Report report = diagnosis_report(study, d, source);
  NewResults results({folder, report.command});
  add_report(results, report);
  for (const char* name : {"patched.toml", "advised.toml", "corrected.toml"})
    if (std::ranges::find(report.files, name, &TextFile::first) == report.files.end())
      results.remove(name);
  for (const auto& [name, text] : beside) results.add(name, text);
  return results.commit();
}

}  // namespace drift::report
