#include "analysis/report/strapdown/case_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/strapdown/case_misfit.hpp"
#include "core/base/words.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {

using strapdown::CaseFit;
using strapdown::CaseIdentification;

DRIFT_SECTIONS(CaseIdentification, case_sections, (case_test, details), (case_parameters, evidence),
               (case_unobservable, how_sure), (case_held_out, how_sure), (case_noise, how_sure));

namespace {

std::string up_of(const strapdown::Dwell& dwell) {
  const Vec3 up = dwell.acc.normalized();
  return fmt::format("x {:.3f} y {:.3f} z {:.3f} deg above the horizon",
                     std::asin(up[0]) / unit::deg.to_si, std::asin(up[1]) / unit::deg.to_si,
                     std::asin(up[2]) / unit::deg.to_si);
}

/// What is said of North.
std::string azimuth_sentence(const CaseIdentification& id) {
  if (!id.study.compass.sees_earth)
    return "The gyros do not see the Earth: of every turn it is told where up is before and after "
           "it, and North is not known";
  return fmt::format(
      "The gyros see the Earth: North to {} deg (1 sigma), its rate taken from the latitude",
      number_text(id.study.compass.sigma / unit::deg.to_si, 2));
}

std::string estimates_csv(const CaseIdentification& id) {
  std::string out = "filter,parameter,unit,estimate,sigma,note\n";
  for (const CaseFit& fit : id.fits)
    for (const auto& p : fit.parameters)
      out += fmt::format("{},{},{},{},{},{}\n", csv_field(fit.name), csv_field(p.key),
                         csv_field(p.unit), p.value, p.sigma, csv_field(p.note));
  return out;
}

/// Length and noise of a row at rest.
std::string noise_sentence(const strapdown::CaseStudy& s) {
  const std::string row = number_text(s.test.row, 3),
                    acc = number_text(s.test.readout.accelerometer_noise / unit::ug.to_si, 3),
                    gyro = number_text(s.test.readout.gimbal_noise / unit::deg_per_h.to_si, 3);
  return s.compass.sees_earth
             ? fmt::format(
                   "in dwells rows of {} s: accelerometers {} ug, gyros {} deg/h (1 sigma, "
                   "from their scatter)",
                   row, acc, gyro)
             : fmt::format(
                   "halves of dwells of {} s: accelerometers {} ug; gyros, once in each "
                   "dwell, {} deg/h (1 sigma, from how halves differ, and for the unknown "
                   "North)",
                   row, acc, gyro);
}

/// Dwells that are none to the gyros; empty: all are.
std::string rest_sentence(const CaseIdentification& id) {
  const auto held = std::ranges::count(id.study.test.still, false);
  if (held == 0) return "";
  return fmt::format(
      "in {} of the dwells the unit did not stand still (its gyros scatter more than in the "
      "others, "
      "or its halves differ): there the gyros carry the attitude and gravity alone is measured",
      held);
}

/// "x", or "x and y and 3 more".
std::string some_of(const std::vector<std::string>& all) {
  constexpr std::size_t most = 6;
  if (all.size() <= most) return fmt::format("{}", fmt::join(all, ", "));
  return fmt::format("{} and {} more", fmt::join(all.begin(), all.begin() + most, ", "),
                     all.size() - most);
}

std::string counted(std::size_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string contest_sentence(const CaseIdentification& id) {
  std::vector<std::string> errors;
  for (const CaseFit& fit : id.fits)
    errors.push_back(fmt::format("eq. ({}) {} deg", facts(fit.equation).number,
                                 number_text(fit.up.held_out, 4)));
  return fmt::format("Held-out turns: {} ({:.1f} standard errors in favour of eq. ({}))",
                     fmt::join(errors, ", "), std::abs(id.eq5_gain), id.eq5_gain > 0.0 ? 5 : 6);
}

/// Of the filter without what was held out; of data that no fit could predict nothing.
std::string errors_sentence(const CaseFit& fit) {
  const bool up = fit.up.count > 0 && std::isfinite(fit.up.held_out),
             gyro = fit.up.count > 0 && std::isfinite(fit.gyro.held_out);
  return fmt::format("{}{}{}",
                     up ? fmt::format("Up after a turn that was held out: {} deg off",
                                      number_text(fit.up.held_out, 3))
                        : "",
                     gyro ? fmt::format("{}yros in dwells held out: {} deg/h", up ? "; g" : "G",
                                        number_text(fit.gyro.held_out, 3))
                          : "",
                     up || gyro ? "." : "");
}

/// " (16 more are left out for gaps)"; empty: none is.
std::string gaps_text(const strapdown::CaseStudy& s) {
  const std::size_t n = s.test.ways_with_gap;
  return n == 0 ? "" : fmt::format(" ({} more {} left out for gaps)", n, n == 1 ? "is" : "are");
}

InBrief in_brief(const CaseIdentification& id) {
  const CaseFit& first = id.fits.front();
  const EstimateResult& estimate = first.fit.estimate;
  const std::size_t all = estimate.parameters.size();
  const auto alone = static_cast<std::size_t>(std::ranges::count_if(
      first.parameters, [](const auto& p) { return TermLibrary::find(p.key).has_value(); }));
  const std::size_t sums = first.parameters.size() - alone;
  const std::string told =
      fmt::format("{} of {} parameters {} learned{}", alone, all, alone == 1 ? "is" : "are",
                  sums > 0 ? fmt::format(", and {} of others", counted(sums, "sum")) : "");
  const auto& dwells = id.study.search.dwells;
  const bool at_rest = dwells.size() == 1;
  InBrief brief;
  const std::string fits = fmt::format("chi-square per degree of freedom {}",
                                       number_text(estimate.statistic_per_dof(), 3));
  const CaseMisfit misfit = misfit_of(id);
  if (id.latitude)
    brief.verdict = fmt::format(
        "Wrong latitude{}: the gyros at rest see the Earth as it turns at {}, not at {:.3f} deg; "
        "there chi-square per degree of freedom is {} instead of {}. Correct it first.{}",
        id.latitude->alone() ? "" : " and more", latitude_text(*id.latitude),
        id.latitude->declared / unit::deg.to_si, number_text(id.latitude->chi2_per_dof_after, 3),
        number_text(id.latitude->chi2_per_dof_before, 3), upside_down_text(*id.latitude));
  else if (misfit != CaseMisfit::none)
    brief.verdict = case_misfit_text(id, misfit);
  else if (at_rest)
    brief.verdict = fmt::format("Found: one rest of {:.0f} s and no turn; {}.",
                                dwells.front().duration(), told);
  else
    brief.verdict =
        fmt::format("Found: {} and {}{}; {}, {}.", counted(dwells.size(), "dwell"),
                    counted(id.study.test.ways.size(), "turn"), gaps_text(id.study), told, fits);
  const auto gravity = gravity_off(id);
  brief.tone = id.latitude || misfit == CaseMisfit::of_model || misfit == CaseMisfit::of_gravity
                   ? Tone::bad
               : gravity || misfit == CaseMisfit::of_priors ? Tone::doubtful
                                                            : Tone::good;
  if (gravity) brief.more.add(Weight::wrong, "Gravity: " + common_scale_text(*gravity));
  brief.more.add(Weight::note, azimuth_sentence(id) + ".");
  if (at_rest) brief.more.add(Weight::note, "Up is " + up_of(dwells.front()) + ".");
  if (std::isfinite(id.eq5_gain)) brief.more.add(Weight::note, contest_sentence(id) + ".");
  if (const std::string errors = errors_sentence(first); !errors.empty())
    brief.more.add(Weight::note, errors);
  std::vector<std::string> unseen;
  for (const auto& u : first.unobservable) unseen.push_back(u.what);
  if (!unseen.empty())
    brief.more.add(Weight::note,
                   fmt::format("Alone this recording shows little of {}.", some_of(unseen)));
  brief.next = case_next(id, misfit);
  return brief;
}

}  // namespace

Section case_test(const CaseIdentification& id) {
  const auto& s = id.study;
  std::vector<std::string> found{
      fmt::format("{}, {} between them{}", counted(s.search.dwells.size(), "dwell"),
                  counted(s.test.ways.size(), "turn"),
                  s.test.ways_with_gap > 0
                      ? fmt::format(", {} left out for gaps", s.test.ways_with_gap)
                      : ""),
      noise_sentence(s),
      rest_sentence(id),
      azimuth_sentence(id),
      "in the first dwell up is " + up_of(s.search.dwells.front()),
      "the axes of the case are those of the accelerometers: dP_x, dO_x and dP_y are zero",
      ("not in the model: lever arms of the accelerometers and a delay between them and the gyros; "
       "the accelerometers are read in dwells alone, where neither shows")};
  std::erase(found, "");
  return {"Dwells and turns", {Sentences{std::move(found), ""}}};
}

Section case_parameters(const CaseIdentification& id) {
  Section section{"Parameters", {}};
  for (const CaseFit& fit : id.fits) {
    Table t(fmt::format("{} ({})", fit.name, key_of(fit.equation)),
            "<key | value | sigma | <unit | <");
    for (const auto& p : fit.parameters)
      t.add({p.key, digits(p.value, 6), p.sigma, p.unit, p.note});
    section.blocks.emplace_back(std::move(t));
  }
  return section;
}

Section case_unobservable(const CaseIdentification& id) {
  Section section{"Not observable", {}};
  for (const CaseFit& fit : id.fits) {
    if (fit.unobservable.empty()) continue;
    Table t(fmt::format("{}: of which the prior says more than this recording", fit.name),
            "<what | <why");
    for (const auto& u : fit.unobservable) t.add({u.what, u.reason});
    section.blocks.emplace_back(std::move(t));
  }
  return section;
}

Section case_held_out(const CaseIdentification& id) {
  if (id.division.folds == 0) return {};
  Table t(fmt::format(
              "Root mean square errors on the data of the fit, and on dwells held out of it "
              "({} parts{})",
              id.division.folds,
              id.division.repeats > 1 ? fmt::format(", {} divisions", id.division.repeats) : ""),
          "<filter | <eq | up after a turn [deg] | held out | gyros [deg/h] | held out | gravity "
          "[ug] | held out");
  for (const CaseFit& fit : id.fits)
    t.add({fit.name, std::string(key_of(fit.equation)), fit.up.in_sample, fit.up.held_out,
           fit.gyro.in_sample, fit.gyro.held_out, fit.gravity.in_sample / unit::ug.to_si,
           fit.gravity.held_out / unit::ug.to_si});
  Section section{"Held out", {t}};
  if (std::isfinite(id.eq5_gain))
    section.blocks.emplace_back(Sentences{{contest_sentence(id)}, ""});
  return section;
}

Section case_noise(const CaseIdentification& id) {
  return noise_section(id.study.noise, id.study.test.timeline.site.gravity);
}

Report case_report(const mc::Study& study, const CaseIdentification& id) {
  mc::require_own_terms(study);
  Report report{.command = "identify"};
  report.title = study.title.empty() ? "Strapdown recording" : study.title;
  report.subtitle = fmt::format("Strapdown recording {}", id.study.source);
  report.brief = in_brief(id);
  report.add(sections_of(id, case_sections));
  Json document = to_json(id, study.site.gravity);
  add_tables(document, report.sections);
  report.document = {"identification.json", document.dump(2) + "\n"};
  report.files.emplace_back("study.toml", study.text);
  report.files.emplace_back("estimates.csv", estimates_csv(id));
  return report;
}

}  // namespace drift::report
