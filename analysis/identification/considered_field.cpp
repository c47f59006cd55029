#include "analysis/identification/considered_field.hpp"

#include <cmath>

#include "analysis/identification/field_found.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

bool has_followers(const Layout& layout) {
  for (const std::size_t param : layout.params)
    if (follows_field(TermLibrary::owner(param))) return true;
  return false;
}

/// What one sigma of the field along each axis changes, in prior sigmas; shape (parameters, 3).
Mat3X change_per_sigma(const mc::Study& study, const preparation::RecordedTest& test,
                       const FilterSpec& filter) {
  constexpr double part = 0.25;  // of a sigma, to either side
  const Layout layout = make_layout(filter);
  const Vec3 assumed_l = preparation::dipole_field_l(study.site.latitude);
  const auto fits = mc::run_campaign(6, [&](std::size_t k) {
    Timeline timeline = test.timeline;
    timeline.set_vector(covariate("field"), assumed_l + (k % 2 ? -part : part) *
                                                            preparation::beside_dipole *
                                                            Vec3::Unit(static_cast<int>(k / 2)));
    return fit_batch(filter, {timeline, study.readout, test.measured}, layout.theta,
                     {.result = BatchOptions::Result::estimates})
        .estimate.parameters;
  });
  Mat3X change(3, layout.size());
  for (std::size_t k = 0; k < layout.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      change(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(k)) =
          (fits[2 * axis][k].value - fits[2 * axis + 1][k].value) /
          (2.0 * part * layout.sigma[static_cast<Eigen::Index>(k)]);
  return change;
}

void add(const Mat3X& change, EstimateResult& estimate) {
  if (estimate.covariance.rows() != change.cols()) return;  // it failed
  estimate.covariance += change.transpose() * change;
  for (std::size_t k = 0; k < estimate.parameters.size(); ++k) {
    ParameterEstimate& p = estimate.parameters[k];
    p.sigma = std::hypot(p.sigma, p.prior_sigma * change.col(static_cast<Eigen::Index>(k)).norm());
  }
}

}  // namespace

void consider_field(const mc::Study& study, const preparation::RecordedTest& test,
                    Identification& id) {
  if (test.field != preparation::FieldKnown::assumed) return;
  for (FilterSummary& s : id.summaries) {
    if (!has_followers(s.layout)) continue;
    const Mat3X change = change_per_sigma(study, test, study.filters[s.filter]);
    s.field_considered = true;
    for (FilterRun& run : id.runs) {
      if (run.filter != s.filter) continue;
      add(change, run.ekf);
      add(change, run.batch.estimate);
    }
  }
}

}  // namespace drift::identification
