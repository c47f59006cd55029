#include "core/estimate/compressed/compressed_dwells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/check.hpp"
#include "core/plan/stretches_and_chains.hpp"

namespace drift {
namespace {

/// Whether two neighbours belong to one stretch: attitude, command and case go on as they were, and
/// nothing changes within them that few nodes would not see.
bool go_on(const Timeline& timeline, const Interval& a, const Interval& b) {
  const auto still = [](const Interval& i) { return i.heading0 == i.heading1 && !i.rest; };
  return !a.fine && !b.fine && !b.cage && a.chain == b.chain && a.position == b.position &&
         a.slew == b.slew && a.t1 == b.t0 && a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop &&
         still(a) && still(b) && a.heading0 == b.heading0 &&
         timeline.nodes[a.first_node].omega_ic_l == timeline.nodes[b.first_node].omega_ic_l;
}

/// By how much anything turns against anything else in a stretch [rad].
double angle_of(const Timeline& timeline, const Interval& begin, double duration) {
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  const Mat3& R_lr = timeline.nodes[begin.first_node].R_lr;
  return duration * std::max({omega_ie_l.norm(), begin.omega_cmd_p.norm(),
                              (begin.omega_cmd_p - R_lr.transpose() * omega_ie_l).norm()});
}

/// Polynomials whose coefficients tell, (3 a / 4)^k / k! > 1e-10, and two.
std::size_t polynomials_for(double angle) {
  constexpr double negligible = 1e-10;
  constexpr double directions = 3.0;  // what is predicted is a product of so many
  std::size_t k = 0;
  for (double coefficient = 1.0; coefficient > negligible; ++k)
    coefficient *= 0.25 * directions * angle / static_cast<double>(k + 1);
  return k + 2;
}

/// Steps of two nodes: short enough for the quadrature, and nodes for half as many polynomials
/// again.
int substeps_for(double angle, std::size_t polynomials) {
  constexpr double longest_step = 0.1;  // as place_nodes has it where there are several
  return static_cast<int>(std::max(std::ceil(angle / longest_step),
                                   std::ceil(0.75 * static_cast<double>(polynomials))));
}

}  // namespace

CompressedTest::CompressedTest(const Timeline& timeline, const Readout& readout,
                               const Options& options)
    : whole_(timeline), readout_(readout) {
  const auto& all = timeline.intervals;
  timeline_.site = timeline.site;
  timeline_.chains = timeline.chains;
  timeline_.positions = timeline.positions;
  std::vector<Mat3> R_lp(static_cast<std::size_t>(timeline.chains));
  std::size_t most = 1;  // samples
  const auto begins = [&](std::size_t i) { return i == 0 || !go_on(timeline, all[i - 1], all[i]); };
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    most = options.cut == Cut::nowhere ? all.size() : 2 * most;
    if (options.cut == Cut::doubling && begins(first)) {
      end = first + 1;
      while (end < all.size() && !begins(end)) ++end;
      most = first_block(end - first);
    }
    if (all[first].cage)
      R_lp[static_cast<std::size_t>(all[first].chain)] = timeline.nodes[all[first].first_node].R_lr;
    int steps = all[first].substeps;
    for (end = first + 1;
         end < all.size() && end - first < most && go_on(timeline, all[end - 1], all[end]); ++end)
      steps += all[end].substeps;
    const double angle = angle_of(timeline, all[first], all[end - 1].t1 - all[first].t0);
    const std::size_t polynomials = polynomials_for(angle);
    const int substeps = substeps_for(angle, polynomials);
    const bool pays = options.fewer * substeps <= steps && polynomials < end - first;
    if (pays && std::ranges::find(options.leave, first) == options.leave.end())
      take_together(first, end, polynomials, substeps);
    else
      for (std::size_t i = first; i < end; ++i) take_alone(i);
  }
  const auto count = static_cast<Eigen::Index>(timeline_.intervals.size());
  const Mat3X nothing = Mat3X::Constant(3, count, std::numeric_limits<double>::quiet_NaN());
  measured_ = {nothing, nothing};
  if (!any()) return;
  place_nodes(timeline_, R_lp);
  for (std::size_t i = 0; i < of_interval_.size(); ++i)
    if (of_interval_[i] >= 0)
      read_at_nodes(stretches_[static_cast<std::size_t>(of_interval_[i])], timeline_.intervals[i]);
}

void CompressedTest::take_alone(std::size_t i) {
  timeline_.intervals.push_back(whole_.intervals[i]);
  first_.push_back(i);
  of_interval_.push_back(-1);
}

void CompressedTest::take_together(std::size_t first, std::size_t end, std::size_t polynomials,
                                   int substeps) {
  Interval joined = whole_.intervals[first];
  joined.t1 = whole_.intervals[end - 1].t1;
  joined.substeps = substeps;
  timeline_.intervals.push_back(joined);
  first_.push_back(first);
  of_interval_.push_back(static_cast<int>(stretches_.size()));
  stretches_.push_back({first, end, polynomials, {}, {}, {}, {}});
}

/// What hangs on the nodes of a stretch, once they are placed: place_nodes may ask for more of
/// them.
void CompressedTest::read_at_nodes(Stretch& stretch, const Interval& interval) {
  stretch.fit = legendre_fit(stretch.polynomials, interval.node_count());
  stretch.readings.integral = 0.5 * interval.length() * legendre_integral(stretch.fit);
  std::vector<std::size_t> every(stretch.end - stretch.first);
  std::iota(every.begin(), every.end(), 0);
  if (readout_.accelerometers) stretch.means = how_to_read(stretch, Reading::mean, every);
  if (readout_.gimbals) stretch.ends = how_to_read(stretch, Reading::at_end, every);
}

AxisReading CompressedTest::how_to_read(const Stretch& stretch, Reading what,
                                        std::vector<std::size_t> samples) const {
  const double begin = whole_.intervals[stretch.first].t0;
  const double length = whole_.intervals[stretch.end - 1].t1 - begin;
  const auto scaled = [&](double t) { return 2.0 * (t - begin) / length - 1.0; };
  AxisReading how{std::move(samples), VecX(0), {}, {}};
  std::vector<ReadingTime> times;
  for (const std::size_t s : how.samples) {
    const Interval& i = whole_.intervals[stretch.first + s];
    times.push_back({scaled(i.t0), scaled(i.t1),
                     what == Reading::mean ? i.accelerometer_noise(readout_.accelerometer_noise)
                                           : i.gimbal_noise(readout_.gimbal_noise)});
  }
  how.sigma.resize(static_cast<Eigen::Index>(times.size()));
  for (std::size_t k = 0; k < times.size(); ++k)
    how.sigma[static_cast<Eigen::Index>(k)] = times[k].sigma;
  how.projection = polynomial_projection(what, times, stretch.fit);
  const MatX& basis = how.projection.basis;
  how.neighbours = MatX::Zero(basis.cols(), basis.cols());
  for (std::size_t k = 0; k + 1 < how.samples.size(); ++k)
    if (how.samples[k] + 1 == how.samples[k + 1])
      how.neighbours += basis.row(static_cast<Eigen::Index>(k)).transpose() *
                        basis.row(static_cast<Eigen::Index>(k + 1));
  return how;
}

void CompressedTest::read(const Measurements& measured) {
  DRIFT_DEMAND(is_along(measured, whole_));
  left_over_ = 0.0;
  scalars_ = 0;
  with_gaps_.clear();
  for (std::size_t i = 0; i < first_.size(); ++i) {
    if (of_interval_[i] >= 0) continue;
    const auto from = static_cast<Eigen::Index>(first_[i]), to = static_cast<Eigen::Index>(i);
    measured_.acc.col(to) = measured.acc.col(from);
    measured_.gimbal.col(to) = measured.gimbal.col(from);
    if (readout_.accelerometers) scalars_ += measured.acc.col(from).array().isFinite().count();
    if (readout_.gimbals) scalars_ += measured.gimbal.col(from).array().isFinite().count();
  }
  for (Stretch& s : stretches_) {
    if (readout_.accelerometers)
      read_channel(s, Reading::mean, measured.acc, s.readings.accelerometers);
    if (readout_.gimbals) read_channel(s, Reading::at_end, measured.gimbal, s.readings.gimbals);
  }
}

void CompressedTest::read_channel(const Stretch& stretch, Reading what, const Mat3X& measured,
                                  StretchChannel& channel) {
  const AxisReading& complete = what == Reading::mean ? stretch.means : stretch.ends;
  for (int a = 0; a < 3; ++a) {
    StretchChannel::Axis& axis = channel.axes[static_cast<std::size_t>(a)];
    const auto readings =
        measured.row(a).segment(static_cast<Eigen::Index>(stretch.first),
                                static_cast<Eigen::Index>(stretch.end - stretch.first));
    axis.how = &complete;
    if (!readings.array().isFinite().all()) {
      std::vector<std::size_t> there;
      for (Eigen::Index k = 0; k < readings.size(); ++k)
        if (std::isfinite(readings[k])) there.push_back(static_cast<std::size_t>(k));
      axis.how = nullptr;
      if (there.empty()) continue;
      axis.how = &with_gaps_.emplace_back(how_to_read(stretch, what, std::move(there)));
    }
    const AxisReading& how = *axis.how;
    channel.reference[a] = readings[static_cast<Eigen::Index>(how.samples.front())];
    values_.resize(how.samples.size());
    for (std::size_t k = 0; k < values_.size(); ++k) {
      const double value = readings[static_cast<Eigen::Index>(how.samples[k])];
      values_[k] = (what == Reading::mean ? value - channel.reference[a]
                                          : angle_difference(value, channel.reference[a])) /
                   how.sigma[static_cast<Eigen::Index>(k)];
    }
    const Eigen::Map<const VecX> v(values_.data(), static_cast<Eigen::Index>(values_.size()));
    axis.measured.noalias() = how.projection.basis.transpose() * v;
    axis.left = v;
    axis.left.noalias() -= how.projection.basis * axis.measured;
    left_over_ += axis.left.squaredNorm();
    scalars_ += values_.size();
  }
}

}  // namespace drift
