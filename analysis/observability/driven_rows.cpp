#include "analysis/observability/driven_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/estimate/triangle.hpp"

namespace drift::observability {
namespace {

FilterSpec filter_of(const RankedModel& model) {
  FilterSpec filter;
  static_cast<ModelSpec&>(filter) = model.spec;
  return filter;
}

}  // namespace

DrivenRows::DrivenRows(const RankedModel& model, const Timeline& timeline, const Trajectory& phi)
    : timeline_(timeline), phi_(phi), rows_(filter_of(model), timeline, model.readout) {
  rows_.reset(model.nominal);
}

MatX DrivenRows::take(std::size_t first, std::size_t end, bool measured) {
  constexpr std::size_t at_once = 8;  // intervals whose Jacobians are worked out together
  const auto n = static_cast<Eigen::Index>(rows_.layout().size());
  const Vec3 read = Vec3::Constant(measured ? 0.0 : nan_value);  // what does not matter, only that
  std::vector<double> some(6 * rows_.width());
  MatX all(6 * static_cast<Eigen::Index>(end - first), n);
  Eigen::Index count = 0;
  for (std::size_t i = first; i < end; ++i) {
    const Interval& interval = timeline_.intervals[i];
    if ((i - first) % at_once == 0) rows_.look_ahead(i, std::min(i + at_once, end), phi_.data());
    if (interval.cage) rows_.cage(interval, phi_[interval.first_node]);
    rows_.enter(i);
    const IntervalRows::Taken taken = rows_.take(i, read, read, phi_.data(), nullptr, some.data());
    if (!taken.ok)
      throw InputError(
          ExitCode::self_check,
          fmt::format("the covariance of what is measured until t = {:.6g} s is not positive "
                      "definite. The process noise or the readout may be unphysical: see "
                      "`driftscope check`",
                      interval.t1));
    for (std::size_t k = 0; k < 3 * taken.triples; ++k)
      all.row(count++) = Eigen::Map<const Eigen::RowVectorXd>(&some[k * rows_.width()], n);
  }
  return count > 0 ? triangle(all.topRows(count)) : MatX::Zero(n, n);
}

Walked DrivenRows::walked() const {
  const AttitudeFilter& filter = rows_.attitude();
  Walked out;
  out.states = filter.walking();
  const auto m = static_cast<Eigen::Index>(out.states.size());
  out.by.resize(m, static_cast<Eigen::Index>(rows_.layout().size()));
  for (Eigen::Index k = 0; k < m; ++k)
    out.by.row(k) = filter.walked_by(static_cast<std::size_t>(k)).transpose();
  out.variance = filter.variance().block(3, 3, m, m);
  return out;
}

}  // namespace drift::observability
