#pragma once

#include "core/base/linalg.hpp"
#include "core/estimate/lanes.hpp"

namespace drift {

/// Three rows over states: the derivatives of a vector. Each row lies in one piece.
using Rows3 = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows over n states, filled up with columns of zeros to whole lanes.
inline Rows3 padded_rows(std::size_t n) {
  return Rows3::Zero(3, static_cast<Eigen::Index>(whole_lanes(n)));
}

/// out = sum of M[k] G[k], or added to what is there; all as wide as out, whole lanes.
enum class Sum { afresh, onto };
template <Sum how, std::size_t count>
void sum_of_products(const Mat3 (&M)[count], const Rows3* const (&G)[count], Rows3& out) {
  const std::size_t width = static_cast<std::size_t>(out.cols());
  for (int i = 0; i < 3; ++i) {
    double* into = out.data() + static_cast<std::size_t>(i) * width;
    for (std::size_t c = 0; c < width; c += lane_width) {
      Lanes sum = how == Sum::onto ? load(into + c) : broadcast(0.0);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < count; ++k)
#pragma GCC unroll 3
        for (int j = 0; j < 3; ++j)
          sum = mul_add(load(G[k]->data() + static_cast<std::size_t>(j) * width + c),
                        broadcast(M[k](i, j)), sum);
      store(into + c, sum);
    }
  }
}

}  // namespace drift
