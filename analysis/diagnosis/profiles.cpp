#include "analysis/diagnosis/profiles.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/equation/held_parameter.hpp"
#include "core/stats/normal.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

/// Where a parameter is to be held, and in which model.
struct Hold {
  std::size_t profile = 0;
  const search::Refit* model = nullptr;
  double value = 0.0;    ///< SI
  double penalty = 0.0;  ///< of the prior, twice its log
};

/// The prior that a profile counts; without a sigma where none is.
Prior counted_prior(const search::Search& found, const search::CauseParameter& p) {
  return p.profiled ? fixed(0.0) : found.nominal.filter.believed(p.param);
}

std::vector<double> held_values(const search::CauseParameter& p) {
  const double unit = TermLibrary::specs[p.param].unit.to_si;
  std::vector<double> values;
  for (const double sigmas : {-3.0, -1.5, 0.0, 1.5, 3.0})
    values.push_back((p.value + sigmas * p.sigma) * unit);
  if (p.param == closure_param) values.insert(values.end(), {0.0, 1.0});
  std::ranges::sort(values);
  const double least = 1e-6 * p.sigma * unit;
  // Not std::ranges::unique: its subrange is beyond clang 14.
  const auto same = [&](double a, double b) { return std::abs(a - b) <= least; };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
  return values;
}

/// Vertex of the parabola through the least of the points and its neighbours; the least point
/// itself at an end.
Profile::Point vertex_of(const std::vector<Profile::Point>& points) {
  const auto least = std::ranges::min_element(points, {}, &Profile::Point::loss);
  if (least == points.begin() || least + 1 == points.end()) return *least;
  const double a = (least - 1)->value - least->value, b = (least + 1)->value - least->value;
  const double fa = (least - 1)->loss - least->loss, fb = (least + 1)->loss - least->loss;
  const double square = (fb / b - fa / a) / (b - a), slope = fa / a - square * a;
  if (!(square > 0.0)) return *least;
  const double at = -0.5 * slope / square;
  return {least->value + at, least->loss + 0.5 * slope * at};
}

}  // namespace

Profile with_interval(Profile profile) {
  std::vector<Profile::Point>& points = profile.points;
  std::ranges::sort(points, {}, &Profile::Point::value);
  const Profile::Point top = vertex_of(points);
  profile.top = top.value;
  for (Profile::Point& p : points) p.loss = std::max(0.0, p.loss - top.loss);
  const auto crossing = [&](double side) {
    double x = top.value, root = 0.0;
    std::vector<Profile::Point> outward;
    for (const Profile::Point& p : points)
      if (side * (p.value - top.value) > 0.0) outward.push_back(p);
    if (side < 0.0) std::ranges::reverse(outward);
    for (const Profile::Point& p : outward) {
      const double next = std::sqrt(p.loss);
      if (next >= stats::half_width_95)
        return x + (p.value - x) * (stats::half_width_95 - root) / (next - root);
      x = p.value;
      root = next;
    }
    return std::nan("");
  };
  profile.low_95 = crossing(-1.0);
  profile.high_95 = crossing(1.0);
  return profile;
}

std::vector<Profile> profiles_of(const search::Search& found, const MeasuredTest& test,
                                 const std::vector<search::Cause>& causes) {
  std::vector<Profile> profiles;
  std::vector<Hold> holds;
  for (const search::Cause& cause : causes)
    for (const search::CauseParameter& p : cause.parameters) {
      if (profiles.size() == most_profiles || !(p.sigma > 0.0)) continue;
      const search::Refit& model = found.sets[static_cast<std::size_t>(cause.set)];
      if (!model.after.fit.estimate.find(p.param)) continue;
      const Prior prior = counted_prior(found, p);
      for (const double value : held_values(p)) {
        const double off = prior.sigma() > 0.0 ? (value - prior.mean()) / prior.sigma() : 0.0;
        holds.push_back({profiles.size(), &model, value, off * off});
      }
      profiles.push_back({.label = search::keyed(cause.term, cause.axis),
                          .key = p.key,
                          .unit = p.unit,
                          .param = p.param,
                          .value = p.value,
                          .sigma = p.sigma});
    }
  const auto losses = mc::run_campaign(holds.size(), [&](std::size_t k) {
    const Hold& hold = holds[k];
    const search::Fitted& after = hold.model->after;
    return hold.penalty - equation::fit_held(hold.model->filter, test, after.fit,
                                             profiles[hold.profile].param, hold.value,
                                             after.problem.weight, after.noise.model)
                              .log2;
  });
  for (std::size_t k = 0; k < holds.size(); ++k) {
    Profile& profile = profiles[holds[k].profile];
    const double unit = TermLibrary::specs[profile.param].unit.to_si;
    if (std::isfinite(losses[k])) profile.points.push_back({holds[k].value / unit, losses[k]});
  }
  std::erase_if(profiles, [](const Profile& p) { return p.points.size() < 3; });
  for (Profile& p : profiles) p = with_interval(std::move(p));
  return profiles;
}

void set_intervals(std::vector<search::Cause>& causes, const std::vector<Profile>& profiles) {
  for (search::Cause& cause : causes)
    for (search::CauseParameter& p : cause.parameters)
      for (const Profile& profile : profiles) {
        if (profile.param != p.param || profile.label != search::keyed(cause.term, cause.axis))
          continue;
        p.low_95 = profile.low_95;
        p.high_95 = profile.high_95;
      }
}

}  // namespace drift::diagnosis
