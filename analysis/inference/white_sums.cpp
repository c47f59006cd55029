#include "analysis/inference/white_sums.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::inference {

WhiteSums::WhiteSums(const MeasuredRows& rows, const std::vector<double>& columns,
                     std::size_t width, std::size_t parameters) {
  constexpr Eigen::Index at_once = 128;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(columns.data(), rows.rows(),
                                       static_cast<Eigen::Index>(width));
  const auto n = static_cast<Eigen::Index>(parameters) + 1;
  int chains = 0;
  for (const IntervalDrive& d : rows.drives) chains = std::max(chains, d.chain + 1);
  RowMajor part(at_once, n);
  for (const bool accelerometer : {true, false}) {
    Instrument& sums = accelerometer ? accelerometers_ : gimbals_;
    sums.products = MatX::Zero(n, n);
    sums.attitude = MatX::Zero(3 * chains, 3 + n);
    Eigen::Index filled = 0;
    const auto add = [&] {
      if (filled > 0)  // Eigen divides by it
        sums.products.selfadjointView<Eigen::Lower>().rankUpdate(part.topRows(filled).transpose());
      filled = 0;
    };
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
      const RowTag& tag = rows.tags[static_cast<std::size_t>(k)];
      if (tag.accelerometer() != accelerometer) continue;
      const Vec3 psi = rows.weight[k] * rows.psi.row(k).transpose();
      part.row(filled) = rows.weight[k] * all.row(k).head(n);
      auto attitude = sums.attitude.middleRows<3>(3 * rows.drives[tag.interval].chain);
      attitude.leftCols<3>() += psi * psi.transpose();
      attitude.rightCols(n).noalias() += psi * part.row(filled);
      log_det_ -= 2.0 * std::log(rows.weight[k]);
      ++sums.rows;
      if (++filled == at_once) add();
    }
    add();
  }
}

Marginal WhiteSums::at(const NoiseModel& noise) const {
  const double by_acc = 1.0 / (noise.acc_factor * noise.acc_factor),
               by_gimbal = 1.0 / (noise.gimbal_factor * noise.gimbal_factor);
  const Eigen::Index all = accelerometers_.products.rows(), n = all - 1;
  MatX A = by_acc * accelerometers_.products + by_gimbal * gimbals_.products;
  const MatX attitude = by_acc * accelerometers_.attitude + by_gimbal * gimbals_.attitude;
  double log_det = log_det_;
  log_det += 2.0 * static_cast<double>(accelerometers_.rows) * std::log(noise.acc_factor);
  log_det += 2.0 * static_cast<double>(gimbals_.rows) * std::log(noise.gimbal_factor);
  MatX half(attitude.rows(), all);
  for (Eigen::Index first = 0; first < attitude.rows(); first += 3) {
    const Eigen::LLT<Mat3> root(Mat3(attitude.block<3, 3>(first, 0)) + Mat3::Identity());
    half.middleRows<3>(first) = root.matrixL().solve(attitude.middleRows<3>(first).rightCols(all));
    log_det += 2.0 * root.matrixLLT().diagonal().array().log().sum();
  }
  A.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose(), -1.0);
  A.topLeftCorner(n, n).diagonal().array() += 1.0;
  const Cholesky root(A.topLeftCorner(n, n));
  const VecX of_r0 = root.halved(A.row(n).head(n).transpose());
  return {A(n, n) - of_r0.squaredNorm(), log_det + 2.0 * root.L().diagonal().array().log().sum(),
          accelerometers_.rows + gimbals_.rows};
}

}  // namespace drift::inference
