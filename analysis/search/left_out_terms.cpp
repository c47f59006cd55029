#include "analysis/search/left_out_terms.hpp"

#include <algorithm>
#include <optional>

#include "analysis/inference/thresholds.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;

/// Whether a term is left out by whoever does not know that it is needed: a base term, or what a
/// case does to its accelerometers while it turns, which only matters once they are read there.
bool is_left_out_unknowingly(const TermInfo& term) {
  return is_base(term) || term.needs.turning;
}

/// The largest candidate of such a term: all of it that the nominal model leaves out.
bool is_whole_left_out_term(const inference::CandidateSet& set, const inference::Candidate& c) {
  return is_left_out_unknowingly(TermLibrary::terms[*TermLibrary::find_term(c.term)]) &&
         std::ranges::none_of(set.candidates,
                              [&](const inference::Candidate& o) { return o.contains(c); });
}

/// The term left out unknowingly that a fit misses most, as a choice among the candidates of the
/// nominal fit.
std::optional<Choice> left_out_term_missed(const Search& s, const Fitted& now) {
  const Score* best = nullptr;
  std::optional<Choice> missed;
  for (std::size_t k = 0; k < now.set.candidates.size(); ++k) {
    const inference::Candidate& c = now.set.candidates[k];
    const Score& score = now.scores[k];
    if (score.dof == 0 || score.strength <= s.thresholds.library_threshold ||
        !is_whole_left_out_term(now.set, c) || (best && score.strength <= best->strength))
      continue;
    for (std::size_t n = 0; n < s.nominal.set.candidates.size(); ++n)
      if (s.nominal.set.candidates[n].term == c.term &&
          s.nominal.set.candidates[n].params == c.params) {
        best = &score;
        missed = Choice{n, s.nominal.scores[n].variant};
      }
  }
  return missed;
}

}  // namespace

std::vector<Refit> refit_left_out_terms(const Search& s, const MeasuredTest& test) {
  Explanation in;
  std::vector<Refit> found;
  for (std::optional<Choice> next = left_out_term_missed(s, s.nominal);
       next && in.size() < EffortLimits::together;
       next = left_out_term_missed(s, found.front().after)) {
    in.push_back(*next);
    found =
        refit_all(s.nominal, test, {in}, s.thresholds, NoiseKinds::driving_too, Sizes::of_library);
    if (found.front().adequate()) break;
  }
  if (in.size() < 2) return {};
  return found;
}

}  // namespace drift::search
