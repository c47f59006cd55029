#include "analysis/search/refit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/inference/size_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fit_causes.hpp"
#include "analysis/search/settings_alike.hpp"
#include "analysis/search/settle_noise.hpp"
#include "core/stats/normal.hpp"
#include "mc/task/campaign.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits, inference::FitLimits, inference::WeighLimits;

/// Change of the log evidence if the amplitudes of the causes are of unknown size (size_prior.hpp).
/// lambda is no amplitude: it lies between 0 and 1. library: the filter with the library's priors.
double gain_of_sizes(const inference::CandidateSet& set, const FilterSpec& library,
                     const Refit& r) {
  const inference::Projector::Fit fit = r.after.projector->fit();
  const Layout layout = make_layout(r.filter);
  std::vector<Eigen::Index> rows;
  std::vector<int> cause;
  std::vector<double> wide;
  int causes = 0;
  for (const Choice& choice : r.choices) {
    const std::size_t before = rows.size();
    for (const std::size_t i : set.candidates[choice.candidate].params) {
      const auto at = std::find(layout.params.begin(), layout.params.end(), i);
      if (i == closure_param || at == layout.params.end()) continue;
      rows.push_back(at - layout.params.begin());
      cause.push_back(causes);
      wide.push_back(r.filter.believed(i).sigma() / library.believed(i).sigma());
    }
    causes += rows.size() > before;
  }
  return inference::log_gain_of_sizes(fit.x(rows), fit.covariance(rows, rows), cause, wide);
}

/// Whether each of simultaneous causes has an amplitude that is clearly not zero. A change of
/// equation is judged by the fit alone: where its weight ends is seldom known well.
bool all_needed(const inference::CandidateSet& set, const Refit& r) {
  return std::all_of(r.choices.begin(), r.choices.end(), [&](const Choice& choice) {
    const auto& params = set.candidates[choice.candidate].params;
    return std::any_of(params.begin(), params.end(), [&](std::size_t i) {
      const ParameterEstimate* p = r.after.fit.estimate.find(i);
      return i == closure_param || !p ||
             std::abs(p->value - r.filter.believed(i).mean()) >= WeighLimits::needed * p->sigma;
    });
  });
}

/// lambda is a jump: its slope at the nominal fit says nothing.
bool signs_agree(const Expectation& expected, const BatchResult& fit) {
  return std::ranges::all_of(expected.amplitude, [&](const auto& a) {
    const ParameterEstimate* p = fit.estimate.find(a.first);
    return p == nullptr || a.first == closure_param ||
           std::abs(a.second) <= WeighLimits::sign * p->sigma || p->value * a.second >= 0.0;
  });
}

/// What is left, without the members of the chosen families.
Remainder left_by(const Fitted& after, const inference::CandidateSet& set,
                  const std::vector<Choice>& choices) {
  Remainder out;
  for (std::size_t k = 0; k < after.scores.size(); ++k) {
    if (after.scores[k].strength <= out.library ||
        of_a_chosen_family(set, choices, after.set.candidates[k]))
      continue;
    out.library = after.scores[k].strength;
    out.strongest = k;
  }
  for (const inference::PositionScan& s : after.scans)
    for (const double T : s.T) out.scan = std::max(out.scan, stats::strength(T, 1));
  return out;
}

/// The filter with a prior as wide as each amplitude that is larger than its own, as the data have
/// it where it lies beyond what its prior makes credible.
struct Room {
  FilterSpec filter;
  double farthest = 0.0;  ///< the largest amplitude, in sigmas of what was to be expected
};
/// Nothing if none is. What a prior holds back of a large effect its twins would take.
std::optional<Room> with_room_for_sizes(const inference::CandidateSet& set, const Refit& r) {
  std::optional<Room> room;
  for (const Choice& choice : r.choices)
    for (const std::size_t i : set.candidates[choice.candidate].params) {
      const ParameterEstimate* p = r.after.fit.estimate.find(i);
      if (i == closure_param || !p) continue;
      const Prior prior = r.filter.believed(i);
      const double off = std::abs(p->value - prior.mean()), sigma = prior.sigma();
      if (!(off > sigma) || !(p->sigma < sigma)) continue;
      const auto alone = inference::without_prior(off, p->sigma, sigma);
      // Where a prior says more than the data, what these alone have is mostly their noise.
      const bool seen = 2.0 * p->sigma * p->sigma < sigma * sigma;
      const double sigmas = seen ? alone.sigmas : off / sigma;
      if (!room) room = {r.filter};
      room->filter.priors[i] =
          normal(prior.mean(), seen && sigmas > FitLimits::beyond_prior ? alone.off : off);
      room->farthest = std::max(room->farthest, sigmas);
    }
  return room;
}

/// A fit's filter with these settings believed where the fit has them, give or take as much as they
/// are themselves.
FilterSpec with_room_for(const std::vector<std::size_t>& settings, const Refit& r) {
  FilterSpec room = r.filter;
  for (const std::size_t i : settings) {
    const double value = r.after.fit.estimate.find(i)->value;
    room.priors[i] = normal(value, std::abs(value));
  }
  return room;
}

/// [sigma of the prior] How far a fit has a parameter from where its filter believed it.
double off_prior(const Refit& r, std::size_t param) {
  const Prior& prior = r.filter.priors[param];
  return (r.after.fit.estimate.find(param)->value - prior.mean()) / prior.sigma();
}

/// Whether settings are where the fit before had them.
bool stay(const std::vector<std::size_t>& settings, const Refit& r) {
  constexpr double moved = 0.1;  // sigmas
  return std::ranges::all_of(settings, [&](std::size_t i) {
    return std::abs(off_prior(r, i)) * r.filter.priors[i].sigma() <=
           moved * r.after.fit.estimate.find(i)->sigma;
  });
}

/// Twice the negative log likelihood of a fit, but for a constant, without the priors of settings.
double loss_without(const std::vector<std::size_t>& settings, const Refit& r) {
  double loss = r.after.fit.estimate.statistic;
  for (const std::size_t i : settings) loss -= std::pow(off_prior(r, i), 2);
  return loss;
}

/// Another equation must be another one: where the nominal weight may be, nothing is named.
bool is_another_equation(const CauseFit& causes) {
  return causes.loss_of_nominal > std::pow(WeighLimits::other_lambda, 2);
}

/// What a refit is made of and compared with.
struct Beside {
  const Fitted& nominal;
  const MeasuredTest& test;
  const ChanceThresholds& thresholds;
  NoiseKinds kinds;
};

/// What is left of the test with the causes in.
void look_at_rest(Refit& r, const Fitted& after, const Beside& b) {
  r.remainder = left_by(after, b.nominal.set, r.choices);
  r.excess = std::max(r.remainder.library - b.thresholds.library_threshold,
                      r.remainder.scan - b.thresholds.scan_threshold);
}

/// A fit of causes, scored again with its noise. Its filter is the one that it was fitted with.
Refit scored(const std::vector<Choice>& choices, const FilterSpec& filter, const BatchResult& fit,
             const Beside& b) {
  Refit out;
  out.choices = choices;
  out.filter = filter;
  out.after = examine(filter, b.test, fit, b.kinds, &b.nominal);
  // A second effect may hide in the noise; beside a cause noise stays where it is credible.
  if (const auto settled =
          settle_noise(out.after, EffortLimits::noise_tries_beside, UnknownInputs::free_form);
      settled && settled->probability > inference::SearchLimits::credible)
    out.after = with_noise(std::move(out.after), b.test.timeline, settled->noise);
  look_at_rest(out, out.after, b);
  return out;
}

/// Judges and weighs a refit whose rest has been looked at. Of the candidates beside it only the
/// scores are asked for from here on.
void judge(Refit& r, const CauseFit& causes, const Beside& b) {
  r.sign_agrees = signs_agree(causes.expected, r.after.fit);
  r.nameable = !causes.expected.lambda_among_them || is_another_equation(causes);
  if (r.choices.size() > 1 && !all_needed(b.nominal.set, r))
    r.excess = std::numeric_limits<double>::infinity();
  if (r.tolerable()) {
    // Many small traces in one equation that no window and no candidate has alone. What is periodic
    // does not speak against a cause: it is told beside it.
    r.after.unknown = r.after.strongest_inputs();
    r.excess = std::max(r.excess, std::log(WeighLimits::quiet_p / r.after.unknown->lone.p_value));
  }
  r.log_bayes = r.after.log_evidence() - b.nominal.log_evidence() +
                log_share_of_settings(b.nominal, r.choices) - causes.narrowed +
                gain_of_sizes(b.nominal.set, causes.filter, r);
  if (causes.expected.lambda_among_them)
    r.log_bayes += r.after.log_gain_of_misalignments() - b.nominal.log_gain_of_misalignments();
  r.after.forget_signatures();
}

}  // namespace

std::vector<std::size_t> settings_beyond_grid(const inference::CandidateSet& set, const Refit& r) {
  std::vector<std::size_t> beyond;
  for (const Choice& choice : r.choices) {
    const inference::Candidate& c = set.candidates[choice.candidate];
    if (c.term == closure_term) return {};
    for (const auto& [param, grid_point] : c.variants[choice.variant].settings) {
      const ParameterEstimate* p = r.after.fit.estimate.find(param);
      if (TermLibrary::specs[param].kind != ParamKind::nonlinear || !p ||
          p->value * grid_point <= 0.0)
        continue;
      const auto setting_of = [i = param](const inference::Variant& v) {
        return std::ranges::find(v.settings, i, &std::pair<std::size_t, double>::first)->second;
      };
      const auto [least, most] = std::ranges::minmax(c.variants, {}, setting_of);
      if (p->value < setting_of(least) || p->value > setting_of(most)) beyond.push_back(param);
    }
  }
  return beyond;
}

NoiseKinds noise_beside(const Fitted& nominal) {
  return nominal.noise.driven ? NoiseKinds::driving_too : NoiseKinds::white;
}

Refit refit(const Fitted& nominal, const MeasuredTest& test, const std::vector<Choice>& choices,
            const ChanceThresholds& thresholds, NoiseKinds kinds, Sizes sizes) {
  CauseFit causes = fit_causes(nominal, test, choices, nominal.noise.model);
  const Beside beside{nominal, test, thresholds, kinds};
  Refit out = scored(choices, causes.filter, causes.fit, beside);
  // What seemed to drive the platform beside one equation may not be there beside another.
  if (causes.expected.lambda_among_them &&
      (nominal.noise.model.driven() || out.after.noise.model.driven())) {
    causes = fit_causes(nominal, test, choices, out.after.noise.model);
    out = scored(choices, causes.filter, causes.fit, beside);
  }
  const auto room = with_room_for_sizes(nominal.set, out);
  if (room && out.excess > 0.0)
    look_at_rest(out, examine(room->filter, test, causes.fit, out.after.noise, &out.after), beside);
  judge(out, causes, beside);
  if (nominal.noise.of_differences && kinds == NoiseKinds::white && !out.after.gross &&
      !out.adequate()) {
    Refit driven = refit(nominal, test, choices, thresholds, NoiseKinds::driving_too, sizes);
    if (driven.better_than(out)) return driven;
  }
  if (sizes == Sizes::of_library || !room || room->farthest <= FitLimits::beyond_prior) return out;
  // Beyond what its prior makes credible at all a size may be what the test says.
  const BatchResult roomy =
      fit_batch_from(room->filter, test, theta_of(room->filter, causes.fit), causes.fit.psi0_l);
  Refit as_found = scored(choices, room->filter, causes.with_closure_sigma(roomy), beside);
  as_found.as_found = true;
  judge(as_found, causes, beside);
  return as_found.better_than(out) ? as_found : out;
}

void give_settings_room(Refit& r, const Fitted& nominal, const MeasuredTest& test,
                        const ChanceThresholds& thresholds, NoiseKinds kinds) {
  constexpr int passes = 8;  // a prior holds back what is far from it: each gives more room
  const std::vector<std::size_t> settings = settings_beyond_grid(nominal.set, r);
  if (settings.empty()) return;
  Refit roomy = r;
  for (int pass = 0; pass < passes; ++pass) {
    const FilterSpec room = with_room_for(settings, roomy);
    const BatchResult fit =
        fit_batch_from(room, test, theta_of(room, roomy.after.fit), roomy.after.fit.psi0_l);
    roomy = scored(r.choices, room, fit, {nominal, test, thresholds, kinds});
    if (stay(settings, roomy) || settings_beyond_grid(nominal.set, roomy).empty()) break;
  }
  // Else it is within the interval of what the data say, and these may say next to nothing.
  if (!(loss_without(settings, r) - loss_without(settings, roomy) >
        std::pow(stats::half_width_95, 2)))
    return;
  roomy.as_found = r.as_found;
  roomy.nameable = r.nameable;
  roomy.sign_agrees = r.sign_agrees;
  roomy.log_bayes = r.log_bayes;
  if (r.after.unknown) roomy.after.unknown = roomy.after.strongest_inputs();
  roomy.after.forget_signatures();
  r = std::move(roomy);
}

std::vector<Refit> refit_all(const Fitted& nominal, const MeasuredTest& test,
                             const std::vector<Explanation>& all,
                             const ChanceThresholds& thresholds, NoiseKinds kinds, Sizes sizes) {
  if (all.size() == 1)  // its own fits are spread over the threads then
    return {refit(nominal, test, all.front(), thresholds, kinds, sizes)};
  return mc::run_campaign(all.size(), [&](std::size_t k) {
    return refit(nominal, test, all[k], thresholds, kinds, sizes);
  });
}

}  // namespace drift::search
