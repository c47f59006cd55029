#include "core/sim/path_in_lanes.hpp"

#include <limits>

namespace drift {
namespace {

constexpr std::size_t width = static_cast<std::size_t>(Pack::width);
constexpr std::size_t most_in_piece = 33;
/// A round that changes less leaves a thirtieth of it: less than 1e-7 arcsec.
constexpr double small_enough = 1e-11;
constexpr int most_rounds = 12;

bool alike(const Interval& a, const Interval& b) {
  return a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop && a.rest == b.rest;
}

/// Integral of the polynomial through five values, unit distances, from the first to number n.
Vec3 quartic(const Vec3* f, std::size_t n) {
  constexpr double weight[5][5] = {
      {0.0, 0.0, 0.0, 0.0, 0.0},
      {251.0 / 720.0, 646.0 / 720.0, -264.0 / 720.0, 106.0 / 720.0, -19.0 / 720.0},
      {29.0 / 90.0, 124.0 / 90.0, 24.0 / 90.0, 4.0 / 90.0, -1.0 / 90.0},
      {27.0 / 80.0, 102.0 / 80.0, 72.0 / 80.0, 42.0 / 80.0, -3.0 / 80.0},
      {14.0 / 45.0, 64.0 / 45.0, 24.0 / 45.0, 64.0 / 45.0, 14.0 / 45.0}};
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 5; ++k) sum += weight[n][k] * f[k];
  return sum;
}

}  // namespace

PathInLanes::PathInLanes(const Timeline& timeline, const DriftModel& model)
    : timeline_(timeline),
      model_(model),
      terms_(model.terms, model.mounting, {}),
      theta_(Theta::Zero()),
      theta_together_(TermLibrary::num_params) {
  seen_.still.mounting = &model_.mounting;
  seen_.theta = theta_together_.data();
}

void PathInLanes::set_theta(const Theta& theta) {
  theta_ = theta;
  for (std::size_t k = 0; k < theta_together_.size(); ++k)
    theta_together_[k] = Pack(theta_[static_cast<Eigen::Index>(k)]);
}

/// Where each piece begins, and the end.
void PathInLanes::cut(std::size_t first, std::size_t end) {
  const auto& all = timeline_.intervals;
  const auto rate = [&](const Interval& i) { return timeline_.nodes[i.first_node].omega_ic_l; };
  cuts_.assign(1, first);
  std::size_t nodes = all[first].node_count();
  for (std::size_t i = first + 1; i < end; ++i) {
    const Interval& begin = all[cuts_.back()];
    nodes += all[i].node_count() - 1;
    if (alike(begin, all[i]) && rate(begin) == rate(all[i]) && nodes <= most_in_piece) continue;
    cuts_.push_back(i);
    nodes = all[i].node_count();
  }
  cuts_.push_back(end);
}

void PathInLanes::forward(std::size_t first, std::size_t end, Vec3* phi) {
  cut(first, end);
  const auto& all = timeline_.intervals;
  for (std::size_t c = 0; c + 1 < cuts_.size(); ++c) {
    if (c > 0) phi[all[cuts_[c]].first_node] = phi[all[cuts_[c] - 1].last_node()];
    solve_piece(cuts_[c], cuts_[c + 1], Given::at_beginning, phi);
  }
}

void PathInLanes::backward(std::size_t first, std::size_t end, Vec3* phi) {
  cut(first, end);
  const auto& all = timeline_.intervals;
  for (std::size_t c = cuts_.size() - 1; c-- > 0;) {
    if (cuts_[c + 1] < end)
      phi[all[cuts_[c + 1] - 1].last_node()] = phi[all[cuts_[c + 1]].first_node];
    solve_piece(cuts_[c], cuts_[c + 1], Given::at_end, phi);
  }
}

void PathInLanes::all_forward(const std::vector<Vec3>& psi0_l, Vec3* phi) {
  const auto& all = timeline_.intervals;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    end = first + 1;
    while (end < all.size() && !all[end].cage) ++end;
    const Interval& begin = all[first];
    phi[begin.first_node] = caged_phi(timeline_.nodes[begin.first_node].R_lr,
                                      psi0_l[static_cast<std::size_t>(begin.chain)]);
    forward(first, end, phi);
  }
}

void PathInLanes::gather(std::size_t first, std::size_t end) {
  node_.clear();
  t_.clear();
  step_.clear();
  for (std::size_t i = first; i < end; ++i) {
    const Interval& interval = timeline_.intervals[i];
    const double step = interval.length() / (2.0 * interval.substeps);
    if (i > first) step_.back() = step;
    for (std::size_t k = i > first ? 1 : 0; k < interval.node_count(); ++k) {
      node_.push_back(interval.first_node + k);
      t_.push_back(timeline_.nodes[node_.back()].t);
      step_.push_back(step);
    }
  }
  psi_.resize(node_.size());
  lanes_.resize((node_.size() + width - 1) / width);
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    std::array<const Node*, width> at;
    for (std::size_t k = 0; k < width; ++k)
      at[k] = &timeline_.nodes[node_[std::min(l * width + k, node_.size() - 1)]];
    Lane& lane = lanes_[l];
    Mat3T<Pack> R_il;
    for (int e = 0; e < 9; ++e) {
      lane.R_lr.data()[e] =
          Pack::of_each([&](int k) { return at[static_cast<std::size_t>(k)]->R_lr.data()[e]; });
      R_il.data()[e] =
          Pack::of_each([&](int k) { return at[static_cast<std::size_t>(k)]->R_il.data()[e]; });
    }
    lane.R_ir = R_il * lane.R_lr;
    for (int e = 0; e < 3; ++e)
      lane.omega_ic_l[e] =
          Pack::of_each([&](int k) { return at[static_cast<std::size_t>(k)]->omega_ic_l[e]; });
  }
}

/// psi' = R_ir (phi' + w_cmd x phi), phi = R_ir^T psi.
void PathInLanes::find_rate(Lane& lane) {
  const Vec3T<Pack> phi = lane.R_ir.transpose() * lane.psi;
  const Mat3T<Pack> R_rp = rotation(phi);
  const Mat3T<Pack> R_lp = lane.R_lr * R_rp;
  Inputs<Pack>& in = seen_.still;
  in.f_p = R_lp.row(2);
  in.omega_ic_p = R_lp.transpose() * lane.omega_ic_l;
  in.omega_cmd_p = omega_cmd_p_;
  RateAssembly<Pack> sum;
  for (int i = 0; i < 3; ++i) sum.omega_torque_g[i] = Pack(-omega_cmd_p_[i]);
  terms_.add_plain_to(seen_, sum);
  const Vec3T<Pack> omega_ip_p = rate_of_slots(model_.coupling, sum, in.omega_ic_p, E_loop_);
  const Vec3T<Pack> phi_rate = rotation_vector_rate(phi, R_rp, omega_ip_p, omega_cmd_p_);
  lane.rate = lane.R_ir * (phi_rate + Vec3T<Pack>(omega_cmd_p_.cast<Pack>()).cross(phi));
}

/// Whether four steps from a node on are the same, but for rounding of the times.
bool PathInLanes::evenly_spaced(std::size_t from) const {
  for (std::size_t k = from + 1; k < from + 4; ++k)
    if (std::abs(step_[k] - step_[from]) > 1e-9 * step_[from]) return false;
  return true;
}

/// The path of the rates along the path; the largest change.
double PathInLanes::round(std::size_t anchor) {
  for (std::size_t l = 0; l < lanes_.size(); ++l) {
    for (int e = 0; e < 3; ++e)
      lanes_[l].psi[e] = Pack::of_each([&](int k) {
        return psi_[std::min(l * width + static_cast<std::size_t>(k), psi_.size() - 1)][e];
      });
    find_rate(lanes_[l]);
  }
  const auto rate = [&](std::size_t k) {
    const Vec3T<Pack>& r = lanes_[k / width].rate;
    const int lane = static_cast<int>(k % width);
    return Vec3(r[0][lane], r[1][lane], r[2][lane]);
  };
  const Vec3 given = psi_[anchor];
  const auto integral = [&](auto&& take) {
    Vec3 sum = Vec3::Zero();
    take(0, sum);
    for (std::size_t k = 0; k + 2 < psi_.size();) {
      // Through five nodes where they are evenly spaced, the last ones with their predecessors;
      // otherwise through three.
      const bool rest = k + 4 >= psi_.size();
      const std::size_t from = rest && k >= 2 ? k - 2 : k;
      const double h = step_[k];
      if (from + 4 < psi_.size() && evenly_spaced(from)) {
        Vec3 f[5];
        for (std::size_t n = 0; n < 5; ++n) f[n] = rate(from + n);
        const std::size_t first = k - from;
        const Vec3 before = first == 0 ? Vec3(Vec3::Zero()) : quartic(f, first);
        for (std::size_t n = first + 1; n < 5; ++n)
          take(from + n, sum + h * (quartic(f, n) - before));
        sum += h * (quartic(f, 4) - before);
        k = from + 4;
        continue;
      }
      const Vec3 f0 = rate(k), f1 = rate(k + 1), f2 = rate(k + 2);
      take(k + 1, sum + h / 12.0 * (5.0 * f0 + 8.0 * f1 - f2));
      sum += h / 3.0 * (f0 + 4.0 * f1 + f2);
      take(k + 2, sum);
      k += 2;
    }
  };
  Vec3 at_anchor = Vec3::Zero();
  integral([&](std::size_t k, const Vec3& sum) {
    if (k == anchor) at_anchor = sum;
  });
  double change = 0.0;
  integral([&](std::size_t k, const Vec3& sum) {
    const Vec3 psi = given + (sum - at_anchor);
    change = psi.allFinite() ? std::max(change, (psi - psi_[k]).cwiseAbs().maxCoeff())
                             : std::numeric_limits<double>::infinity();
    psi_[k] = psi;
  });
  return change;
}

void PathInLanes::solve_piece(std::size_t first, std::size_t end, Given given, Vec3* phi) {
  const Interval& interval = timeline_.intervals[first];
  if (interval.rest) return step_by_step(first, end, given, phi);
  omega_cmd_p_ = interval.omega_cmd_p;
  E_loop_ = misalignment_matrix(model_.mounting, interval.loop);
  gather(first, end);
  const std::size_t anchor = given == Given::at_beginning ? 0 : psi_.size() - 1;
  const auto R_ir = [&](std::size_t k) -> Mat3 {
    const Node& node = timeline_.nodes[node_[k]];
    return node.R_il * node.R_lr;
  };
  const Vec3 at_anchor = R_ir(anchor) * phi[node_[anchor]];
  // First as if the rate stayed what it is there.
  Lane& lane = lanes_[anchor / width];
  lane.psi = at_anchor.cast<Pack>();
  find_rate(lane);
  const int l = static_cast<int>(anchor % width);
  const Vec3 rate(lane.rate[0][l], lane.rate[1][l], lane.rate[2][l]);
  for (std::size_t k = 0; k < psi_.size(); ++k) psi_[k] = at_anchor + (t_[k] - t_[anchor]) * rate;
  int rounds = 0;
  while (!(round(anchor) < small_enough))
    if (++rounds == most_rounds) return step_by_step(first, end, given, phi);
  for (std::size_t k = 0; k < psi_.size(); ++k)
    if (k != anchor) phi[node_[k]] = R_ir(k).transpose() * psi_[k];
  for (std::size_t i = first + 1; i < end; ++i)
    phi[timeline_.intervals[i].first_node] = phi[timeline_.intervals[i - 1].last_node()];
}

/// By Runge-Kutta steps: at rest, or where the iteration does not converge.
void PathInLanes::step_by_step(std::size_t first, std::size_t end, Given given, Vec3* phi) const {
  const auto& all = timeline_.intervals;
  const auto drive = [&](const Interval& i) { return drive_of(i, timeline_, model_, theta_); };
  if (given == Given::at_beginning)
    for (std::size_t i = first; i < end; ++i) {
      if (i > first) phi[all[i].first_node] = phi[all[i - 1].last_node()];
      step_through(all[i], timeline_, drive(all[i]), nullptr, &phi[all[i].first_node]);
    }
  else
    for (std::size_t i = end; i-- > first;) {
      if (i + 1 < end) phi[all[i].last_node()] = phi[all[i + 1].first_node];
      step_back_through(all[i], timeline_, drive(all[i]), nullptr, &phi[all[i].first_node]);
    }
}

Trajectory integrate(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                     const std::vector<Vec3>& psi0_l) {
  if (!all_in_lanes(model.terms)) return integrate_fixed(timeline, model, theta, psi0_l);
  Trajectory phi(timeline.nodes.size());
  PathInLanes lanes(timeline, model);
  lanes.set_theta(theta);
  lanes.all_forward(psi0_l, phi.data());
  return phi;
}

}  // namespace drift
