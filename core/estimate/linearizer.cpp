#include "core/estimate/linearizer.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace drift {
namespace {

std::vector<std::size_t> rate_states(const Layout& layout) {
  return {layout.params.begin(),
          layout.params.begin() + static_cast<std::ptrdiff_t>(layout.num_rate)};
}
std::vector<std::size_t> readout_states(const Layout& layout) {
  return {layout.params.begin() + static_cast<std::ptrdiff_t>(layout.num_rate),
          layout.params.end()};
}

/// A matrix of each point, in lanes; the last point stands in the lanes that are left.
template <class Of>
Mat3T<Pack> in_lanes_of(std::span<const NodePoint> points, Of&& of) {
  std::array<const double*, static_cast<std::size_t>(Pack::width)> from;
  for (std::size_t l = 0; l < from.size(); ++l)
    from[l] = of(points[std::min(l, points.size() - 1)]).data();
  Mat3T<Pack> M;
  for (int k = 0; k < 9; ++k)
    M.data()[k] = Pack::of_each([&](int l) { return from[static_cast<std::size_t>(l)][k]; });
  return M;
}

/// The same of a vector.
template <class Of>
Vec3T<Pack> vector_in_lanes(std::span<const NodePoint> points, Of&& of) {
  Vec3T<Pack> v;
  for (int k = 0; k < 3; ++k)
    v[k] = Pack::of_each([&](int l) {
      return of(points[std::min(static_cast<std::size_t>(l), points.size() - 1)])[k];
    });
  return v;
}

Mat3 lane(const Mat3T<Pack>& M, std::size_t l) {
  Mat3 one;
  for (int k = 0; k < 9; ++k) one.data()[k] = M.data()[k][static_cast<int>(l)];
  return one;
}
Vec3 lane(const Vec3T<Pack>& v, std::size_t l) {
  return {v[0][static_cast<int>(l)], v[1][static_cast<int>(l)], v[2][static_cast<int>(l)]};
}

}  // namespace

Linearizer::Linearizer(const DriftModel& model, const Layout& layout, Readout readout)
    : model_(model),
      layout_(layout),
      readout_(readout),
      with_readout_(readout.accelerometers),
      needs_(TermLibrary::needs(model.terms)),
      theta_together_(TermLibrary::num_params),
      rates_(model.terms, model.mounting, rate_states(layout)),
      accelerometers_(model.terms, model.mounting, readout_states(layout)),
      offset_accelerometers_(model.terms, model.mounting, readout_states(layout)),
      offsets_(model.terms, model.mounting, readout_states(layout)),
      resolvers_(model.terms, model.mounting, readout_states(layout)) {
  derivative_.resize(
      std::max({rates_.apart.entries().size(), offsets_.entries().size(),
                offset_accelerometers_.entries().size(), resolvers_.entries().size()}));
  set_theta(layout.theta);
}

void Linearizer::set_theta(const Theta& theta) {
  theta_ = theta;
  for (std::size_t k = 0; k < theta_together_.size(); ++k)
    theta_together_[k] = Pack(theta_[static_cast<Eigen::Index>(k)]);
}

NodeJacobian Linearizer::make() const {
  NodeJacobian j;
  j.A.setZero();
  j.B = padded_rows(layout_.num_rate);
  j.acc.setZero();
  j.H.setZero();
  j.H_par = padded_rows(layout_.size() - layout_.num_rate);
  return j;
}

void Linearizer::evaluate(std::span<const NodePoint> points, const Mat3& E_loop,
                          const Timeline* timeline, NodeJacobian* out) {
  DRIFT_DEMAND(!points.empty() && points.size() <= at_once);
  look_together(points);
  differentiate_rates(points, E_loop, timeline, out);
  if (!with_readout_) return;
  if (!offsets_.any()) return differentiate_readout(points, timeline, out);
  for (std::size_t l = 0; l < points.size(); ++l) {
    look(points[l], lane(R_lp_, l), timeline);
    differentiate_offset_readout(points[l].node->R_il, out[l]);
  }
}

/// Works out what the terms see at some attitudes. What the base terms see is linear in R_lp, so
/// its derivative is what they would see of dR_lp = [psi x] R_lp.
void Linearizer::look_together(std::span<const NodePoint> points) {
  const Vec3T<Pack> phi = vector_in_lanes(points, [](const NodePoint& p) { return p.phi; });
  R_il_ = in_lanes_of(points, [](const NodePoint& p) -> const Mat3& { return p.node->R_il; });
  R_lp_ = in_lanes_of(points, [](const NodePoint& p) -> const Mat3& { return p.node->R_lr; }) *
          rotation(phi);
  const Vec3T<Pack> w_l =
      vector_in_lanes(points, [](const NodePoint& p) { return p.node->omega_ic_l; });
  Inputs<Pack>& still = together_.still;
  Inputs<PackD>& at_psi = together_.at_psi;
  still.mounting = at_psi.mounting = &model_.mounting;
  still.omega_cmd_p = at_psi.omega_cmd_p = points[0].interval->omega_cmd_p;
  still.f_p = R_lp_.row(2);
  still.omega_ic_p = R_lp_.transpose() * w_l;
  for (int k = 0; k < 3; ++k) {
    // R_lp^T [psi x]^T of Up and of the rate, psi a unit vector.
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    const Vec3T<Pack> dw = R_lp_.row(a).transpose() * w_l[b] - R_lp_.row(b).transpose() * w_l[a];
    for (int i = 0; i < 3; ++i) {
      at_psi.omega_ic_p[i].v = still.omega_ic_p[i];
      at_psi.omega_ic_p[i].d[k] = dw[i];
      at_psi.f_p[i].v = still.f_p[i];
      at_psi.f_p[i].d[k] = k == 0 ? R_lp_(1, i) : k == 1 ? -R_lp_(0, i) : Pack(0.0);
    }
  }
  together_.theta = theta_together_.data();
}

/// The same at one attitude, with all that the terms may ask for.
void Linearizer::look(const NodePoint& point, const Mat3& R_lp, const Timeline* timeline) {
  const auto seen = [&](const Mat3& R) {
    return inputs_at<double>(point.node->omega_ic_l, point.interval->omega_cmd_p, model_.mounting,
                             R);
  };
  Inputs<double>& still = seen_.still;
  Inputs<D3>& at_psi = seen_.at_psi;
  still = seen(R_lp);
  at_psi.mounting = still.mounting;
  at_psi.f_p = still.f_p.cast<D3>();
  at_psi.omega_ic_p = still.omega_ic_p.cast<D3>();
  at_psi.omega_cmd_p = still.omega_cmd_p;
  R_at_psi_ = R_lp.cast<D3>();
  for (int k = 0; k < 3; ++k) {  // exp([psi x]) R at psi = 0, to first order
    const Mat3 dR_lp = skew<double>(Vec3::Unit(k)) * R_lp;
    const Inputs<double> d = seen(dR_lp);
    for (int i = 0; i < 3; ++i) {
      at_psi.f_p[i].d[k] = d.f_p[i];
      at_psi.omega_ic_p[i].d[k] = d.omega_ic_p[i];
    }
    for (int i = 0; i < 9; ++i) R_at_psi_.data()[i].d[k] = dR_lp.data()[i];
  }
  seen_.theta = theta_.data();
  if (!needs_.any()) return;
  DRIFT_DEMAND(timeline != nullptr && (point.memory != nullptr || !needs_.memory));
  const Moment now = moment_at(*timeline, *point.interval, point.node->t);
  if (needs_.memory) {
    seen_.memory = point.memory->value.data();
    seen_.memory_derivative = point.memory->derivative.data();
  }
  Needs shown = needs_;  // memory comes with the hook
  shown.memory = false;
  fill_surroundings<double>(shown, now, R_lp, nullptr, around_still_);
  fill_surroundings<D3>(shown, now, R_at_psi_, nullptr, around_at_psi_);
  still.around = &around_still_;
  at_psi.around = &around_at_psi_;
}

/// The slots of a hook at all points, and their derivatives by the states, in hooked.derivative and
/// hooked.beside.
template <class Hook>
typename SlotDerivatives<Hook, Pack>::Slots Linearizer::slots_of(Hooked<Hook>& hooked,
                                                                 std::span<const NodePoint> points,
                                                                 const Timeline* timeline) {
  auto slots = hooked.together.slots_of(together_);
  hooked.together.differentiate(together_, hooked.derivative.data());
  if (!hooked.apart.any()) return slots;
  for (std::size_t l = 0; l < points.size(); ++l) {
    const int at = static_cast<int>(l);
    look(points[l], lane(R_lp_, l), timeline);
    const auto one = hooked.apart.slots_of(seen_);
    for (std::size_t s = 0; s < slots.size(); ++s) {
      slots[s].v.set(at, slots[s].v[at] + one[s].v);
      for (int k = 0; k < 3; ++k) slots[s].d[k].set(at, slots[s].d[k][at] + one[s].d[k]);
    }
    hooked.apart.differentiate(seen_, derivative_.data());
    for (std::size_t e = 0; e < hooked.beside.size(); ++e) hooked.beside[e].set(at, derivative_[e]);
  }
  return slots;
}

void Linearizer::differentiate_rates(std::span<const NodePoint> points, const Mat3& E_loop,
                                     const Timeline* timeline, NodeJacobian* out) {
  const auto slots = slots_of(rates_, points, timeline);
  const Mat3T<Pack> R_ip = R_il_ * R_lp_;
  const RateChain<Pack> chain(model_, slots, together_.at_psi.omega_ic_p,
                              together_.still.omega_cmd_p, E_loop, R_ip);
  const Mat3T<Pack> A = R_ip * chain.by_attitude() * R_il_.transpose();
  const Vec3T<Pack> omega_ip_i = R_ip * chain.omega_ip_p();
  for (std::size_t l = 0; l < points.size(); ++l) {
    out[l].A = lane(A, l);
    out[l].omega_ip_i = lane(omega_ip_i, l);
  }
  const auto write = [&](const auto& entries, const std::vector<Pack>& derivative) {
    for (std::size_t e = 0; e < entries.size();) {
      const std::size_t state = entries[e].state;
      const Pack sigma(layout_.sigma[static_cast<Eigen::Index>(state)]);
      Vec3T<Pack> column = chain.by_slot(entries[e].slot, derivative[e] * sigma);
      for (++e; e < entries.size() && entries[e].state == state; ++e)
        column += chain.by_slot(entries[e].slot, derivative[e] * sigma);
      for (int i = 0; i < 3; ++i)
        for (std::size_t l = 0; l < points.size(); ++l)
          out[l].B(i, static_cast<Eigen::Index>(state)) = column[i][static_cast<int>(l)];
    }
  };
  write(rates_.together.entries(), rates_.derivative);
  write(rates_.apart.entries(), rates_.beside);
}

void Linearizer::differentiate_readout(std::span<const NodePoint> points, const Timeline* timeline,
                                       NodeJacobian* out) {
  auto slots = slots_of(accelerometers_, points, timeline);
  Mat3T<Pack> H_l;
  Vec3T<Pack> acc;
  for (int i = 0; i < 3; ++i) {
    const PackD& f = together_.at_psi.f_p[i];
    const PackD& s = slots[static_cast<std::size_t>(i)];
    acc[i] = f.v + s.v;
    for (int k = 0; k < 3; ++k) H_l(i, k) = f.d[k] + s.d[k];
  }
  const Mat3T<Pack> H = H_l * R_il_.transpose();
  for (std::size_t l = 0; l < points.size(); ++l) {
    out[l].acc = lane(acc, l);
    out[l].H = lane(H, l);
  }
  const auto write = [&](const auto& entries, const std::vector<Pack>& derivative) {
    for (std::size_t e = 0; e < entries.size(); ++e) {
      const auto state = static_cast<Eigen::Index>(entries[e].state);
      const double sigma = layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate) + state];
      for (std::size_t l = 0; l < points.size(); ++l)
        out[l].H_par(entries[e].slot, state) = derivative[e][static_cast<int>(l)] * sigma;
    }
  };
  write(accelerometers_.together.entries(), accelerometers_.derivative);
  write(accelerometers_.apart.entries(), accelerometers_.beside);
}

}  // namespace drift
