#include "analysis/report/strapdown/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/svg/bar_chart.hpp"

namespace drift::report {

using strapdown::Score;
using strapdown::StrapdownResult;
using strapdown::Trial;

DRIFT_SECTIONS(StrapdownResult, strapdown_sections, dwells, accelerometers, gyros, parameters,
               unobservable, noise);
inline constexpr Part strapdown_parts[] = {Part::details,  Part::how_sure, Part::evidence,
                                           Part::evidence, Part::how_sure, Part::how_sure};

namespace {

constexpr std::string_view score_columns = "in | held out | <95 % | z";

/// In sample, held out with its interval, and the gain in standard errors.
void add_score(std::vector<Cell>& row, const std::optional<Score>& score, double z) {
  if (score)
    row.insert(row.end(), {score->in_sample, score->held_out, span_cell(score->low, score->high)});
  else
    row.insert(row.end(), 3, "");
  row.push_back(decimals(z, 1));
}

/// Why each trial ended as it did, numbered as in the table above.
Sentences reasons(const std::vector<Trial>& trials) {
  Sentences all{{}, ""};
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (!trials[k].reason.empty())
      all.items.push_back(fmt::format("{} {} against '{}': {}", k + 1,
                                      strapdown::name_of(trials[k].verdict), trials[k].against,
                                      trials[k].reason));
  return all;
}

std::string rotations_picture(const StrapdownResult& result) {
  BarChart chart;
  chart.title = "Gravity prediction after held-out rotations";
  chart.x_label = "root mean square error [deg], bars: 95 % bootstrap";
  for (const Trial& trial : result.gyro_trials)
    if (trial.rotation) {
      const Score& score = *trial.rotation;
      const std::size_t colour = trial.equation == "eq6" ? 1 : (trial.equation == "eq5" ? 0 : 2);
      chart.bars.push_back({trial.name + " (" + trial.equation + ")", score.held_out, score.low,
                            score.high, colour});
    }
  return svg_of(chart);
}

std::string contest_sentence(const strapdown::EquationContest& c) {
  return fmt::format(
      "Held-out turns: eq. (5) {:.4g} deg, eq. (6) {:.4g} deg ({:.1f} standard errors {})",
      c.eq5.held_out, c.eq6.held_out, std::abs(c.z),
      c.z > 0.0 ? "in favour of eq. (5)" : (c.z < 0.0 ? "in favour of eq. (6)" : "apart"));
}

/// "bias + scale (6 parameters): held-out error 1.01 -> 0.0392 m/s^2", from the first trial on.
std::string accepted_sentence(std::string_view sensors, const std::vector<Trial>& trials,
                              std::string_view accepted, std::optional<Score> Trial::*score,
                              std::string_view unit) {
  const auto chosen = std::ranges::find(trials, accepted, &Trial::name);
  if (chosen == trials.end() || !((*chosen).*score) || !(trials.front().*score)) return "";
  return fmt::format("{}: {} ({} parameters); held-out error {} → {} {}.", sensors, accepted,
                     chosen->parameters, number_text((trials.front().*score)->held_out),
                     number_text(((*chosen).*score)->held_out), unit);
}

/// The last that was accepted.
std::string_view accepted_of(const std::vector<Trial>& trials) {
  std::string_view name;
  for (const Trial& t : trials)
    if (t.verdict == strapdown::Verdict::accepted) name = t.name;
  return name;
}

InBrief in_brief(const StrapdownResult& r) {
  InBrief brief;
  brief.verdict = fmt::format("Found: {} dwells, {} turns, {} parameters{}", r.search.dwells.size(),
                              r.rotations, r.parameters.size(), r.contest.empty() ? "." : "; ");
  if (!r.contest.empty()) brief.verdict += contest_sentence(r.contest.front()) + ".";
  brief.tone = Tone::good;
  brief.more = {accepted_sentence("Accelerometers", r.accelerometer_trials,
                                  accepted_of(r.accelerometer_trials), &Trial::gravity, "m/s^2"),
                accepted_sentence("Gyros", r.gyro_trials, r.accepted.front().name, &Trial::rotation,
                                  "deg after a turn")};
  std::vector<std::string> unseen;
  for (const auto& u : r.unobservable) unseen.push_back(u.what);
  if (!unseen.empty())
    brief.more.push_back(fmt::format("Not observable here: {}.", fmt::join(unseen, "; ")));
  std::erase(brief.more, "");
  brief.next = "Next: driftscope diagnose, on the same study and recording, says what is missing.";
  return brief;
}

}  // namespace

Section dwells(const StrapdownResult& r) {
  std::vector<double> lengths;
  for (const auto& d : r.search.dwells) lengths.push_back(d.duration());
  std::ranges::sort(lengths);
  std::string found = fmt::format(
      "{} dwells of {} s or more: first {:.1f} s, median {:.1f} s; {} turns between them",
      lengths.size(), r.options.static_min, r.search.dwells.front().duration(),
      lengths[lengths.size() / 2], r.rotations);
  if (r.rotations_omitted > 0) found += fmt::format(", {} left out for gaps", r.rotations_omitted);
  return {"Dwells and turns",
          {Sentences{{found, fmt::format("quiet: gyro spread below {:.3g} deg/s (at rest {:.3g}), "
                                         "accelerometer spread below {:.3g} m/s^2 (at rest {:.3g})",
                                         r.search.gyro_threshold / unit::deg_per_s.to_si,
                                         r.search.gyro_floor / unit::deg_per_s.to_si,
                                         r.search.acc_threshold * r.options.gravity,
                                         r.search.acc_floor * r.options.gravity)},
                     ""}}};
}

Section accelerometers(const StrapdownResult& r) {
  Table t("Accelerometers: |f| - g in dwells [m/s^2], root mean square; z: gain in standard errors",
          fmt::format("# | <model | par | {} | <verdict", score_columns));
  for (const Trial& trial : r.accelerometer_trials) {
    std::vector<Cell> row{t.rows.size() + 1, trial.name, trial.parameters};
    add_score(row, trial.gravity, trial.z_dwell);
    row.emplace_back(strapdown::name_of(trial.verdict));
    t.add(std::move(row));
  }
  return {"Accelerometers", {t, reasons(r.accelerometer_trials)}};
}

Section gyros(const StrapdownResult& r) {
  Table t("Gyros: w_g - w_l in dwells [deg/s], then up after a turn [deg], root mean square",
          fmt::format("# | <model | <eq | par | {0} | {0} | <verdict", score_columns));
  for (const Trial& trial : r.gyro_trials) {
    std::vector<Cell> row{t.rows.size() + 1, trial.name, trial.equation, trial.parameters};
    add_score(row, trial.dwell, trial.z_dwell);
    add_score(row, trial.rotation, trial.z_rotation);
    row.emplace_back(strapdown::name_of(trial.verdict));
    t.add(std::move(row));
  }
  return {"Gyros",
          {Figure{rotations_picture(r), "Lower is better; held out of the fit.", "rotations.svg"},
           t, reasons(r.gyro_trials)}};
}

Section parameters(const StrapdownResult& r) {
  Table t(fmt::format("Parameters of '{}'", r.accepted.front().name),
          "<key | value | sigma | <unit | <");
  for (const auto& p : r.parameters) t.add({p.key, digits(p.value, 6), p.sigma, p.unit, p.note});
  return {"Parameters", {t}};
}

Section unobservable(const StrapdownResult& r) {
  Table t("Not observable in this recording", "<what | <why");
  for (const auto& u : r.unobservable) t.add({u.what, u.reason});
  return {"Not observable", {t}};
}

Section noise(const StrapdownResult& r) {
  return noise_section(r.noise, r.options.gravity);
}

Report strapdown_report(const mc::Study& study, const StrapdownResult& result) {
  Report report{.command = "identify"};
  report.title = study.title.empty() ? "Strapdown recording" : study.title;
  report.subtitle = fmt::format("Strapdown recording {}", result.source);
  for (const auto& c : result.contest) report.headlines.push_back(contest_sentence(c) + ".");
  report.brief = in_brief(result);
  report.add(sections_of(result, strapdown_sections, strapdown_parts));
  report.document = {"identification.json", to_json(result).dump(2) + "\n"};
  report.files.emplace_back("study.toml", study.text);
  report.files.emplace_back("estimates.csv", estimates_csv(result));
  return report;
}

}  // namespace drift::report
