#include "analysis/identification/latitude_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/stats/chi_square_band.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

using inference::SiteLimits;

constexpr auto d_lat = TermLibrary::index("d_lat");

constexpr double pole = 90.0 * detail::deg;

double from_pole_to_pole(double latitude) {
  return std::clamp(latitude, -pole, pole);
}

/// The fit with the study at one latitude.
struct Point {
  double latitude = 0.0;
  double cost = std::numeric_limits<double>::infinity();
  double dof = 1.0;
  Theta theta = Theta::Zero();
  std::vector<Vec3> psi0_l = {};
  double of_priors = 0.0;  ///< part of the cost
  double per_dof() const { return cost / dof; }
};

class Latitudes {
 public:
  Latitudes(const mc::Study& study, const std::vector<Recording>& recordings,
            const FilterSpec& filter)
      : study_(study), recordings_(recordings), filter_(filter) {}

  std::vector<Point> at(const std::vector<double>& latitudes,
                        int iterations = BatchOptions{}.max_iterations) const {
    return mc::run_campaign(latitudes.size(), [&](std::size_t k) {
      return point(latitudes[k], {.max_iterations = iterations}, nullptr);
    });
  }
  /// The same from a fit that is not far away.
  std::vector<Point> beside(const Point& from, const std::vector<double>& latitudes) const {
    return mc::run_campaign(latitudes.size(),
                            [&](std::size_t k) { return point(latitudes[k], {}, &from); });
  }

 private:
  Point point(double latitude, BatchOptions options, const Point* from) const {
    Point p{latitude};
    if (!(std::abs(latitude) <= pole)) return p;
    mc::Study study = study_;
    study.site.latitude = latitude;
    try {
      const preparation::RecordedTest test = preparation::recorded_test(study, recordings_);
      const MeasuredTest measured{test.timeline, study.readout, test.measured};
      options.result = BatchOptions::Result::estimates;
      const BatchResult fit =
          from ? fit_batch_from(filter_, measured, from->theta, from->psi0_l, options)
               : fit_batch(filter_, measured, make_layout(filter_).theta, options);
      p.theta = theta_of(filter_, fit);
      p.psi0_l = fit.psi0_l;
      p.cost = fit.estimate.statistic;
      p.of_priors = p.cost - fit.data_chi2;
      p.dof = static_cast<double>(std::max<std::size_t>(1, fit.estimate.measured));
    } catch (const InputError&) {
      // No case heading holds this plan at that latitude.
    }
    return p;
  }

  const mc::Study& study_;
  const std::vector<Recording>& recordings_;
  const FilterSpec& filter_;
};

}  // namespace

bool LatitudeDoubt::alone() const {
  return as_little_left || chance_after >= inference::SearchLimits::alpha;
}

bool LatitudeDoubt::as_surveyed() const {
  return sigma < SiteLimits::survey * TermLibrary::specs[d_lat].prior_si().sigma();
}

double LatitudeDoubt::prior_sigmas() const {
  return std::abs(latitude - declared) / TermLibrary::specs[d_lat].prior_si().sigma();
}

void LatitudeDoubt::weigh(double chi2_above) {
  if (sigma > 0.0)
    log_evidence = 0.5 * chi2_above + 0.5 * std::log(2.0 * std::numbers::pi) + std::log(sigma) -
                   std::log(std::numbers::pi);
}

bool LatitudeDoubt::evident() const {
  return log_evidence + std::log(SiteLimits::another) > 0.0 && prior_sigmas() > SiteLimits::survey;
}

bool LatitudeDoubt::explains() const {
  const double excess = chi2_per_dof_before - 1.0;
  return excess > 0.0 && chi2_per_dof_before - chi2_per_dof_after >= SiteLimits::most * excess;
}

bool LatitudeDoubt::is_on_other_hemisphere() const {
  return std::abs(latitude + declared) < 0.1 * std::abs(latitude - declared);
}

std::optional<LatitudeDoubt> latitude_doubt(const mc::Study& study,
                                            const std::vector<Recording>& recordings,
                                            const FilterSpec& filter, Reach reach) {
  const Latitudes latitudes(study, recordings, filter);
  const double declared = study.site.latitude;
  Point before = latitudes.at({declared}).front();
  if (!std::isfinite(before.cost) || before.per_dof() <= 1.0) return std::nullopt;
  Point best = before;
  const auto take = [&](const std::vector<Point>& points) {
    for (const Point& p : points)
      if (p.cost < best.cost) best = p;
  };
  // Near the truth the cost grows with the square of the error: its parabola leads there, the
  // better the smaller the step. Far from it the cost may be concave: then several distances are
  // tried at once. At a pole there is one side: it promises.
  const double small = 0.2 * detail::deg;
  const std::vector<Point> beside = latitudes.beside(before, {declared - small, declared + small});
  const double bend = beside[0].cost + beside[1].cost - 2.0 * before.cost;
  const double foot = std::pow(beside[1].cost - beside[0].cost, 2) / (8.0 * bend);
  const bool promising = !(bend > 0.0 && foot < SiteLimits::promise * (before.cost - before.dof));
  if (!promising && reach == Reach::where_it_promises) return std::nullopt;
  // The Earth's rate goes with sine and cosine of the latitude: no valley lies between these.
  std::vector<double> everywhere{-declared};
  for (double deg = -75.0; deg < 80.0; deg += 15.0) everywhere.push_back(deg * detail::deg);
  take(latitudes.at(everywhere, inference::EffortLimits::blindly));
  if (!promising && best.latitude == declared) return std::nullopt;
  take(latitudes.at({best.latitude}));  // to its end
  double information = 0.0;             // on the latitude [1/rad^2], by the bend of the cost
  const auto follow = [&](std::initializer_list<double> steps_deg) {
    double last_step = 0.0, last_latitude = 0.0;
    for (const double step_deg : steps_deg) {
      const double step = step_deg * detail::deg;
      if (step == last_step && best.latitude == last_latitude) continue;  // it led nowhere
      const Point here = best;
      last_step = step;
      last_latitude = here.latitude;
      // Beside a pole all three lie on its side.
      const double middle = std::clamp(here.latitude, step - pole, pole - step);
      std::vector<double> beside_it{from_pole_to_pole(middle - step),
                                    from_pole_to_pole(middle + step)};
      if (middle != here.latitude) beside_it.push_back(middle);
      const std::vector<Point> sides = latitudes.at(beside_it);
      const double of_middle = sides.size() > 2 ? sides[2].cost : here.cost;
      const double curvature = sides[0].cost + sides[1].cost - 2.0 * of_middle;
      if (!std::isfinite(curvature)) return;
      information = curvature / (2.0 * step * step);
      if (curvature > 0.0) {
        take(latitudes.at({from_pole_to_pole(middle + 0.5 * step * (sides[0].cost - sides[1].cost) /
                                                          curvature)}));
      } else {
        std::vector<double> around;
        for (const double far : {4.0, 8.0, 16.0, 32.0, 64.0})
          for (const double sign : {-1.0, 1.0})
            around.push_back(here.latitude + sign * far * detail::deg);
        take(latitudes.at(around));
      }
      take(sides);
    }
  };
  follow({2.0, 2.0, 2.0, 0.2});
  take(latitudes.at({-best.latitude}));  // the mirrored valley is nearly as deep
  follow({0.2, 0.02, 0.005});
  // The way there may have led out of a local minimum: then the declared latitude does as well.
  if (const Point again = latitudes.beside(best, {declared}).front(); again.cost < before.cost)
    before = again;
  LatitudeDoubt doubt{
      best.latitude,    declared,       information > 0.0 ? 1.0 / std::sqrt(information) : 0.0,
      before.per_dof(), best.per_dof(), stats::misfit_chance(best.per_dof(), best.dof)};
  const double gain = (before.cost - best.cost) / std::max(1.0, best.per_dof());
  doubt.weigh(gain);
  if (!doubt.evident()) return std::nullopt;
  // Both hemispheres leave one trace but for isotropic D_I: their priors tell which it is. What the
  // data gain beside them is another local minimum's.
  if (doubt.is_on_other_hemisphere() && best.of_priors >= before.of_priors) return std::nullopt;
  doubt.mirrored = doubt.is_on_other_hemisphere() && gain > inference::FitLimits::mirrored;
  if (!doubt.explains() && !doubt.mirrored) return std::nullopt;
  if (!doubt.explains()) return doubt;
  doubt.clock = clock_doubt(study, recordings, filter, best.latitude);
  if (!doubt.clock)
    doubt.or_clock = clock_instead(study, recordings, filter, best.latitude, doubt.sigma);
  return doubt;
}

}  // namespace drift::identification
