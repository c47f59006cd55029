#include "analysis/strapdown/case_held_out.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/nan.hpp"
#include "core/base/shuffle.hpp"
#include "mc/task/campaign.hpp"

namespace drift::strapdown {
namespace {

/// The part of each dwell: one after the other, and shuffled in further divisions.
std::vector<int> parts_of_dwells(std::size_t dwells, int folds, int repeat, std::uint64_t seed) {
  std::vector<int> part(dwells);
  for (std::size_t d = 0; d < dwells; ++d) part[d] = static_cast<int>(d) % folds;
  if (repeat == 0) return part;
  Stream stream(seed, static_cast<std::uint64_t>(repeat), Purpose::design);
  shuffle(part, stream);
  return part;
}

/// The test without what was measured in one part of the dwells.
Measurements without_part(const CaseTest& test, const std::vector<int>& part, int left_out) {
  Measurements m = test.measured;
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i)
    if (part[static_cast<std::size_t>(test.timeline.intervals[i].position)] == left_out) {
      m.acc.col(static_cast<Eigen::Index>(i)).setConstant(nan_value);
      m.gimbal.col(static_cast<Eigen::Index>(i)).setConstant(nan_value);
    }
  return m;
}

/// Without those of dwells that are no rest.
std::vector<double> known(const std::vector<double>& errors) {
  std::vector<double> all;
  std::ranges::copy_if(errors, std::back_inserter(all), [](double e) { return std::isfinite(e); });
  return all;
}

/// Root mean squares over the repeats, of dwells and ways when they were left out.
CaseErrors held_out(const FilterSpec& filter, const CaseStudy& of, const Division& division,
                    const Theta& found, std::uint64_t seed) {
  const auto folds = static_cast<std::size_t>(division.folds),
             repeats = static_cast<std::size_t>(division.repeats);
  std::vector<std::vector<int>> parts;
  for (int r = 0; r < division.repeats; ++r)
    parts.push_back(parts_of_dwells(of.search.dwells.size(), division.folds, r, seed));
  const auto all = mc::run_campaign(folds * repeats, [&](std::size_t task) {
    const Measurements left =
        without_part(of.test, parts[task / folds], static_cast<int>(task % folds));
    const BatchResult fit = fit_batch(filter, {of.test.timeline, of.test.readout, left}, found,
                                      {.result = BatchOptions::Result::estimates});
    return case_errors(of.test, filter.model(), theta_of(filter, fit), fit.psi0_l);
  });
  CaseErrors out;
  const auto gather = [&](std::vector<double> CaseErrors::*kind, auto&& dwell_of) {
    std::vector<double>& into = out.*kind;
    into.assign((all.front().*kind).size(), 0.0);
    for (std::size_t k = 0; k < into.size(); ++k) {
      for (std::size_t r = 0; r < repeats; ++r) {
        const auto part = static_cast<std::size_t>(parts[r][dwell_of(k)]);
        into[k] += std::pow((all[r * folds + part].*kind)[k], 2) / static_cast<double>(repeats);
      }
      into[k] = std::sqrt(into[k]);
    }
  };
  const auto itself = [](std::size_t dwell) { return dwell; };
  gather(&CaseErrors::gyro, itself);
  gather(&CaseErrors::gravity, itself);
  gather(&CaseErrors::up, [&](std::size_t way) { return of.test.ways[way] - 1; });
  return out;
}

}  // namespace

Division division_of(const CaseStudy& of) {
  constexpr int least = 6, one_way = 12, repeats = 2;
  const auto dwells = static_cast<int>(of.search.dwells.size());
  // With fewer the fit without a part would know little of what it predicts.
  if (dwells < least) return {};
  return of.compass.sees_earth ? Division{least, 1} : Division{std::min(dwells, one_way), repeats};
}

CaseScores scores_of(const FilterSpec& filter, const BatchResult& fit, const CaseStudy& of,
                     const Division& division, std::uint64_t seed) {
  if (division.folds == 0) return {};
  const Theta found = theta_of(filter, fit);
  const CaseErrors in = case_errors(of.test, filter.model(), found, fit.psi0_l),
                   held = held_out(filter, of, division, found, seed);
  return {score_of(in.up, held.up, unit::deg.to_si, seed),
          score_of(known(in.gyro), known(held.gyro), unit::deg_per_h.to_si, seed),
          score_of(in.gravity, held.gravity, 1.0, seed)};
}

}  // namespace drift::strapdown
