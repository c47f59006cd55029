#include "analysis/diagnosis/candidate_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

/// Score that is exceeded with 80 % probability: the threshold on |z| plus 0.84 sigma.
double detectable_z(double strength_threshold) {
  return std::sqrt(stats::quantile_of_strength(strength_threshold, 1)) +
         inference::RemarkLimits::detectable;
}

/// Probability of each candidate alone, by its linear score, against the nominal model and all
/// others. Candidates of one term share its prior.
std::vector<double> linear_probabilities(const search::Fitted& nominal) {
  const auto& candidates = nominal.set.candidates;
  std::map<std::string, double> offers;
  for (const inference::Candidate& c : candidates) offers[c.term] += 1.0;
  double top = 0.0;  // the nominal model itself
  for (const search::Score& s : nominal.scores) top = std::max(top, s.log_bayes);
  std::vector<double> share;
  double sum = std::exp(-top);
  for (std::size_t k = 0; k < nominal.scores.size(); ++k)
    sum += share.emplace_back(std::exp(nominal.scores[k].log_bayes - top) /
                              offers[candidates[k].term]);
  for (double& s : share) s /= sum;
  return share;
}

search::CandidateScore line_of(const search::Fitted& nominal, const search::Search& found,
                               std::size_t k) {
  const inference::Projected& p = nominal.projected;
  const inference::Candidate& c = nominal.set.candidates[k];
  const search::Score& s = nominal.scores[k];
  const ParamSpec& spec = TermLibrary::specs[c.params.front()];
  search::CandidateScore line;
  line.term = c.term;
  line.axis = c.axis;
  line.label = c.label;
  line.dof = s.dof;
  line.observable = s.dof > 0;
  line.unit = spec.unit.symbol.view();
  line.score = s.T;
  line.p_marginal = s.dof > 0 ? std::exp(-s.strength) : 1.0;
  line.p_value = s.dof > 0 ? found.thresholds.library.p_value(s.strength) : 1.0;
  line.log_bayes = s.log_bayes;
  const inference::Variant& v = c.variants[s.variant];
  double left = 0.0, raw = 0.0;
  for (const int column : v.columns) {
    left += p.C(column, column);
    raw += p.raw[column];
  }
  line.absorbed = raw > 0.0 ? std::clamp(1.0 - left / raw, 0.0, 1.0) : 1.0;
  if (s.dof > 0) {
    line.worst_conditional = std::max(found.linear[k].library, found.linear[k].scan);
    line.adequate = found.linear[k].library <= found.thresholds.library_threshold &&
                    found.linear[k].scan <= found.thresholds.scan_threshold;
    line.leaves_nothing = line.adequate;
  }
  const VecX a = search::expected_amplitudes(p, v.columns);
  line.size_sigma = a.norm();
  if (c.params.size() == 1 && s.dof == 1) {
    // File unit per prior sigma, of the prior that was searched with: the library's is none of a
    // unit whose gyros do not see the Earth.
    const auto column = static_cast<std::size_t>(v.columns[0]);
    const double scale = nominal.set.signatures[column].unit / spec.unit.to_si;
    const double information = p.C(v.columns[0], v.columns[0]);
    line.param = c.params.front();
    line.amplitude = p.g[v.columns[0]] / information * scale;
    line.sigma = scale / std::sqrt(information);
    line.smallest_detectable = detectable_z(found.thresholds.library_threshold) * line.sigma;
    line.size_sigma = std::abs(line.amplitude) / scale;
  }
  return line;
}

/// frame_closure by the jump to the other equation.
void score_by_jump(search::CandidateScore& line, const search::Search& found) {
  line.score = found.other_equation;
  line.p_marginal =
      std::exp(-0.5 * found.other_equation);  // two points: P(2 log LR > T) <= exp(-T/2)
  line.p_value = std::min(1.0, found.thresholds.library.p_value(0.5 * found.other_equation));
  line.log_bayes = 0.5 * found.other_equation;
  line.dof = 1;
  line.observable = true;
  line.amplitude = line.sigma = line.smallest_detectable = std::nan("");  // no small change
}

/// Probabilities by the refits; what the credible set leaves is shared as the linear scores would
/// have it.
void weigh_by_refits(std::vector<search::CandidateScore>& lines, const search::Fitted& nominal,
                     const search::Search& found) {
  double held = 0.0, linear = 0.0;
  std::vector<std::pair<std::string, double>> judged;  // label, probability
  for (std::size_t k = 0; k < found.sets.size(); ++k) {
    if (found.sets[k].choices.size() != 1) continue;
    judged.emplace_back(nominal.set.candidates[found.sets[k].choices.front().candidate].label,
                        found.probability[k]);
  }
  for (const double p : found.probability) held += p;
  const auto probability_of = [&](const search::CandidateScore& line) {
    const auto at = std::ranges::find(judged, line.label, &std::pair<std::string, double>::first);
    return at == judged.end() ? -1.0 : at->second;
  };
  for (const search::CandidateScore& line : lines)
    if (probability_of(line) < 0.0) linear += line.probability;
  for (search::CandidateScore& line : lines) {
    const double p = probability_of(line);
    line.adequate = p >= 0.0;
    line.probability = p >= 0.0       ? p
                       : linear > 0.0 ? line.probability * std::max(0.0, 1.0 - held) / linear
                                      : 0.0;
  }
}

}  // namespace

std::vector<search::CandidateScore> candidate_table(const search::Fitted& nominal,
                                                    const search::Search& found) {
  const std::vector<double> probability = linear_probabilities(nominal);
  std::vector<search::CandidateScore> lines;
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
    lines.push_back(line_of(nominal, found, k));
    lines.back().probability = probability[k];
    if (lines.back().term == closure_term && found.other_equation > lines.back().score)
      score_by_jump(lines.back(), found);
  }
  if (!found.sets.empty()) weigh_by_refits(lines, nominal, found);
  // What the refits confirmed comes first.
  const auto confirmed = [&](const search::CandidateScore& c) {
    return !found.sets.empty() && c.adequate ? c.probability : -1.0;
  };
  std::ranges::stable_sort(
      lines, [&](const search::CandidateScore& a, const search::CandidateScore& b) {
        if (confirmed(a) != confirmed(b)) return confirmed(a) > confirmed(b);
        return a.p_marginal != b.p_marginal ? a.p_marginal < b.p_marginal : a.score > b.score;
      });
  return lines;
}

}  // namespace drift::diagnosis
