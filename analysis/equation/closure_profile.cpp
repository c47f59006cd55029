#include "analysis/equation/closure_profile.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/equation/held_parameter.hpp"
#include "mc/task/campaign.hpp"

namespace drift::equation {
namespace {

/// The model with lambda held; the log includes the prior of lambda.
using Point = HeldFit;

class Profiler {
 public:
  Profiler(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& joint,
           const VecX& weight, const inference::NoiseModel& noise)
      : filter_(filter),
        test_(test),
        joint_(joint),
        weight_(weight),
        noise_(noise),
        prior_(filter.priors[closure_param]) {}

  std::vector<Point> at(const std::vector<double>& values) const {
    return mc::run_campaign(values.size(), [&](std::size_t k) { return point(values[k]); });
  }

 private:
  Point point(double value) const {
    Point p = fit_held(filter_, test_, joint_, closure_param, value, weight_, noise_);
    p.log2 -= loss_by_prior_of_lambda(prior_, value);
    return p;
  }

  const FilterSpec& filter_;
  const MeasuredTest& test_;
  const BatchResult& joint_;
  const VecX& weight_;
  const inference::NoiseModel& noise_;
  Prior prior_;
};

}  // namespace

ClosureWeighed weigh_closure(const FilterSpec& filter, const MeasuredTest& test,
                             const BatchResult& joint, const VecX& weight,
                             const inference::NoiseModel& noise, double decisive) {
  const ParameterEstimate* found = joint.estimate.find(closure_param);
  if (found == nullptr) return {};
  const Profiler profiler(filter, test, joint, weight, noise);
  std::vector<Point> points = profiler.at({0.0, 1.0, found->value});
  const std::array<double, 2> at_end{points[0].log2, points[1].log2};
  const double end = at_end[0] > at_end[1] ? 0.0 : 1.0;
  const auto weighed = [&](double most) {
    return ClosureWeighed{{most - at_end[0], most - at_end[1]}, {}};
  };
  const double better_end = std::max(at_end[0], at_end[1]);
  if (better_end < points[2].log2 + decisive) return weighed(std::max(better_end, points[2].log2));
  const auto take = [&](const std::vector<double>& values) {
    for (Point& p : profiler.at(values)) points.push_back(std::move(p));
  };
  // How fast it falls around the top is not known beforehand: steps that grow.
  const auto look_around = [&](double value) {
    std::vector<double> around;
    for (const double step : {0.005, 0.02, 0.06, 0.15, 0.35})
      for (const double sign : {-1.0, 1.0}) around.push_back(value + sign * step);
    take(around);
  };
  const auto top = [&]() -> const Point& {
    return *std::ranges::max_element(points, {}, &Point::log2);
  };
  take({0.25, 0.5, 0.75});
  look_around(end);
  // Where the joint fit ended beside its optimum, that may be anywhere between.
  for (int k = 0; k < 2 && top().value != end; ++k) look_around(top().value);
  std::ranges::sort(points, {}, &Point::value);
  const double most = top().log2;

  // The log runs straight between the points; moments of its exponential by fine steps.
  double mass = 0.0, first = 0.0, second = 0.0;
  constexpr int fine = 200;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double width = points[k + 1].value - points[k].value;
    for (int i = 0; i < fine; ++i) {
      const double part = (i + 0.5) / fine, x = points[k].value + part * width;
      const double p =
          std::exp(0.5 * ((1.0 - part) * points[k].log2 + part * points[k + 1].log2 - most)) *
          width / fine;
      mass += p;
      first += p * x;
      second += p * x * x;
    }
  }
  ClosureWeighed out = weighed(most);
  out.profile.emplace();
  ClosureProfile& p = *out.profile;
  p.value = first / mass;
  p.sigma = std::sqrt(std::max(0.0, second / mass - p.value * p.value));
  p.fit = std::move(profiler.at({p.value}).front().fit);
  return out;
}

}  // namespace drift::equation
