#include "analysis/diagnosis/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/search/setting_spread.hpp"

namespace drift::diagnosis {
namespace {

constexpr double one_axis_gain = 10.0;  // of twice the log likelihood

/// Score that is exceeded with 80 % probability: the threshold on |z| plus 0.84.
double detectable_z(double strength_threshold) {
  return std::sqrt(stats::quantile_of_strength(strength_threshold, 1)) + 0.84;
}

std::vector<int> columns_of(const search::Examination& e,
                            const std::vector<search::Choice>& choices) {
  std::vector<int> columns;
  for (const search::Choice& c : choices) {
    const auto& more = e.set.candidates[c.candidate].variants[c.variant].columns;
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

}  // namespace

void fill_candidates(const search::Examination& nominal, const search::Search& found,
                     Diagnosis& d) {
  const inference::Projected& p = nominal.projector->candidates();
  std::map<std::string, double> offers;
  for (const inference::Candidate& c : nominal.set.candidates) offers[c.term] += 1.0;
  double top = 0.0, sum = 1.0;  // the nominal model itself
  for (const search::Score& s : nominal.scores) top = std::max(top, s.log_bayes);
  sum = std::exp(-top);
  for (std::size_t k = 0; k < nominal.scores.size(); ++k)
    sum += std::exp(nominal.scores[k].log_bayes - top) / offers[nominal.set.candidates[k].term];
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
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
    line.p_value = s.dof > 0 ? found.nulls.library.p_value(s.strength) : 1.0;
    line.log_bayes = s.log_bayes;
    line.probability = std::exp(s.log_bayes - top) / offers[c.term] / sum;
    const inference::Variant& v = c.variants[s.variant];
    double left = 0.0, raw = 0.0;
    for (const int column : v.columns) {
      left += p.C(column, column);
      raw += p.raw[column];
    }
    line.absorbed = raw > 0.0 ? std::clamp(1.0 - left / raw, 0.0, 1.0) : 1.0;
    if (s.dof > 0) {
      line.worst_conditional = std::max(found.linear[k].library, found.linear[k].scan);
      line.adequate = found.linear[k].library <= found.nulls.library_threshold &&
                      found.linear[k].scan <= found.nulls.scan_threshold;
    }
    const VecX a = search::expected_amplitudes(p, v.columns);
    line.size_sigma = a.norm();
    if (c.params.size() == 1 && s.dof == 1) {
      const double scale = spec.prior.sigma();  // file unit per prior sigma
      const double information = p.C(v.columns[0], v.columns[0]);
      line.amplitude = p.g[v.columns[0]] / information * scale;
      line.sigma = scale / std::sqrt(information);
      line.smallest_detectable = detectable_z(found.nulls.library_threshold) * line.sigma;
      line.size_sigma = std::abs(line.amplitude) / scale;
    }
    d.candidates.push_back(std::move(line));
  }
  std::stable_sort(d.candidates.begin(), d.candidates.end(), [](const auto& a, const auto& b) {
    return a.p_marginal != b.p_marginal ? a.p_marginal < b.p_marginal : a.score > b.score;
  });
}

void fill_noise(const search::Examination& nominal, std::size_t spikes, Diagnosis& d) {
  d.noise = nominal.noise.findings;
  std::size_t lowered = 0;
  for (const double w : nominal.problem.weight) lowered += w < 1.0;
  if (spikes + lowered == 0) return;
  inference::NoiseFinding f;
  f.component = "outliers";
  f.factor = f.factor_sigma = std::nan("");
  f.unit = "samples";
  f.value = static_cast<double>(spikes + lowered);
  f.count = spikes;
  f.significant = spikes > 0 || lowered > 0;
  f.p_value = f.significant ? 1e-4 : 1.0;  // beyond four sigma of what Gaussian noise gives
  d.noise.push_back(f);
  d.remarks.push_back(
      fmt::format("{} isolated samples were left out and {} given less weight: their residuals are "
                  "larger than Gaussian noise gives.",
                  spikes, lowered));
}

void fill_causes(const search::Examination& nominal, const search::Search& found, Diagnosis& d) {
  const inference::Projected& p = nominal.projector->candidates();
  std::vector<std::vector<int>> columns;
  for (std::size_t set = 0; set < found.sets.size(); ++set) {
    const search::Refit& r = found.sets[set];
    for (std::size_t which = 0; which < r.choices.size(); ++which) {
      const search::Choice& choice = r.choices[which];
      const inference::Candidate& c = nominal.set.candidates[choice.candidate];
      search::Cause cause;
      cause.term = c.term;
      cause.axis = c.axis;
      cause.set = static_cast<int>(set);
      cause.probability = found.probability[set];
      const auto own = columns_of(nominal, {choice});
      const inference::Contrast contrast = inference::make_contrast(p.C, p.raw, own);
      cause.dof = contrast.dof;
      // Each of several with the others in the model: alone it may cancel against them.
      std::vector<search::Choice> others;
      for (const search::Choice& o : r.choices)
        if (o.candidate != choice.candidate) others.push_back(o);
      const auto T_of = [&](const std::vector<search::Choice>& some) {
        return inference::make_contrast(p.C, p.raw, columns_of(nominal, some)).T(p.g);
      };
      cause.T = std::max(0.0, T_of(r.choices) - (others.empty() ? 0.0 : T_of(others)));
      if (c.term == "frame_closure") {  // far from linear: what counts is the fit
        cause.T = std::max(cause.T, 2.0 * r.log_bayes);
        cause.dof = std::max(cause.dof, 1);
      }
      cause.p_value =
          std::min(1.0, found.nulls.library.p_value(stats::strength(cause.T, cause.dof)) /
                            search::library_share);
      const auto add = [&](std::size_t param, bool profiled) {
        const ParamSpec& spec = TermLibrary::specs[param];
        search::CauseParameter out{std::string(spec.key.view()),         param,   0.0, 0.0,
                                   std::string(spec.unit.symbol.view()), profiled};
        if (const ParameterEstimate* e = r.after.fit.estimate.find(param)) {
          out.value = e->value / spec.unit.to_si;
          const double spread =
              profiled && spec.kind == ParamKind::nonlinear
                  ? search::setting_spread(nominal, r.choices, which, param, e->value)
                  : 0.0;
          out.sigma = std::max(e->sigma, spread) / spec.unit.to_si;
          if (!profiled)
            cause.size_sigma =
                std::max(cause.size_sigma,
                         std::abs(e->value - spec.prior_si().mean()) / spec.prior_si().sigma());
        } else {
          out.value = r.filter.priors[param].mean() / spec.unit.to_si;
        }
        cause.parameters.push_back(out);
      };
      for (const std::size_t i : c.params) add(i, false);
      for (const auto& [i, value] : c.variants[choice.variant].settings) add(i, true);
      d.causes.push_back(std::move(cause));
      columns.push_back(own);
      d.cosines.labels.push_back(c.label);
    }
  }
  const auto n = static_cast<Eigen::Index>(columns.size());
  d.cosines.cosine = MatX::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (i != k) d.cosines.cosine(i, k) = search::cosine(p, columns[i], columns[k]);
  // What each could be taken for, among all candidates: the strongest cosines of other terms.
  for (std::size_t i = 0; i < d.causes.size(); ++i) {
    std::vector<search::Confusable> near;
    for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
      const inference::Candidate& c = nominal.set.candidates[k];
      if (nominal.scores[k].dof == 0 ||
          (c.term == d.causes[i].term && (c.axis == d.causes[i].axis || c.axis.empty())))
        continue;
      const double rho =
          search::cosine(p, columns[i], c.variants[nominal.scores[k].variant].columns);
      if (std::abs(rho) > 0.5) near.push_back({c.term, c.axis, rho});
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) {
      return std::abs(a.cosine) > std::abs(b.cosine);
    });
    for (const search::Confusable& c : near) {
      const auto same = [&](const search::Confusable& o) {
        return o.term == c.term && o.axis == c.axis;
      };
      auto& list = d.causes[i].confusable_with;
      if (list.size() < 5 && std::none_of(list.begin(), list.end(), same)) list.push_back(c);
    }
  }
  // Candidates that are one direction on this plan, whatever the data; a wider one holds the cause
  // anyway.
  for (const search::Cause& cause : d.causes)
    for (const search::Confusable& c : cause.confusable_with)
      if (c.cosine * c.cosine > 0.999 && (cause.axis.empty() || !c.axis.empty()))
        d.inseparable.push_back(fmt::format("{} and {} leave the same trace on this plan",
                                            in_words(cause.term, cause.axis),
                                            in_words(c.term, c.axis)));
  if (found.sets.empty() && nominal.lone.p_value < 0.01)
    d.remarks.push_back(
        fmt::format("An unknown input of free form in {} alone would explain it (twice the log "
                    "likelihood better by {:.1f}).",
                    nominal.lone.equation, nominal.lone.gain));
  for (const search::Cause& c : d.causes)
    if (c.term == "frame_closure")
      d.remarks.push_back(
          "Cross-talk between the torquing channels (taken as zero) moves lambda (frame_closure) "
          "as much "
          "as misalignment does in slews; only Earth rate and turns of the case tell them apart.");
}

bool noise_of_one_axis(const search::Examination& nominal, Diagnosis& d) {
  const inference::NoiseModel& all = nominal.noise.model;
  if (!nominal.noise.driven ||
      all.angle_random_walk + all.drift_random_walk + all.markov_drift == 0.0)
    return false;
  inference::LinearProblem bare = nominal.problem;
  bare.extra.resize(bare.rows(), 0);
  const auto value = [&](const inference::NoiseModel& m) {
    return inference::Projector(bare, m).candidates().log_likelihood2();
  };
  const double together = value(all);
  double best = 0.0;
  int axis = -1;
  for (int a = 0; a < 3; ++a)
    for (const double factor : {0.7, 1.0, 1.6, 2.5}) {
      inference::NoiseModel one = all;
      one.gyros = factor * Vec3::Unit(a);
      const double gain = value(one) - together;
      if (gain > best) {
        best = gain;
        axis = a;
      }
    }
  if (best < one_axis_gain) return false;
  d.p_value = std::min(d.p_value, 12.0 * std::exp(-0.5 * best));
  d.where.equation = inference::equation_name(inference::Window::Equation::rate, axis);
  d.remarks.push_back(fmt::format(
      "What drives the platform acts on gyro {} alone: it is no noise that the gyros share "
      "(twice the log likelihood better by {:.1f}).",
      "xyz"[axis], best));
  return true;
}

}  // namespace drift::diagnosis
