#include "analysis/report/strapdown/case_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/report/identify/results_out.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/strapdown/case_words.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "core/base/words.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {

using strapdown::CaseFit;
using strapdown::CaseIdentification;

DRIFT_SECTIONS(CaseIdentification, case_sections, (case_test, details), (case_parameters, evidence),
               (case_unobservable, how_sure), (case_instruments, how_sure),
               (case_held_out, how_sure), (case_noise, how_sure));

namespace {

std::string estimates_csv(const CaseIdentification& id) {
  std::string out = "filter,parameter,unit,estimate,sigma,note\n";
  for (const CaseFit& fit : id.fits)
    for (const auto& p : fit.parameters)
      out += fmt::format("{},{},{},{},{},{}\n", csv_field(fit.name), csv_field(p.key),
                         csv_field(p.unit), p.value, p.sigma, csv_field(p.note));
  return out;
}

/// Of all parameters of each filter, as the sensors have them.
std::string covariance_csv(const CaseIdentification& id) {
  std::string out(covariance_header);
  for (const CaseFit& fit : id.fits) {
    EstimateResult sensed = strapdown::as_sensed(fit.fit.estimate);
    if (!id.study.compass.sees_earth) sensed = strapdown::without_common_drift(std::move(sensed));
    out += covariance_rows(fmt::format("{},{},1,batch", csv_field(fit.name), key_of(fit.equation)),
                           sensed);
  }
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

Section case_instruments(const CaseIdentification& id) {
  Section section{"Chi-square by instrument", {}};
  Table t(
      "Of what each fit leaves: gravity and gyros by dwell, up in dwells as turns carry it",
      "<filter | <instrument | chi-square per degree of freedom | degrees | chance of so much | "
      "sigmas too small by");
  for (const CaseFit& fit : id.fits)
    for (const auto& one : fit.instruments) {
      const bool large = too_large(one, fit.instruments);
      t.add({fit.name, instrument_name(one.of),
             digits(one.per_dof(), 3, large ? Tone::doubtful : Tone::plain), digits(one.dof, 3),
             p_cell(one.chance()), large ? digits(one.factor(), 2) : Cell("-")});
    }
  if (!id.fits.empty() && !id.fits.front().instruments.empty()) section.blocks.emplace_back(t);
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
  report.brief = case_in_brief(id);
  report.add(sections_of(id, case_sections));
  Json document = to_json(id, study.site.gravity);
  add_tables(document, report.sections);
  report.document = {"identification.json", document.dump(2) + "\n"};
  report.files.emplace_back("study.toml", study.text);
  report.files.emplace_back("estimates.csv", estimates_csv(id));
  report.files.emplace_back("covariance.csv", covariance_csv(id));
  return report;
}

}  // namespace drift::report
