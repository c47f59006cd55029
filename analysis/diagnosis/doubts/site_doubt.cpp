#include "analysis/diagnosis/doubts/site_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/diagnosis/doubts/unknown_field.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::diagnosis {
namespace {

using inference::SiteLimits;

constexpr auto d_lat = TermLibrary::index("d_lat");

/// Whether a fit of the nominal model, at another latitude or with other times, leaves no more than
/// that with the causes does, but for what so many parameters take by chance.
bool leaves_as_little(double chi2_per_dof, const Diagnosis& d) {
  const auto parameters = static_cast<double>((d.patched.active & ~d.nominal.active).count());
  return (chi2_per_dof - d.fit.chi2_per_dof_after) * static_cast<double>(d.fit.dof) <
         parameters + inference::FitLimits::misfit * std::sqrt(2.0 * parameters);
}

/// Whether an amplitude of a cause is of no size that its prior knows (6e-7): its evidence is that
/// of a size as found. latitude_error of so many sizes is another latitude.
bool has_no_usual_size(const search::Cause& cause) {
  return std::ranges::any_of(cause.parameters, [](const search::CauseParameter& p) {
    return !p.profiled && std::abs(p.prior_sigmas) > inference::FitLimits::beyond_prior;
  });
}

/// Under which noise explanations of a test on a case were weighed.
enum class CaseNoise { declared, found };

/// Log odds of another latitude, or of other times, against the effects that were found: one study
/// of 1000 says another latitude, and one recording other times; of the effects of the library one
/// is as likely as another. Infinite where none was found. Latitudes and times are weighed under
/// the noise of the better fit: on a case that is as the rows scatter, which is declared, and so
/// are causes unless those were weighed under the noise that was found, too; of a platform under
/// the noise that was found with them, which may drive it.
double log_odds(double log_evidence, const Diagnosis& d,
                CaseNoise noise_of_case = CaseNoise::declared) {
  std::size_t visible = 0;
  for (const search::CandidateScore& c : d.candidates) visible += c.dof > 0 ? 1 : 0;
  const double one_effect = std::log(inference::PosteriorPrior::library /
                                     static_cast<double>(std::max<std::size_t>(1, visible)));
  double best = -std::numeric_limits<double>::infinity();
  for (const search::Cause& c : d.causes) {
    const auto together = std::ranges::count(d.causes, c.set, &search::Cause::set);
    const bool declared = d.of_case && noise_of_case == CaseNoise::declared;
    const double log_bayes = declared ? c.log_bayes_as_declared : c.log_bayes;
    best = std::max(best, log_bayes + static_cast<double>(together) * one_effect);
  }
  return log_evidence + std::log(SiteLimits::another) - best;
}

bool worth_asking(const Diagnosis& d) {
  if (d.verdict == Verdict::unexplained) return true;
  // Parameters far outside their priors may hide it: Earth rate about Up is isotropic D_I.
  if (const auto* beyond = remark_in<remark::BeyondPrior>(d);
      beyond && beyond->farthest().sigmas > inference::FitLimits::beyond_prior)
    return true;
  if (d.verdict == Verdict::consistent) return d.fit.chi2_per_dof_before > d.fit.band_high;
  double top = 0.0, own = 0.0, size = 0.0;
  for (const search::CandidateScore& c : d.candidates) {
    top = std::max(top, c.score);
    if (c.term != "latitude_error") continue;
    own = c.score;
    size = c.size_sigma;
  }
  return own > SiteLimits::worth_asking * top && size > SiteLimits::survey;
}

/// Whether nothing is said to be missing but because priors would be wrong: those of three D_I at
/// once are Earth rate, and an effect beside another latitude may hide below them.
bool rests_on_wrong_priors(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  return d.verdict == Verdict::consistent && beyond && beyond->explains;
}

/// The patched model with the causes of usual sizes alone: what another latitude has beside it.
FilterSpec without_unusual(const Diagnosis& d) {
  FilterSpec filter = d.patched;
  for (const search::Cause& cause : d.causes)
    if (has_no_usual_size(cause))
      for (const search::CauseParameter& p : cause.parameters)
        if (!d.nominal.active[p.param]) filter.active.reset(p.param);
  return filter;
}

/// Diagnosed at about the latitude that the recording is of, the rest of its error with the other
/// parameters: what is there beside it bends what is found of it alone. Nothing unless that
/// explains the test with effects of sizes that their priors know.
std::optional<SiteFinding> with_effects(const mc::Study& study,
                                        const std::vector<Recording>& recordings,
                                        const Diagnosis& d, identification::LatitudeDoubt about,
                                        const DiagnoseOptions& options) {
  mc::Study there = study;
  there.site.latitude = about.latitude;
  FilterSpec& filter = there.filters.front() = d.nominal;
  filter.active.set(d_lat);
  filter.priors[d_lat] = normal(0.0, SiteLimits::bent_deg * unit::deg.to_si);
  auto found = std::make_shared<Diagnosis>(
      with_error_of_field(diagnose(there, recordings, options), there, recordings, options));
  if (found->verdict == Verdict::unexplained ||
      std::ranges::any_of(found->causes, has_no_usual_size))
    return std::nullopt;
  const FilterSpec& model = found->has_patch ? found->patched : found->nominal;
  const preparation::RecordedTest test = preparation::recorded_test(there, recordings);
  const EstimateResult fit =
      fit_batch(model, {test.timeline, there.readout, test.measured}, make_layout(model).theta)
          .estimate;
  const ParameterEstimate* rest = fit.find(d_lat);
  if (rest == nullptr) return std::nullopt;
  about.latitude =
      std::clamp(about.latitude + rest->value, -90.0 * detail::deg, 90.0 * detail::deg);
  about.sigma = rest->sigma;
  about.chi2_per_dof_before = d.fit.chi2_per_dof_before;
  about.chi2_per_dof_after = fit.statistic_per_dof();
  about.chance_after = found->p_value;
  if (about.prior_sigmas() <= SiteLimits::survey) return std::nullopt;
  return SiteFinding{about, std::move(found)};
}

}  // namespace

identification::LatitudeDoubt against_causes(identification::LatitudeDoubt doubt,
                                             const Diagnosis& d) {
  if (d.causes.empty()) return doubt;
  doubt.as_little_left = leaves_as_little(doubt.chi2_per_dof_after, d);
  if (!doubt.alone()) return doubt;
  doubt.odds = std::exp(log_odds(doubt.log_evidence, d));
  doubt.less_likely = doubt.odds <= 1.0 && std::ranges::none_of(d.causes, has_no_usual_size);
  return doubt;
}

SiteFinding site_doubt(const mc::Study& study, const std::vector<Recording>& recordings,
                       const Diagnosis& d, const DiagnoseOptions& options) {
  if (d.nominal.active[d_lat]) return {};
  // With the causes in the model, latitude_error among them, nothing would be left to ask for: the
  // latitude competes with them where it leaves nothing either.
  const bool unusual = std::ranges::any_of(d.causes, has_no_usual_size);
  const bool worth = worth_asking(d);
  const auto reach = unusual || worth ? identification::Reach::everywhere
                                      : identification::Reach::where_it_promises;
  auto alone = !d.causes.empty() || worth
                   ? identification::latitude_doubt(study, recordings, d.nominal, reach)
                   : std::nullopt;
  if (alone) {
    alone = against_causes(*alone, d);
    if (alone->alone()) return {alone, nullptr};
  }
  if (unusual || d.verdict == Verdict::unexplained || rests_on_wrong_priors(d)) {
    auto about = alone;
    if (!about && unusual)
      about = identification::latitude_doubt(study, recordings, without_unusual(d));
    if (about && !about->clock)
      if (auto more = with_effects(study, recordings, d, *about, options)) return *more;
  }
  if (!worth) return {};
  if (!d.has_patch) return {alone, nullptr};
  auto beside = identification::latitude_doubt(study, recordings, d.patched);
  if (!beside) return {};
  beside->beside_causes = true;
  // A cause that was taken for the latitude bends it: from there the model may do without it.
  mc::Study there = study;
  there.site.latitude = beside->latitude;
  alone = identification::latitude_doubt(there, recordings, d.nominal);
  if (!alone || !alone->alone()) return {beside, nullptr};
  alone->declared = beside->declared;
  alone->chi2_per_dof_before = beside->chi2_per_dof_before;
  alone->clock = beside->clock;  // asked at the latitude of the study, not at this one
  alone->or_clock = beside->or_clock;
  return {alone, nullptr};
}

std::optional<remark::TimesInstead> times_instead(const ClockOfMisfit& clock_of_misfit,
                                                  const Diagnosis& d,
                                                  const ClockOfMisfit& under_found_noise) {
  if (d.verdict == Verdict::consistent) return std::nullopt;
  if (d.other_latitude && d.other_latitude->clock) return std::nullopt;
  const auto dof = static_cast<double>(d.fit.dof);
  const bool found = !d.causes.empty();
  const double gain = dof * (d.fit.chi2_per_dof_before - (found ? d.fit.chi2_per_dof_after : 1.0));
  if (!(gain > 0.0)) return std::nullopt;
  auto clock = clock_of_misfit(inference::SiteLimits::promise * gain);
  if (!clock || !clock->evident()) return std::nullopt;
  const bool as_well = found ? leaves_as_little(clock->chi2_per_dof_after, d)
                             : stats::misfit_chance(clock->chi2_per_dof_after, dof) >=
                                   inference::SearchLimits::alpha;
  if (!as_well) return std::nullopt;
  auto noise = CaseNoise::declared;
  if (under_found_noise) {
    noise = CaseNoise::found;
    clock = under_found_noise(0.0);
    if (!clock || !clock->evident()) return std::nullopt;
  }
  const double odds = std::exp(log_odds(clock->log_evidence, d, noise));
  // On a case another clock is an effect among others. Of a platform a survey and a clock can both
  // be looked up, and what either leaves is one: it is said however rare such a clock is.
  if (d.of_case && !(odds * inference::RemarkLimits::decided >= 1.0)) return std::nullopt;
  return remark::TimesInstead{*clock, odds};
}

std::optional<remark::TimesInstead> times_instead(const mc::Study& study,
                                                  const std::vector<Recording>& recordings,
                                                  const Diagnosis& d) {
  if (d.of_case) return std::nullopt;
  return times_instead(
      [&](double promised) {
        return identification::clock_of_misfit(study, recordings, d.nominal, promised);
      },
      d);
}

}  // namespace drift::diagnosis
