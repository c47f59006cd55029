#pragma once

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"

namespace drift::test {

/// An estimator by name, from a recording to a result.
struct Estimator {
  std::string_view name;
  EstimateResult (*run)(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                        const Measurements& measured, const Theta& start);
};

inline EstimateResult by_ekf(const FilterSpec& filter, const Timeline& timeline,
                             const Readout& readout, const Measurements& measured,
                             const Theta& start) {
  return run_ekf(filter, {timeline, readout, measured}, start);
}

inline EstimateResult by_iterated_ekf(const FilterSpec& filter, const Timeline& timeline,
                                      const Readout& readout, const Measurements& measured,
                                      const Theta& start) {
  const Layout layout = make_layout(filter);
  IteratedPasses passes(filter, timeline, readout, start);
  const FilterEstimate& found = passes.run(measured, start);
  EstimateResult r;
  r.status = found.status();
  r.cause = found.cause();
  r.covariance = found.settled_covariance();
  r.parameters = parameter_estimates(layout, layout.scaled(start), found.x(), r.covariance);
  r.statistic = found.nis();
  r.measured = found.scalars();
  return r;
}

inline EstimateResult by_batch(const FilterSpec& filter, const Timeline& timeline,
                               const Readout& readout, const Measurements& measured,
                               const Theta& start) {
  return fit_batch(filter, {timeline, readout, measured}, start).estimate;
}

/// Those that go through the measurements in order, and so can have process noise.
inline constexpr Estimator sequential_estimators[] = {{"ekf", by_ekf},
                                                      {"iterated", by_iterated_ekf}};
inline constexpr Estimator every_estimator[] = {
    {"ekf", by_ekf}, {"iterated", by_iterated_ekf}, {"batch", by_batch}};

}  // namespace drift::test
