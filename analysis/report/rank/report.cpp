#include "analysis/report/rank/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/page/planned_study.hpp"
#include "analysis/report/page/study_section.hpp"
#include "analysis/report/rank/sections.hpp"
#include "core/base/results/new_results.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {
namespace {

constexpr const char* proposed_positions = "proposed_positions.toml";

/// "6 positions in 6.00 h; linearised at the means of [truth]; noise 5 ug, 5 arcsec".
std::string plan_line(const mc::Study& study, const planning::PlanRanking& rank) {
  std::vector<std::string> noise;
  if (study.readout.accelerometers)
    noise.push_back(
        fmt::format("accelerometers {} ug", number_text(study.readout.accelerometer_noise / 1e-6)));
  if (study.readout.gimbals)
    noise.push_back(fmt::format("gimbals {} arcsec",
                                number_text(study.readout.gimbal_noise / unit::arcsec.to_si)));
  const auto count = study.plan.positions.size();
  return fmt::format(
      "{} position{} in {:.2f} h{}; linearised at the means of {}; noise of a sample: {}", count,
      count == 1 ? "" : "s", rank.duration / 3600.0,
      study.plan.preset.empty() ? "" : fmt::format(" (preset {})", study.plan.preset),
      rank.at_truth ? "[truth]" : "the priors", fmt::join(noise, ", "));
}

std::string headline_of(const planning::RankingGroup& group, const planning::ModelRanking& m) {
  const observability::Ranking& r = m.ranking;
  const auto known =
      std::ranges::count_if(r.parameters, [](const auto& p) { return p.learning_ratio() < 0.5; });
  const auto better =
      std::ranges::count_if(r.spectrum, [](const auto& d) { return d.information > 1.0; });
  std::string text = fmt::format(
      "{} ({} {}): {:.1f} bits; {} of {} parameters end below half their prior sigma; {} "
      "directions are better known from the data than from the prior, {}.",
      key_of(m.model.spec.coupling), m.of_the_file() ? "filter" : "beside filter",
      m.of_the_file() ? m.filters : group.filters, r.bits, known, r.parameters.size(), better,
      unseen_text(r.unseen, r.root));
  if (r.unheld.size() > r.unseen.size())
    text += fmt::format(" {} more only because the attitude at the cagings has a prior.",
                        r.unheld.size() - r.unseen.size());
  return text;
}

}  // namespace

std::vector<std::string> of_the_last_sample(const planning::ModelRanking& m) {
  std::vector<std::string> keys;
  for (const std::size_t k : m.ranking.walking) keys.push_back(parameter_key(m.ranking.layout, k));
  return keys;
}

std::string walk_text(const planning::PlanRanking& rank) {
  std::vector<std::string> parts;
  for (const planning::RankingGroup& g : rank.groups)
    if (const auto keys = of_the_last_sample(g.models.front()); !keys.empty())
      parts.push_back(fmt::format("{} of {}", listed(keys, "and"), g.filters));
  if (parts.empty()) return "";
  return fmt::format("A drift that walks is that of the last sample, as the filter reports it: {}.",
                     fmt::join(parts, "; "));
}

std::string field_remark(const planning::PlanRanking& rank) {
  return field_assumed_text(*rank.assumed_field_l) +
         ". What the error of that field adds to sigmas is not in them.";
}

std::vector<std::string> headlines(const mc::Study& study, const planning::PlanRanking& rank) {
  std::vector<std::string> all;
  for (const planning::RankingGroup& g : rank.groups)
    for (const planning::ModelRanking& m : g.models) all.push_back(headline_of(g, m));
  if (rank.process_noise)
    all.push_back(
        "The process noise of a filter is in its sigmas, which are those of its covariance along "
        "the test.");
  if (const std::string walk = walk_text(rank); !walk.empty())
    all.push_back(walk + " Directions are of the drift that the test begins with.");
  if (rank.assumed_field_l) all.push_back(field_remark(rank));
  if (std::ranges::any_of(study.plan.positions,
                          [](const Position& p) { return p.mode == CommandLaw::free; }))
    all.push_back(
        "Free drift: the rank of the piecewise-constant problem holds for the same positions held "
        "level.");
  return all;
}

Report rank_report(const mc::Study& study, const planning::PlanRanking& rank,
                   const std::string& folder) {
  mc::require_own_terms(study);
  Report report{.command = "rank"};
  report.title = study.title.empty() ? "Observability ranking" : study.title;
  report.subtitle = plan_line(study, rank);
  report.headlines = headlines(study, rank);
  report.brief = rank_in_brief(study, rank, folder);
  Json document = rank_document(study, rank);
  // On a page what was asked for comes first, on a terminal last.
  const Section better = improvement(study, rank);
  report.add({{better.title, better.blocks, On::page}});
  for (std::size_t g = 0; g < rank.groups.size(); ++g) {
    const std::string suffix = rank.groups.size() > 1 ? fmt::format("_{}", g + 1) : "";
    const auto sections = sections_of(RankedGroup{study, rank.groups[g], suffix}, group_sections,
                                      rank.groups[g].filters);
    add_tables(document["filters"][g], sections);
    report.add(sections);
  }
  Blocks words = better.blocks;
  std::erase_if(words, [](const Block& b) { return std::holds_alternative<Figure>(b.content); });
  report.add({{"", std::move(words), On::terminal}, study_section(study)});
  report.footer = "Nothing is sampled: sigmas are Cramer-Rao bounds with the prior.";
  report.document = {"rank.json", dumped(document)};
  report.files.emplace_back("ranking.csv", ranking_csv(rank));
  if (rank.better && !rank.better->improvement.steps.empty())
    report.files.emplace_back(proposed_positions, proposed_toml(study, rank));
  if (study.text.empty()) return report;
  if (has_better_plan(rank))
    report.files.push_back(
        study_file_with_positions(improved_study, study, rank.better->improvement.plan.positions));
  report.files.emplace_back("study.toml", study.text);
  return report;
}

std::vector<std::string> write_ranking(const Report& report, const std::string& folder) {
  NewResults results({folder, report.command});
  add_report(results, report);
  for (const char* name : {proposed_positions, improved_study})
    if (std::ranges::find(report.files, name, &TextFile::first) == report.files.end())
      results.remove(name);
  return results.commit();
}

}  // namespace drift::report
