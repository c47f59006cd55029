#include "analysis/report/diagnosis/words/too_large.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/report/diagnosis/words/words.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

using diagnosis::Diagnosis;
using search::CandidateScore;

/// Whether a candidate is one of the causes. Of one term another parameter is another effect: the
/// first harmonic of an encoder is not the second.
bool is_named(const Diagnosis& d, const CandidateScore& c) {
  const std::size_t space = c.label.rfind(' ');
  const std::string of_one =
      space == std::string::npos || c.dof != 1 ? "" : c.label.substr(space + 1);
  return std::ranges::any_of(d.causes, [&](const search::Cause& cause) {
    return cause.term == c.term &&
           (of_one.empty() || cause.axis != c.axis ||
            std::ranges::find(cause.parameters, of_one, &search::CauseParameter::key) !=
                cause.parameters.end());
  });
}

/// Significant, with nothing significant left beside it.
bool explains(const CandidateScore& c) {
  return c.observable && c.leaves_nothing && c.p_value <= inference::RemarkLimits::chance_p;
}

/// The log evidence of a candidate whose size costs nothing.
double of_any_size(const CandidateScore& c) {
  return c.log_bayes + 0.5 * c.size_sigma * c.size_sigma;
}

/// An explanation, and too large: so far out in its prior that no cause is, or further out than is
/// usual, and as likely as the causes were it not. best: the largest log evidence among those.
bool loses_by_size(const CandidateScore& c, double best) {
  return explains(c) &&
         (c.size_sigma > unusual_size || (c.size_sigma > inference::RemarkLimits::large_size &&
                                          best > c.log_bayes && of_any_size(c) > best));
}

/// The largest log evidence among the candidates that are causes.
double best_evidence(const Diagnosis& d) {
  double best = -std::numeric_limits<double>::infinity();
  for (const CandidateScore& c : d.candidates)
    if (is_named(d, c)) best = std::max(best, c.log_bayes);
  return best;
}

bool likelier(const CandidateScore* a, const CandidateScore* b) {
  return a->log_bayes != b->log_bayes ? a->log_bayes > b->log_bayes : a->size_sigma < b->size_sigma;
}

/// Of every term the likeliest candidate, the likeliest first.
std::vector<const CandidateScore*> likeliest_of_each_term(const Diagnosis& d) {
  std::vector<const CandidateScore*> all;
  const double best = best_evidence(d);
  for (const CandidateScore& c : d.candidates) {
    if (!loses_by_size(c, best) || is_named(d, c)) continue;
    const auto same = std::ranges::find(all, c.term, &CandidateScore::term);
    if (same == all.end())
      all.push_back(&c);
    else if (likelier(&c, *same))
      *same = &c;
  }
  std::ranges::stable_sort(all, likelier);
  return all;
}

}  // namespace

std::string too_large_text(const Diagnosis& d) {
  constexpr std::size_t most = 6;
  if (d.causes.empty() && d.verdict != diagnosis::Verdict::unexplained) return "";
  std::vector<std::string> effects;
  for (const CandidateScore* c : likeliest_of_each_term(d))
    if (effects.size() < most)
      effects.push_back(fmt::format("{} ({}{})", label_of(*c), number_text(c->size_sigma, 2),
                                    effects.empty() ? " times its usual size" : ""));
  if (effects.empty()) return "";
  return fmt::format(" What would explain it{}, but loses by its size alone: {}.",
                     d.causes.empty() ? "" : " as well", listed(effects, "and"));
}

bool nearest_is_too_large(const Diagnosis& d) {
  const CandidateScore* nearest = nullptr;
  for (const CandidateScore& c : d.candidates)
    if (explains(c) && !is_named(d, c) && std::isfinite(of_any_size(c)) &&
        (nearest == nullptr || of_any_size(c) > of_any_size(*nearest)))
      nearest = &c;
  return !d.causes.empty() && nearest != nullptr && loses_by_size(*nearest, best_evidence(d));
}

}  // namespace drift::report
