#include "analysis/diagnosis/profiles.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/causes.hpp"
#include "analysis/diagnosis/profile_interval.hpp"
#include "analysis/equation/held_parameter.hpp"
#include "core/stats/normal.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

/// A profile in the making: of which parameter in which model.
struct Profiled {
  Profile profile;
  const search::Refit* model = nullptr;
  FilterSpec filter;  ///< of the refits: without the priors of settings that left their grids
  Prior prior;        ///< that counts; without a sigma where none does
  std::vector<Profile::Point> points = {};  ///< losses counted from one place
};

/// A point of one of them that is asked for.
struct Hold {
  std::size_t profile = 0;
  double value = 0.0;  ///< SI
};

/// The prior that a profile counts: that with which the value was found, which is wider than the
/// library's where a size is far beyond it.
Prior counted_prior(const search::Refit& model, const search::CauseParameter& p) {
  return p.profiled ? fixed(0.0) : model.filter.believed(p.param);
}

/// Where the data took settings beyond the library's grid the prior that stands for the distance of
/// its points says nothing any more, neither of a setting nor of the size that goes with it.
FilterSpec without_grid(const search::Refit& model, const std::vector<std::size_t>& settings) {
  constexpr double nothing = 1e3;  // times the setting, as a sigma
  FilterSpec filter = model.filter;
  for (const std::size_t i : settings) {
    const double value = model.after.fit.estimate.find(i)->value;
    filter.priors[i] = normal(value, nothing * std::abs(value));
  }
  return filter;
}

/// A setting, such as a time constant or a moment, keeps its sign: what would lie beyond zero lies
/// half way there from `near`.
double of_its_sign(std::size_t param, double value, double near) {
  return TermLibrary::specs[param].continuous() && value * near <= 0.0 ? 0.5 * near : value;
}

/// The value that was found, and those at which other fits of the same causes ended, in other
/// valleys of a setting, each with 1.5 and 3 of its sigmas to either side; SI.
std::vector<double> held_values(const search::Search& found, const search::Refit& model,
                                const search::CauseParameter& p) {
  const double unit = TermLibrary::specs[p.param].unit.to_si;
  std::vector<double> values;
  const auto hold_about = [&](double value, double sigma) {
    values.push_back(value);
    for (const double side : {-1.0, 1.0}) {
      const double near = of_its_sign(p.param, value + side * 1.5 * sigma, value);
      values.insert(values.end(), {near, of_its_sign(p.param, value + side * 3.0 * sigma, near)});
    }
  };
  hold_about(p.value * unit, p.sigma * unit);
  if (p.profiled)
    for (const search::Refit& other : found.beside)
      if (const ParameterEstimate* e = other.after.fit.estimate.find(p.param);
          e && search::same_causes(model.choices, other.choices))
        hold_about(e->value, e->sigma);
  if (p.param == closure_param) values.insert(values.end(), {0.0, 1.0});
  std::ranges::sort(values);
  const double least = 1e-6 * p.sigma * unit;
  // Not std::ranges::unique: its subrange is beyond clang 14.
  const auto same = [&](double a, double b) { return std::abs(a - b) <= least; };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
  return values;
}

/// Where refits are wanted next, SI.
std::vector<double> next_values(const Profile& p, double outward) {
  std::vector<double> values = wanted_points(p, outward);
  const double nearest_zero = std::ranges::min(p.points, {}, [](const Profile::Point& at) {
                                return std::abs(at.value);
                              }).value;
  for (double& v : values)
    v = of_its_sign(p.param, v, nearest_zero) * TermLibrary::specs[p.param].unit.to_si;
  return values;
}

/// Twice the log of the likelihood that a held value loses, counted from anywhere.
double loss_at(const Profiled& p, const MeasuredTest& test, double value) {
  const search::Fitted& after = p.model->after;
  const auto loss_by_prior = [&] {
    if (p.profile.param == closure_param) return equation::loss_by_prior_of_lambda(p.prior, value);
    return p.prior.sigma() > 0.0 ? std::pow((value - p.prior.mean()) / p.prior.sigma(), 2) : 0.0;
  };
  return loss_by_prior() - equation::fit_held(p.filter, test, after.fit, p.profile.param, value,
                                              after.problem.weight, after.noise.model)
                               .log2;
}

/// Refits at these values, spread over threads; tops and intervals with them.
void take(std::vector<Profiled>& all, const std::vector<Hold>& holds, const MeasuredTest& test) {
  const auto losses = mc::run_campaign(holds.size(), [&](std::size_t k) {
    return loss_at(all[holds[k].profile], test, holds[k].value);
  });
  for (std::size_t k = 0; k < holds.size(); ++k) {
    Profiled& p = all[holds[k].profile];
    const double unit = TermLibrary::specs[p.profile.param].unit.to_si;
    if (std::isfinite(losses[k])) p.points.push_back({holds[k].value / unit, losses[k]});
  }
  std::erase_if(all, [](const Profiled& p) { return p.points.size() < 3; });
  for (Profiled& p : all) {
    p.profile.points = p.points;
    p.profile = with_interval(std::move(p.profile));
  }
}

}  // namespace

std::vector<Profile> profiles_of(const search::Search& found, const MeasuredTest& test,
                                 const std::vector<search::Cause>& causes) {
  std::vector<Profiled> all;
  std::vector<Hold> holds;
  for (const search::Cause& cause : causes)
    for (const search::CauseParameter& p : cause.parameters) {
      if (all.size() == most_profiles || !(p.sigma > 0.0)) continue;
      const search::Refit& model = found.sets[static_cast<std::size_t>(cause.set)];
      if (!model.after.fit.estimate.find(p.param)) continue;
      const auto beyond_grid = search::settings_beyond_grid(found.nominal.set, model);
      for (const double value : held_values(found, model, p)) holds.push_back({all.size(), value});
      all.push_back({{.label = search::keyed(cause.term, cause.axis),
                      .set = cause.set,
                      .key = p.key,
                      .unit = p.unit,
                      .param = p.param,
                      .value = p.value,
                      .sigma = p.sigma,
                      .without_grid = !beyond_grid.empty()},
                     &model,
                     without_grid(model, beyond_grid),
                     counted_prior(model, p)});
    }
  take(all, holds, test);
  constexpr double most_sigmas = 100.0;
  for (double sigmas = 1.5; sigmas < most_sigmas; sigmas *= 2.0) {
    holds.clear();
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const double value : next_values(all[k].profile, sigmas * all[k].profile.sigma))
        holds.push_back({k, value});
    if (holds.empty()) break;
    take(all, holds, test);
  }
  std::vector<Profile> profiles;
  for (Profiled& p : all) profiles.push_back(std::move(p.profile));
  return profiles;
}

void set_intervals(std::vector<search::Cause>& causes, const std::vector<Profile>& profiles,
                   const FilterSpec& nominal) {
  for (search::Cause& cause : causes)
    for (search::CauseParameter& p : cause.parameters)
      for (const Profile& profile : profiles) {
        if (profile.param != p.param || profile.set != cause.set ||
            profile.label != search::keyed(cause.term, cause.axis))
          continue;
        p.low_95 = profile.low_95;
        p.high_95 = profile.high_95;
        p.top = profile.top;
        p.without_grid = profile.without_grid;
        // Noise that drives the platform is not in the fit, and is in the refits: they are right.
        if (p.value < p.low_95 || p.value > p.high_95) {
          p.value = profile.top;
          // Nor is the sigma of a fit elsewhere that of this value.
          const double below = p.value - p.low_95, above = p.high_95 - p.value;
          p.sigma = std::fmax(below, above) / stats::half_width_95;
        }
        p.prior_sigmas = prior_sigmas(nominal, p.param, p.told());
      }
}

}  // namespace drift::diagnosis
