#include "core/estimate/compressed/compressed_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drift {
namespace {

/// Whether two neighbours belong to one stretch: attitude, command and case go on as they were.
bool go_on(const Timeline& timeline, const Interval& a, const Interval& b) {
  const auto still = [](const Interval& i) { return i.heading0 == i.heading1 && !i.rest; };
  return !b.cage && a.chain == b.chain && a.position == b.position && a.slew == b.slew &&
         a.t1 == b.t0 && a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop && still(a) &&
         still(b) && a.heading0 == b.heading0 &&
         timeline.nodes[a.first_node].omega_ic_l == timeline.nodes[b.first_node].omega_ic_l;
}

/// By how much anything turns against anything else in a stretch [rad].
double angle_of(const Timeline& timeline, const Interval& begin, double duration) {
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  const Mat3& R_lr = timeline.nodes[begin.first_node].R_lr;
  return duration * std::max({omega_ie_l.norm(), begin.omega_cmd_p.norm(),
                              (begin.omega_cmd_p - R_lr.transpose() * omega_ie_l).norm()});
}

/// Polynomials whose coefficients tell, (a / 4)^k / k! > 1e-10, and two.
std::size_t polynomials_for(double angle) {
  constexpr double negligible = 1e-10;
  std::size_t k = 0;
  for (double coefficient = 1.0; coefficient > negligible; ++k)
    coefficient *= 0.25 * angle / static_cast<double>(k + 1);
  return k + 2;
}

/// Steps of two nodes: short enough for the quadrature, and nodes for half as many polynomials
/// again.
int substeps_for(double angle, std::size_t polynomials) {
  constexpr double longest_step = 0.05;
  return static_cast<int>(std::max(std::ceil(angle / longest_step),
                                   std::ceil(0.75 * static_cast<double>(polynomials))));
}

}  // namespace

CompressedTest::CompressedTest(const MeasuredTest& test, const std::vector<std::size_t>& leave)
    : readout_(test.readout) {
  const auto& all = test.timeline.intervals;
  timeline_.site = test.timeline.site;
  timeline_.chains = test.timeline.chains;
  timeline_.positions = test.timeline.positions;
  measured_ = {Mat3X(3, 0), Mat3X(3, 0)};
  std::vector<Mat3> R_lp(static_cast<std::size_t>(test.timeline.chains));
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  measured_.acc = measured_.gimbal =
      Mat3X::Constant(3, static_cast<Eigen::Index>(all.size()), nothing);
  const auto acc_noise = [&](const Interval& i) {
    return i.accelerometer_noise(readout_.accelerometer_noise);
  };
  const auto gimbal_noise = [&](const Interval&) { return readout_.gimbal_noise; };
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    if (all[first].cage)
      R_lp[static_cast<std::size_t>(all[first].chain)] =
          test.timeline.nodes[all[first].first_node].R_lr;
    int steps = all[first].substeps;
    for (end = first + 1; end < all.size() && go_on(test.timeline, all[end - 1], all[end]); ++end)
      steps += all[end].substeps;
    const double angle = angle_of(test.timeline, all[first], all[end - 1].t1 - all[first].t0);
    const std::size_t polynomials = polynomials_for(angle);
    const int substeps = substeps_for(angle, polynomials);
    const bool pays = 2 * substeps <= steps && polynomials < end - first;
    if (!pays || std::ranges::find(leave, first) != leave.end()) {
      for (std::size_t i = first; i < end; ++i) take_alone(test, i);
      continue;
    }
    take_together(test, first, end, substeps);
    const MatX fit = legendre_fit(polynomials, timeline_.intervals.back().node_count());
    StretchReadings readings;
    readings.integral = 0.5 * timeline_.intervals.back().length() * legendre_integral(fit);
    if (readout_.accelerometers)
      readings.accelerometers =
          read(test, first, end, Reading::mean, test.measured.acc, acc_noise, fit);
    if (readout_.gimbals)
      readings.gimbals =
          read(test, first, end, Reading::at_end, test.measured.gimbal, gimbal_noise, fit);
    readings_.push_back(std::move(readings));
  }
  const auto count = static_cast<Eigen::Index>(timeline_.intervals.size());
  measured_.acc.conservativeResize(3, count);
  measured_.gimbal.conservativeResize(3, count);
  if (any()) place_nodes(timeline_, R_lp);
}

void CompressedTest::take_alone(const MeasuredTest& test, std::size_t i) {
  const auto from = static_cast<Eigen::Index>(i);
  const auto to = static_cast<Eigen::Index>(timeline_.intervals.size());
  measured_.acc.col(to) = test.measured.acc.col(from);
  measured_.gimbal.col(to) = test.measured.gimbal.col(from);
  timeline_.intervals.push_back(test.timeline.intervals[i]);
  first_.push_back(i);
  of_interval_.push_back(-1);
}

void CompressedTest::take_together(const MeasuredTest& test, std::size_t first, std::size_t end,
                                   int substeps) {
  Interval whole = test.timeline.intervals[first];
  whole.t1 = test.timeline.intervals[end - 1].t1;
  whole.substeps = substeps;
  timeline_.intervals.push_back(whole);
  first_.push_back(first);
  of_interval_.push_back(static_cast<int>(stretches_++));
}

namespace {

/// What one axis has read along a stretch, counted from its first reading.
struct AxisSamples {
  std::vector<ReadingTime> times;
  std::vector<double> values;
  double reference = 0.0;
};

template <class Noise>
AxisSamples samples_of(const Timeline& timeline, std::size_t first, std::size_t end, Reading what,
                       const Eigen::RowVectorXd& readings, const Noise& noise) {
  const double begin = timeline.intervals[first].t0, last = timeline.intervals[end - 1].t1;
  const auto scaled = [&](double t) { return 2.0 * (t - begin) / (last - begin) - 1.0; };
  AxisSamples out;
  for (std::size_t i = first; i < end; ++i) {
    const double value = readings[static_cast<Eigen::Index>(i)];
    if (!std::isfinite(value)) continue;
    const Interval& sample = timeline.intervals[i];
    if (out.times.empty()) out.reference = value;
    out.times.push_back({scaled(sample.t0), scaled(sample.t1), noise(sample)});
    out.values.push_back(what == Reading::mean ? value - out.reference
                                               : angle_difference(value, out.reference));
  }
  return out;
}

/// Sum of squares of whitened readings less their projection.
double left_of(const AxisSamples& samples, const PolynomialProjection& projection,
               const VecX& projected) {
  const VecX smooth = projection.of_readings.transpose() * projected;  // over sigma twice
  double sum = 0.0;
  for (std::size_t k = 0; k < samples.values.size(); ++k) {
    const double sigma = samples.times[k].sigma;
    const double rest = samples.values[k] / sigma - smooth[static_cast<Eigen::Index>(k)] * sigma;
    sum += rest * rest;
  }
  return sum;
}

}  // namespace

template <class Noise>
StretchChannel CompressedTest::read(const MeasuredTest& test, std::size_t first, std::size_t end,
                                    Reading what, const Mat3X& measured, const Noise& noise,
                                    const MatX& fit) {
  StretchChannel out;
  std::vector<ReadingTime> times;
  PolynomialProjection projection;
  for (int a = 0; a < 3; ++a) {
    StretchChannel::Axis& axis = out.axes[static_cast<std::size_t>(a)];
    axis.of_nodes.resize(0, fit.cols());
    const AxisSamples samples = samples_of(test.timeline, first, end, what, measured.row(a), noise);
    if (samples.times.empty()) continue;
    const auto same = [](const ReadingTime& s, const ReadingTime& t) { return s.end == t.end; };
    if (!std::ranges::equal(samples.times, times, same))
      projection = polynomial_projection(what, samples.times, fit);
    times = samples.times;
    out.reference[a] = samples.reference;
    axis = {projection.of_nodes,
            projection.of_readings *
                Eigen::Map<const VecX>(samples.values.data(),
                                       static_cast<Eigen::Index>(samples.values.size()))};
    left_over_ += left_of(samples, projection, axis.measured);
  }
  return out;
}

}  // namespace drift
