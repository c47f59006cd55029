#include "mc/statistics/failure_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/stats/normal.hpp"

namespace drift::mc {
namespace {

/// Decile of a value in the distribution it was drawn from.
std::size_t decile(const Prior& prior, double value) {
  const double u = prior.kind == Prior::Kind::normal
                       ? stats::normal_distribution((value - prior.a) / prior.b)
                       : (value - prior.a) / (prior.b - prior.a);
  return static_cast<std::size_t>(std::clamp(10.0 * u, 0.0, 9.0));
}

}  // namespace

FailureStatistics::FailureStatistics(const StudyColumns& columns, const Study& study) {
  for (std::size_t c = 0; c < columns.truth.size(); ++c) {
    const std::size_t p = columns.truth[c];
    if (study.truth.active[p] && study.truth.priors[p].sigma() > 0.0)
      drawn_.push_back({p, c, study.truth.priors[p]});
  }
}

void FailureStatistics::add(RunStatus status, std::uint64_t run, std::span<const double> row) {
  constexpr std::size_t most_listed = 20;
  ++by_status_[status];
  lost_.count(status != RunStatus::ok && status != RunStatus::filter_diverged);
  const bool failed = status != RunStatus::ok;
  if (failed && first_failed_.size() < most_listed) first_failed_.push_back(run);
  for (Drawn& d : drawn_)
    if (std::isfinite(row[d.column])) d.rate[decile(d.prior, row[d.column])].count(failed);
}

std::vector<FailureStatistics::Deciles> FailureStatistics::deciles() const {
  std::vector<Deciles> all;
  for (const Drawn& d : drawn_) {
    Deciles out{d.param, d.rate, 0.0};
    double hits = 0.0, of = 0.0;
    for (const stats::Rate& r : d.rate) {
      hits += static_cast<double>(r.hits);
      of += static_cast<double>(r.of);
    }
    const double p = of > 0.0 ? hits / of : 0.0;
    for (const stats::Rate& r : d.rate) {
      const double expected = p * static_cast<double>(r.of);
      if (expected > 0.0 && p < 1.0)
        out.chi2 += std::pow(static_cast<double>(r.hits) - expected, 2) / (expected * (1.0 - p));
    }
    all.push_back(out);
  }
  return all;
}

}  // namespace drift::mc
