#include "analysis/report/strapdown/case_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/strapdown/case_misfit.hpp"
#include "core/base/words.hpp"

namespace drift::report {

using strapdown::CaseFit;
using strapdown::CaseIdentification;

std::string up_of(const strapdown::Dwell& dwell) {
  const Vec3 up = dwell.acc.normalized();
  return fmt::format("x {:.3f} y {:.3f} z {:.3f} deg above the horizon",
                     std::asin(up[0]) / unit::deg.to_si, std::asin(up[1]) / unit::deg.to_si,
                     std::asin(up[2]) / unit::deg.to_si);
}

strapdown::AxisHeading first_heading(const CaseIdentification& id) {
  return strapdown::axis_heading(id.study.search.dwells.front().acc,
                                 id.study.compass.azimuth.front());
}

/// What is said of North.
std::string azimuth_sentence(const CaseIdentification& id) {
  if (!id.study.compass.sees_earth && id.latitude)
    return fmt::format(
        "At {:.3f} deg, the latitude of the study, what the gyros read at rest is not the Earth's "
        "rate: the fit there takes every turn by itself, and North is not told",
        id.latitude->declared / unit::deg.to_si);
  if (!id.study.compass.sees_earth)
    return "The gyros do not see the Earth: of every turn it is told where up is before and after "
           "it, and North is not known";
  const double sigma = id.study.compass.sigma / unit::deg.to_si;
  const strapdown::AxisHeading heading = first_heading(id);
  return fmt::format(
      "The gyros see the Earth: North to {} deg (1 sigma), its rate taken from the latitude; in "
      "the first dwell the {} axis of the case points {} deg from North, to East",
      number_text(sigma, 2), "xyz"[heading.axis],
      to_match(heading.azimuth / unit::deg.to_si, sigma));
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

std::string_view instrument_name(strapdown::Instrument of) {
  switch (of) {
    case strapdown::Instrument::gravity:
      return "gravity in dwells";
    case strapdown::Instrument::direction:
      return "up in dwells";
    case strapdown::Instrument::gyros:
      return "gyros at rest";
    case strapdown::Instrument::read_in_turn:
      break;
  }
  return "accelerometers in turns";
}

std::string instrument_text(const strapdown::InstrumentFit& fit) {
  using strapdown::Instrument;
  const std::string_view what =
      fit.of == Instrument::gravity     ? "the accelerometers' parameters (K0, K1, dP, dO ...)"
      : fit.of == Instrument::direction ? "what turns tell (s, eta, xi ...)"
      : fit.of == Instrument::gyros     ? "the gyros' drift (D_F, D_I ...)"
                                        : "what accelerometers tell in turns (arm, acc_delay)";
  return fmt::format(
      "{} {} more than noise, chi-square per degree of freedom {} of {} (chance {}): sigmas of {} "
      "are about {} times too small. `diagnose` looks for the noise",
      instrument_name(fit.of),
      fit.of == Instrument::gravity || fit.of == Instrument::direction ? "scatters" : "scatter",
      number_text(fit.per_dof(), 3), number_text(fit.dof, 2), p_text(fit.chance()), what,
      number_text(fit.factor(), 2));
}

namespace {

/// "x", or "x and y and 3 more".
std::string some_of(const std::vector<std::string>& all) {
  constexpr std::size_t most = 6;
  if (all.size() <= most) return fmt::format("{}", fmt::join(all, ", "));
  return fmt::format("{} and {} more", fmt::join(all.begin(), all.begin() + most, ", "),
                     all.size() - most);
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

}  // namespace

InBrief case_in_brief(const CaseIdentification& id) {
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
  brief.tone =
      id.latitude || misfit == CaseMisfit::of_model || misfit == CaseMisfit::of_gravity ? Tone::bad
      : gravity || misfit == CaseMisfit::of_priors || !id.study.saturated.empty() ? Tone::doubtful
                                                                                  : Tone::good;
  if (!id.study.saturated.empty())
    brief.more.add(Weight::wrong, "Range: " + id.study.saturated + ".");
  if (gravity) brief.more.add(Weight::wrong, "Gravity: " + common_scale_text(*gravity));
  // Where everything misfits that is said, and none of it is believed.
  if (!id.latitude && misfit != CaseMisfit::of_model)
    for (const strapdown::InstrumentFit& fit : first.instruments)
      if (strapdown::too_large(fit, first.instruments))
        brief.more.add(Weight::doubtful, "Sigmas: " + instrument_text(fit) + ".");
  brief.more.add(Weight::note, azimuth_sentence(id) + ".");
  if (at_rest) brief.more.add(Weight::note, "Up is " + up_of(dwells.front()) + ".");
  if (std::isfinite(id.eq5_gain)) brief.more.add(Weight::note, contest_sentence(id) + ".");
  if (const std::string errors = errors_sentence(first); !errors.empty())
    brief.more.add(Weight::note, errors);
  std::vector<std::string> unseen;
  for (const auto& u : first.unobservable) unseen.push_back(u.what);
  if (!unseen.empty())
    brief.more.add(Weight::note, fmt::format("{} this recording shows little of {}.",
                                             id.latitude && !id.study.compass.sees_earth
                                                 ? "As it is fitted at the latitude of the study,"
                                                 : "Alone",
                                             some_of(unseen)));
  brief.next = case_next(id, misfit);
  return brief;
}

}  // namespace drift::report
