#include "core/plan/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drift {

Excitation excitation_of(const Timeline& timeline) {
  Vec3 command = Vec3::Zero();  // largest about each axis
  for (const Interval& i : timeline.intervals) command = command.cwiseMax(i.omega_cmd_p.cwiseAbs());
  Mat3 product = Mat3::Zero();  // largest of two specific forces [g^2]
  for (const Node& node : timeline.nodes) {
    const Vec3 f_p = node.R_lr.row(2);  // R_lr^T up
    product = product.cwiseMax((f_p * f_p.transpose()).cwiseAbs());
  }
  // Of an attitude, two products of matrices on from that of the node before: sums of three terms.
  constexpr double roundings = 10.0;
  const double rounding = roundings * static_cast<double>(timeline.nodes.size()) *
                          std::numeric_limits<double>::epsilon();
  Excitation out;
  for (int i = 0; i < 3; ++i) {
    out.commanded[i] = command[i] > rounding * command.maxCoeff();
    for (int j = 0; j < 3; ++j) out.along_both[i][j] = product(i, j) > rounding;
  }
  return out;
}

}  // namespace drift
