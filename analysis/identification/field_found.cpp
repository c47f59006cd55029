#include "analysis/identification/field_found.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/preparation/recorded_test.hpp"
#include "core/estimate/batch.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

constexpr double sigma = preparation::beside_dipole;

/// A size that is not known has a prior so much wider than the library's: a narrow one would rather
/// have a stronger field than a large effect.
constexpr double whatever_size = 100.0;

/// The parameters that follow the field.
std::vector<std::size_t> followers() {
  std::vector<std::size_t> all;
  for (const TermInfo& term : TermLibrary::terms)
    for (std::size_t i = term.first; follows_field(term) && i < term.first + term.count; ++i)
      all.push_back(i);
  return all;
}

FilterSpec with_followers(FilterSpec filter) {
  for (const std::size_t i : followers()) {
    const Prior prior = filter.believed(i);
    filter.active.set(i);
    filter.priors[i] =
        prior.sigma() > 0.0 ? normal(prior.mean(), whatever_size * prior.sigma()) : prior;
  }
  return filter;
}

/// The fit at one field, and a step to both sides along each axis.
struct Around {
  BatchResult here;
  std::array<BatchResult, 3> above, below;

  Vec3 gradient(const Vec3& step) const {
    Vec3 g;
    for (int j = 0; j < 3; ++j)
      g[j] = (above[j].estimate.statistic - below[j].estimate.statistic) / (2.0 * step[j]);
    return g;
  }
  /// Of the cost, by Gauss and Newton: what the fitted residuals change. Of a product, a size times
  /// a field, the cost itself bends both ways.
  Mat3 bend(const Vec3& step) const {
    std::array<VecX, 3> change;
    for (std::size_t j = 0; j < 3; ++j)
      change[j] = (residuals(above[j]) - residuals(below[j])) / (2.0 * step[static_cast<int>(j)]);
    Mat3 H;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) H(i, j) = 2.0 * change[i].dot(change[j]);
    return H;
  }

 private:
  static VecX residuals(const BatchResult& fit) {
    VecX all(fit.acc_residual.size() + fit.gimbal_residual.size());
    all << fit.acc_residual.reshaped(), fit.gimbal_residual.reshaped();
    return all.array().isFinite().select(all, 0.0);  // NaN: not measured
  }
};

class Fits {
 public:
  Fits(const mc::Study& study, const std::vector<Recording>& recordings, const FilterSpec& filter)
      : test_(preparation::recorded_test(study, recordings)),
        readout_(study.readout),
        filter_(with_followers(filter)) {}

  BatchResult at(const Vec3& field_l) const {
    Timeline timeline = test_.timeline;
    timeline.set_vector(covariate("field"), field_l);
    return fit_batch(filter_, {timeline, readout_, test_.measured}, make_layout(filter_).theta,
                     {.result = BatchOptions::Result::estimates});
  }

  Around around(const Vec3& field_l, const Vec3& step) const {
    std::vector<Vec3> fields{field_l};
    for (int j = 0; j < 3; ++j)
      for (const double sign : {1.0, -1.0})
        fields.push_back(field_l + sign * step[j] * Vec3::Unit(j));
    auto fits = mc::run_campaign(fields.size(), [&](std::size_t k) { return at(fields[k]); });
    Around out;
    out.here = std::move(fits[0]);
    for (std::size_t j = 0; j < 3; ++j) {
      out.above[j] = std::move(fits[1 + 2 * j]);
      out.below[j] = std::move(fits[2 + 2 * j]);
    }
    return out;
  }

 private:
  preparation::RecordedTest test_;
  Readout readout_;
  FilterSpec filter_;
};

std::vector<std::pair<std::size_t, Vec3>> slopes_of(const Around& a, const Vec3& step) {
  std::vector<std::pair<std::size_t, Vec3>> all;
  for (const std::size_t i : followers()) {
    Vec3 slope = Vec3::Zero();
    for (std::size_t j = 0; j < 3; ++j) {
      const ParameterEstimate* above = a.above[j].estimate.find(i);
      const ParameterEstimate* below = a.below[j].estimate.find(i);
      if (above && below)
        slope[static_cast<Eigen::Index>(j)] =
            (above->value - below->value) / (2.0 * step[static_cast<Eigen::Index>(j)]);
    }
    all.emplace_back(i, slope);
  }
  return all;
}

}  // namespace

bool follows_field(const TermInfo& term) {
  return (term.needs.covariates & covariate("field").set()) != 0;
}

double FieldFound::sigma_of(std::size_t param) const {
  const auto slope = std::ranges::find(slopes, param, &std::pair<std::size_t, Vec3>::first);
  return slope == slopes.end() ? 0.0 : std::sqrt(slope->second.dot(covariance * slope->second));
}

std::optional<FieldFound> field_found(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter) {
  constexpr int most_steps = 20;
  constexpr double stands_still = 0.1;  // [posterior sigma]
  const Fits fits(study, recordings, filter);
  FieldFound out;
  out.assumed_l = out.field_l = preparation::dipole_field_l(study.site.latitude);
  Vec3 step = Vec3::Constant(0.25 * sigma);
  double before = 0.0;  // cost of the dipole's
  for (int k = 0; k < most_steps; ++k) {
    const Around a = fits.around(out.field_l, step);
    if (k == 0) before = a.here.estimate.statistic;
    if (!std::isfinite(before)) return std::nullopt;
    // What is left above the degrees of freedom makes all costs less sure.
    const double scale = std::max(1.0, a.here.estimate.statistic_per_dof());
    const auto cost = [&](const BatchResult& fit, const Vec3& field_l) {
      return fit.estimate.statistic / scale +
             (field_l - out.assumed_l).squaredNorm() / (sigma * sigma);
    };
    const double here = cost(a.here, out.field_l);
    const Eigen::LLT<Mat3> bend(a.bend(step) / scale + Mat3::Identity() * (2.0 / (sigma * sigma)));
    out.covariance = 2.0 * bend.solve(Mat3::Identity());
    out.slopes = slopes_of(a, step);
    out.log_prior = 0.5 * std::log((out.covariance / (sigma * sigma)).determinant()) -
                    0.5 * (out.field_l - out.assumed_l).squaredNorm() / (sigma * sigma);
    out.log_evidence = 0.5 * (before - a.here.estimate.statistic) / scale + out.log_prior;
    const Vec3 sigmas = out.covariance.diagonal().cwiseSqrt();
    Vec3 newton = -bend.solve(a.gradient(step) / scale +
                              2.0 * (out.field_l - out.assumed_l) / (sigma * sigma));
    while (newton.cwiseQuotient(sigmas).norm() >= stands_still &&
           !(cost(fits.at(out.field_l + newton), out.field_l + newton) < here))
      newton *= 0.5;
    if (newton.cwiseQuotient(sigmas).norm() < stands_still) return out;
    out.field_l += newton;
    step = sigmas.cwiseMin(0.25 * sigma);
  }
  return std::nullopt;
}

}  // namespace drift::identification
