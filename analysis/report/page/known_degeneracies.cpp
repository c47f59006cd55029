#include "analysis/report/page/known_degeneracies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

namespace drift::report {
namespace {

/// Collects the coefficients of a direction in SI; incomplete if a parameter is no state.
class Direction {
 public:
  explicit Direction(const Layout& layout) : layout_(layout), scaled_(VecX::Zero(layout.size())) {}

  void add(std::string_view group, int axis, double si) {
    if (si == 0.0) return;
    const auto param = TermLibrary::find(fmt::format("{}_{}", group, "xyz"[axis]));
    const auto at = std::find(layout_.params.begin(), layout_.params.end(), param.value());
    if (at == layout_.params.end()) {
      complete_ = false;
      return;
    }
    const auto k = at - layout_.params.begin();
    scaled_[k] += si / layout_.sigma[k];
  }
  bool complete() const { return complete_; }
  const VecX& scaled() const { return scaled_; }

 private:
  const Layout& layout_;
  VecX scaled_;
  bool complete_ = true;
};

/// The instrument whose parameter it is, 0 to 2; nothing if it belongs to none.
std::optional<std::size_t> instrument_of(std::size_t param) {
  const auto at = std::string_view("xyz").find(TermLibrary::specs[param].axis);
  return TermLibrary::specs[param].axis.size() == 1 && at != std::string_view::npos
             ? std::optional(at)
             : std::nullopt;
}

/// The platform axis about which a command must be for a parameter of the torquers to be seen.
std::optional<std::size_t> command_of(std::size_t param, const Mounting& mounting) {
  const auto i = instrument_of(param);
  if (!i || TermLibrary::owner(param).subsystem != Subsystem::torquer) return std::nullopt;
  const std::string_view group = TermLibrary::specs[param].group.view();
  const auto axis = [&](const SignedAxis& a) { return static_cast<std::size_t>(a.index); };
  if (group == "X_S") return axis(mounting.gyro.third[*i]);  // cross-talk
  if (group == "X_O") return axis(mounting.gyro.second[*i]);
  return i;
}

/// The platform axes of whose specific forces a parameter multiplies the product.
std::optional<std::pair<std::size_t, std::size_t>> product_of(std::size_t param,
                                                              const Mounting& mounting) {
  enum Which { input, second, third };
  struct Product {
    std::string_view group;
    const Triads& triads;
    Which one, other;
  };
  const Triads &gyro = mounting.gyro, &accelerometer = mounting.accelerometer;
  const Product products[] = {
      {"D_IO", gyro, input, second},         {"D_IS", gyro, input, third},
      {"D_OS", gyro, second, third},         {"K_ip", accelerometer, input, second},
      {"K_io", accelerometer, input, third}, {"K_po", accelerometer, second, third}};
  const auto i = instrument_of(param);
  const auto* p =
      std::ranges::find(products, TermLibrary::specs[param].group.view(), &Product::group);
  if (!i || p == std::end(products)) return std::nullopt;
  const auto axis = [&](Which which) {
    return which == input ? *i
                          : static_cast<std::size_t>(
                                (which == second ? p->triads.second : p->triads.third)[*i].index);
  };
  return std::pair(axis(p->one), axis(p->other));
}

double along(const SignedAxis& axis, const Vec3& v) {
  return axis.sign * v[axis.index];
}

}  // namespace

std::vector<KnownDegeneracy> known_degeneracies(const Layout& layout, const Mounting& mounting) {
  std::vector<KnownDegeneracy> all;
  constexpr double exact = 1e-3;  // what rounding leaves of an eigenvector, with room
  const auto n = static_cast<Eigen::Index>(layout.size());
  for (Eigen::Index k = 0; k < n; ++k) all.push_back({VecX::Unit(n, k), "", exact});
  // What is constant with all squares of an instrument.
  const auto add_squares = [&](const char* constant, std::array<const char*, 3> squares,
                               const char* words) {
    for (int i = 0; i < 3; ++i) {
      Direction sum(layout);
      sum.add(constant, i, 1.0);
      for (const char* square : squares) sum.add(square, i, -1.0);  // per g^2
      if (sum.complete()) all.push_back({sum.scaled(), words, exact, true});
    }
  };
  add_squares("D_F", {"D_II", "D_OO", "D_SS"},
              "fixed drift with the trace of the g^2 terms: a_I^2 + a_O^2 + a_S^2 = 1 g^2 in any "
              "laboratory, so only their sum is seen");
  add_squares(
      "K0", {"K2", "K_pp", "K_oo"},
      "accelerometer bias with its three square terms: a_I^2 + a_O^2 + a_P^2 = 1 g^2 in any "
      "laboratory, so only their sum is seen");
  for (int i = 0; i < 3; ++i) {
    Direction cubic(layout);
    cubic.add("K1", i, 1.0);
    cubic.add("K3", i, -1.0);  // per g^3
    if (cubic.complete())
      all.push_back(
          {cubic.scaled(),
           "accelerometer scale with the cubic term: equal where every a_I is -1, 0 or +1 g; "
           "positions at 45 deg tell them apart",
           exact});
  }
  for (int axis = 0; axis < 3; ++axis) {
    // A rotation rho of both triads: the axis e_i of an instrument becomes e_i + rho x e_i.
    Direction gauge(layout);
    for (int i = 0; i < 3; ++i) {
      const Vec3 tilt = Vec3::Unit(axis).cross(Vec3::Unit(i));
      gauge.add("eta", i, along(mounting.gyro.third[i], tilt));
      gauge.add("xi", i, along(mounting.gyro.second[i], tilt));
      gauge.add("dP", i, along(mounting.accelerometer.second[i], tilt));
      gauge.add("dO", i, along(mounting.accelerometer.third[i], tilt));
    }
    // The drift coefficients turn along by drift times angle, which is small but not nothing.
    if (gauge.complete())
      all.push_back(
          {gauge.scaled(),
           "gauge: a common small rotation of gyro triad, accelerometer triad and initial "
           "attitude; only gimbal readings or a convention fix the platform axes",
           0.05, true});
  }
  return all;
}

std::string no_signal_reason(std::size_t param, bool exact, const Mounting& mounting,
                             const Excitation& excitation) {
  if (!exact) return "hardly any signal in this test";
  if (const auto axis = command_of(param, mounting); axis && !excitation.commanded[*axis])
    return "no signal: the gyro is never torqued";
  if (const auto axes = product_of(param, mounting);
      axes && !excitation.along_both[axes->first][axes->second])
    return "no signal: a product of two axes, zero where one of them is level";
  return "no signal in this test";
}

}  // namespace drift::report
