#include "analysis/report/blind/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/blind/sections.hpp"
#include "analysis/report/blind/target_words.hpp"

namespace drift::report {
namespace {

/// "0.950 [0.888, 0.984] of 99"; "-" of nothing.
std::string text_of(const stats::Proportion& p) {
  return p.n == 0 ? "-"
                  : fmt::format("{:.3f} [{:.3f}, {:.3f}] of {}", p.share(), p.low, p.high, p.n);
}

std::string standing_text(const std::vector<blind::Target>& targets) {
  const auto count = [&](blind::Standing s) {
    return std::ranges::count(targets, s, &blind::Target::standing);
  };
  return fmt::format(
      "Of {} targets {} are met and {} missed with their whole intervals, {} met and {} missed "
      "within their intervals, {} not decided.",
      targets.size(), count(blind::Standing::met), count(blind::Standing::missed),
      count(blind::Standing::met_within), count(blind::Standing::missed_within),
      count(blind::Standing::not_decided));
}

/// How every target stands, the missed ones first; the table has their intervals.
InBrief brief_of(const blind::Summary& s) {
  const auto of = [&](blind::Standing standing) {
    return static_cast<std::size_t>(
        std::ranges::count(s.targets, standing, &blind::Target::standing));
  };
  const bool decided = 2 * of(blind::Standing::not_decided) < s.targets.size();
  InBrief brief{.verdict = standings_text(s), .more = targets_in_brief(s.targets)};
  brief.tone = of(blind::Standing::missed) > 0 ? Tone::bad
               : decided && s.failed == 0      ? Tone::good
                                               : Tone::doubtful;
  if (!decided)
    brief.next = "Next: more trials (--trials, or configs/blind.toml) decide the targets.";
  return brief;
}

}  // namespace

Report blind_report(const BlindResults& results) {
  const blind::Summary& s = results.summary;
  Report report{.command = "blind"};
  report.title = results.title.empty() ? "Blind study" : results.title;
  report.subtitle = "Recordings with concealed effects, diagnosed without the key";
  report.headlines = {
      fmt::format("{} trials, {} of them without an answer. {}", s.trials, s.failed,
                  standing_text(s.targets)),
      fmt::format("The nominal fit looks healthy (chi-square inside its 95 % band) in {} effect "
                  "trials, and its worst parameter is off by {} of its sigmas (median).",
                  text_of(s.concealed), number_text(s.largest_bias_median)),
      fmt::format(
          "Key sealed before any diagnosis: SHA-256 {}; answers before the key was opened: {}.",
          results.key_hash, results.answers_hash)};
  report.order = Order::headlines_last;
  report.brief = brief_of(s);
  report.add(sections_of(results, blind_sections));
  Json document = blind_document(results);
  if (!results.rivals.empty()) document["rivals"] = rows_json(rivals_table(results));
  add_tables(document, report.sections);
  report.document = {"blind.json", dumped(document)};
  return report;
}

}  // namespace drift::report
