#include <algorithm>
#include <cctype>
#include <cmath>

#include "analysis/inference/fit_thresholds.hpp"
#include "analysis/preparation/assumed_field.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/svg/axis_scale.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/estimate/starts.hpp"
#include "core/physics/stochastic.hpp"
#include "core/stats/chi_square_band.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

/// Where a linear model would have the EKF beside the batch fit, in prior sigmas: it takes its
/// start for the prior's mean, C (start - mean) with the covariance C of both.
VecX shift_by_start(const identification::FilterRun& run) {
  const auto n = static_cast<Eigen::Index>(run.ekf.parameters.size());
  VecX z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const ParameterEstimate& p = run.ekf.parameters[static_cast<std::size_t>(k)];
    z[k] = p.prior_sigma > 0.0 ? (p.start - p.prior_mean) / p.prior_sigma : 0.0;
  }
  const MatX& C = run.batch.estimate.covariance;
  return C.rows() == n ? VecX(C * z) : VecX(VecX::Zero(n));
}

/// Parameters that the two estimators, given the same, see differently: one outside the 95 %
/// interval of the other, the share of the start taken off, or with sigmas that differ threefold.
/// With a linear model they would be one: what parts them is no noise but the EKF's linearisation.
/// Empty if one failed, or if the model is wrong for both.
std::vector<std::string> disputed(const identification::FilterRun& run) {
  constexpr double apart = stats::half_width_95, unlike = inference::FitLimits::unlike_sigmas;
  const EstimateResult& fit = run.batch.estimate;
  std::vector<std::string> keys;
  if (run.ekf.status != EstimateStatus::ok || fit.status != EstimateStatus::ok || misfit(fit))
    return keys;
  const VecX shift = shift_by_start(run);
  for (std::size_t k = 0; k < run.ekf.parameters.size(); ++k) {
    const ParameterEstimate &e = run.ekf.parameters[k], &b = fit.parameters[k];
    const auto [less, more] = std::minmax(e.sigma, b.sigma);
    const double off = e.value - b.value - shift[static_cast<Eigen::Index>(k)] * e.prior_sigma;
    if (std::abs(off) > apart * less || more > unlike * less)
      keys.push_back(parameter_key(e.param));
  }
  return keys;
}

std::string start_sentence(const FilterView& v) {
  std::vector<std::string> dependent;
  for (const identification::StartSpread& p : v.summary.spread)
    if (start_verdict(p.ekf) == StartVerdict::depends_on_start)
      dependent.push_back(parameter_key(p.param));
  if (dependent.empty()) return "no parameter depends on the start.";
  return fmt::format(
      "{} of {} parameters depend on the start, their sigmas say nothing of their errors: {}.",
      dependent.size(), v.summary.spread.size(), fmt::join(dependent, ", "));
}

/// Of several starts: which one counts, why, and how many end there; empty where none converged.
std::string counted_sentence(const FilterView& v) {
  const std::size_t starts = v.id.runs_of(v.summary.filter).size(),
                    agreeing = v.summary.agreeing_starts;
  if (starts < 2 || agreeing == 0) return "";
  const std::size_t start = v.id.counted(v.summary).start;
  const bool mean = start == start_count(v.spec());
  const std::string_view what = drift_varies(v.spec()) ? "EKF" : "batch fit";
  return fmt::format(
      "start {}{} counts, {}; {} of {} starts end{} there within their sigmas.", start + 1,
      mean ? ", the prior mean, tried as no drawn one fits," : "",
      v.id.test_of_each_start
          ? fmt::format("the first whose {} converged (each has a test of its own)", what)
          : fmt::format("the {} of least chi-square of those that converged", what),
      agreeing, starts, agreeing == 1 ? "s" : "");
}

/// The EKF's NIS is not that of a right model, or it is far from the batch fit, which is.
bool batch_alone_fits(const FilterView& v, const identification::FilterRun& run) {
  if (drift_varies(v.spec()) || run.batch.estimate.status != EstimateStatus::ok ||
      fit_cell(run.batch.estimate).tone != Tone::plain)
    return false;
  return run.ekf.status != EstimateStatus::ok || fit_cell(run.ekf).tone != Tone::plain ||
         !disputed(run).empty();
}

std::string nis_sentence(const FilterView& v,
                         const std::vector<const identification::FilterRun*>& runs) {
  std::size_t outside = 0;
  Range nis;
  for (const identification::FilterRun* run : runs) {
    if (run->ekf.measured == 0) continue;
    const double per_dof = run->ekf.statistic_per_dof();
    nis.include(per_dof);
    outside += !stats::chi_square_band(static_cast<double>(run->ekf.measured)).holds(per_dof);
  }
  if (nis.empty()) return "";
  return fmt::format("EKF NIS/m {:.3f} to {:.3f}, {}.", nis.low, nis.high,
                     outside == 0 ? "inside the 95 % band of a right model"
                                  : fmt::format("outside the 95 % band of a right model from {} "
                                                "of {} start{}{}",
                                                outside, runs.size(), plural(runs.size()),
                                                batch_alone_fits(v, v.id.counted(v.summary))
                                                    ? "; the batch fit, which counts, is inside"
                                                    : ""));
}

std::string dispute_sentence(const FilterView& v, const identification::FilterRun& run) {
  constexpr std::size_t most = 8;
  std::vector<std::string> keys = disputed(run);
  const std::size_t count = keys.size();
  // Of a drift that varies the two say different things.
  if (count == 0 || drift_varies(v.spec())) return "";
  keys.resize(std::min(count, most));
  return fmt::format(
      "from start {}, EKF and batch fit are outside each other's 95 % interval, or claim sigmas "
      "that "
      "differ threefold, in {} of {} parameters: {}{}. The EKF linearises once, where it is then; "
      "what is "
      "not linear over its prior leads it astray with a small sigma. Use the batch column.",
      run.start + 1, count, v.summary.spread.size(), fmt::join(keys, ", "),
      count > most ? " and others" : "");
}

std::vector<std::string> sentences_of(const FilterView& v) {
  const auto runs = v.id.runs_of(v.summary.filter);
  const auto failed = std::ranges::count_if(runs, [](const identification::FilterRun* run) {
    return run->ekf.status != EstimateStatus::ok ||
           run->batch.estimate.status != EstimateStatus::ok;
  });
  std::vector<std::string> said;
  if (drift_varies(v.spec()))
    said.push_back(
        "has a drift that varies at random, which the batch fit does not model: its sigmas are too "
        "small; use the EKF's.");
  if (failed > 0)
    said.push_back(fmt::format("{} of {} start{} failed or did not converge.", failed, runs.size(),
                               plural(runs.size())));
  if (runs.size() > 1) said.push_back(start_sentence(v));
  said.push_back(counted_sentence(v));
  said.push_back(nis_sentence(v, runs));
  said.push_back(dispute_sentence(v, v.id.counted(v.summary)));
  said.push_back(considered_text(v));
  said.push_back(remembered_text(v));
  if (!v.summary.unseen.empty())
    said.push_back(fmt::format("of {} directions of its parameters {}.", v.summary.layout.size(),
                               unseen_text(v.summary.unseen, root_of(v))));
  std::erase(said, "");
  return said;
}

}  // namespace

std::string which_counts(const FilterView& v) {
  constexpr std::size_t most = 3;
  const identification::FilterRun& run = v.id.counted(v.summary);
  if (!batch_alone_fits(v, run)) return "";
  const std::vector<std::string> keys = disputed(run);
  return fmt::format(
      "Filter {}: the batch fit counts, and it is what a right model gives; the EKF, which "
      "linearises once, {}.",
      v.spec().name,
      run.ekf.status != EstimateStatus::ok ? "did not converge"
      : keys.empty()
          ? "has innovations that it does not expect"
          : fmt::format("is off beyond its own 95 % interval ({})", listed_up_to(keys, most)));
}

std::string other_start_text(const FilterView& v) {
  const bool all = v.summary.agreeing_starts == v.id.runs_of(v.summary.filter).size();
  const std::string said = all && v.summary.counted_start == 0 ? "" : counted_sentence(v);
  return said.empty() ? "" : fmt::format("Filter {}: {}", v.spec().name, said);
}

std::string considered_text(const FilterView& v) {
  if (!v.summary.field_considered) return "";
  constexpr CovariateSpec magnetic = covariate("field");
  return fmt::format(
      "Filter {}: the magnetic field is assumed, a dipole's within {:.2f} {} an axis; that error "
      "is "
      "in the sigmas. Declare field_n, field_w, field_u in [environment].",
      v.spec().name, preparation::beside_dipole / magnetic.unit.to_si, magnetic.unit.symbol.view());
}

std::string remembered_text(const FilterView& v) {
  const identification::FilterRun& run = v.id.counted(v.summary);
  std::string said = memory_sentences(run.memory_doubt, run.memory_gaps, v.id.names);
  if (said.empty()) return "";
  said.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(said.front())));
  return fmt::format("Filter {}: {}", v.spec().name, said);
}

std::vector<std::string> headlines(const mc::Study& study,
                                   const identification::Identification& id) {
  std::vector<std::string> all;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView view{study, id, s};
    for (const std::string& said : sentences_of(view))
      all.push_back(fmt::format("Filter {}: {}", view.name(), said));
  }
  return all;
}

}  // namespace drift::report
