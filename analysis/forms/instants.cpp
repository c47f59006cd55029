#include "analysis/forms/instants.hpp"

#include <fmt/format.h>

#include <functional>

#include "core/physics/own/own_terms.hpp"

namespace drift::forms {
namespace {

/// The middle of an interval.
struct Middle {
  const Interval* interval;
  const Node* node;
  double between(double at0, double at1) const { return 0.5 * (at0 + at1); }
};

class Path {
 public:
  explicit Path(const Timeline& timeline) {
    for (const Interval& i : timeline.intervals)
      middles_.push_back({&i, &timeline.nodes[i.middle_node()]});
  }
  VecX of(const std::function<double(const Middle&)>& value) const {
    VecX out(static_cast<Eigen::Index>(middles_.size()));
    for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = value(middles_[k]);
    return out;
  }
  const std::vector<Middle>& middles() const { return middles_; }

 private:
  std::vector<Middle> middles_;
};

/// Covariates by the names that equations have for them.
std::vector<Quantity> covariates_of(const Timeline& timeline, const Path& path) {
  std::vector<Quantity> out;
  for (const CovariateSpec& c : known_covariates) {
    if (!timeline.carries(c)) continue;
    const double unit = c.unit.to_si;
    for (int a = 0; c.is_vector() && a < 3; ++a)
      out.push_back(
          {fmt::format("({}_{}/{:g})", c.name, "xyz"[a], unit), 0, path.of([&](const Middle& m) {
             const Vec3 value_l =
                 0.5 * (m.interval->around0.vector(c) + m.interval->around1.vector(c));
             return value_l.dot(m.node->R_lr.col(a)) / unit;
           })});
    if (c.is_vector()) continue;
    out.push_back({fmt::format("({}/{:g})", c.name, unit), 0, path.of([&](const Middle& m) {
                     return m.between(m.interval->around0[c], m.interval->around1[c]) / unit;
                   })});
    out.push_back(
        {fmt::format("({}_rate*{:g})", c.name, 3600.0 / unit), 0, path.of([&](const Middle& m) {
           return (m.interval->around1[c] - m.interval->around0[c]) / m.interval->length() *
                  (3600.0 / unit);
         })});
  }
  for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
    if ((timeline.carried & further_column(k)) != 0)
      out.push_back({own_terms().covariates[k], 0, path.of([&](const Middle& m) {
                       return m.between(m.interval->around0.further(k),
                                        m.interval->around1.further(k));
                     })});
  return out;
}

}  // namespace

Instants instants_of(const Timeline& timeline) {
  const Path path(timeline);
  Instants out;
  out.t = path.of([](const Middle& m) { return m.node->t - m.interval->t_begin; });
  out.t_position = path.of(
      [](const Middle& m) { return m.interval->slew ? 0.0 : m.node->t - m.interval->t_dwell; });
  for (const Middle& m : path.middles()) out.position.push_back(m.interval->position);
  for (int a = 0; a < 3; ++a) {
    out.force[a] = path.of([&](const Middle& m) { return m.node->R_lr(2, a); });
    out.gimbal[a] = path.of([&](const Middle& m) {
      const double heading = m.between(m.interval->heading0, m.interval->heading1);
      return gimbal_angles<double>(case_attitude(heading).transpose() * m.node->R_lr)[a];
    });
  }
  std::vector<Quantity> all;
  for (int a = 0; a < 3; ++a) all.push_back({fmt::format("f_{}", "xyz"[a]), 1, out.force[a]});
  const double earth = detail::earth_rate;  // rates as parts of the Earth's: of order one
  for (int a = 0; a < 3; ++a)
    all.push_back(
        {fmt::format("(omega_ic_{}/{:.4g})", "xyz"[a], earth), 0, path.of([&](const Middle& m) {
           return m.node->omega_ic_l.dot(m.node->R_lr.col(a)) / earth;
         })});
  for (int a = 0; a < 3; ++a)
    all.push_back({fmt::format("(cmd_{}/{:.4g})", "xyz"[a], earth), 0,
                   path.of([&](const Middle& m) { return m.interval->omega_cmd_p[a] / earth; })});
  for (Quantity& q : covariates_of(timeline, path)) all.push_back(std::move(q));
  for (Quantity& q : all)
    if (q.value.cwiseAbs().maxCoeff() > 0.0) out.quantities.push_back(std::move(q));
  return out;
}

}  // namespace drift::forms
