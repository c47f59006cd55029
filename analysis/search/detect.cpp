#include "analysis/search/detect.hpp"

#include <algorithm>
#include <limits>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/pairs.hpp"
#include "analysis/search/settle_noise.hpp"

namespace drift::search {
namespace {

using inference::SearchLimits;

constexpr double infinity = std::numeric_limits<double>::infinity();

double strongest_candidate(const Fitted& nominal) {
  double strength = 0.0;
  for (const Score& s : nominal.scores) strength = std::max(strength, s.strength);
  return strength;
}

double strongest_window(const Fitted& nominal) {
  double strength = 0.0;
  for (const inference::PositionScan& s : nominal.scans)
    for (const double T : s.T) strength = std::max(strength, stats::strength(T, 1));
  return strength;
}

}  // namespace

Detection detect(Fitted nominal, const MeasuredTest& test, const SearchOptions& options) {
  Detection out;
  for (inference::Candidate& c : nominal.set.candidates)
    if (TermLibrary::terms[*TermLibrary::find_term(c.term)].needs.covariates &
        options.read_off.covariates)
      c.log_prior = options.read_off.log_prior;
  out.thresholds = chance_thresholds(nominal, options.alpha, options.draws);
  const bool alarm = nominal.noise.driven ||
                     strongest_candidate(nominal) > out.thresholds.library_threshold ||
                     strongest_window(nominal) > out.thresholds.scan_threshold;
  if (const auto differing = alarm && !nominal.gross ? drift_of_cagings(nominal) : std::nullopt) {
    nominal = with_noise(std::move(nominal), test.timeline, *differing);
    out.thresholds = chance_thresholds(nominal, options.alpha, options.draws);
  }
  if (const auto settled = settle_noise(nominal)) {
    out.noise_alone = nominal.noise;
    nominal = with_noise(std::move(nominal), test.timeline, settled->noise);
    out.thresholds = chance_thresholds(nominal, options.alpha, options.draws);
  }
  // The other equation is a jump, not a small amplitude: by the likelihood ratio of two points,
  // P(2 log LR > T) <= exp(-T/2).
  out.other = fit_other_equation(nominal, test);
  out.other_equation = out.other ? out.other->gain : -infinity;
  out.p_library = out.thresholds.library.p_value(
      std::max(strongest_candidate(nominal), 0.5 * out.other_equation));
  out.p_scan = out.thresholds.scan.p_value(strongest_window(nominal));
  out.pairs = pair_null(nominal, std::max(200, options.draws / 8));
  if (const auto pairs = strongest_pairs(nominal, 1); !pairs.empty())
    out.p_pairs = out.pairs.p_value(pairs.front().strength);
  nominal.unknown = nominal.strongest_inputs();
  out.p_lone = nominal.unknown->lone.p_value;
  out.p_periodic = nominal.unknown->periodic.p_value();
  out.p_value = std::min(
      {1.0, out.p_library / SearchLimits::library_share, out.p_scan / SearchLimits::scan_share,
       out.p_pairs / SearchLimits::pair_share, out.p_lone / SearchLimits::lone_share,
       out.p_periodic / SearchLimits::periodic_share});
  out.significant = out.p_value < options.alpha;
  out.nominal = std::move(nominal);
  return out;
}

}  // namespace drift::search
