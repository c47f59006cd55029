#include "analysis/inference/periodic_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "analysis/inference/thresholds.hpp"
#include "core/stats/median.hpp"
#include "core/stats/normal.hpp"

namespace drift::inference {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

struct Place {
  Equation equation;
  int axis;
};

std::vector<Place> places_of(const LinearProblem& rows) {
  const auto read = [&](bool accelerometer) {
    return std::ranges::any_of(rows.tags,
                               [&](auto& t) { return t.accelerometer() == accelerometer; });
  };
  const bool of_case = std::ranges::any_of(rows.drives, &IntervalDrive::rest);
  std::vector<Equation> equations;
  if (!rows.acc_rounded && !rows.gimbals_rounded) equations.push_back(Equation::rate);
  if (read(true) && !rows.acc_rounded) equations.push_back(Equation::accelerometer);
  if (read(false) && !rows.gimbals_rounded && !of_case) equations.push_back(Equation::gimbal);
  std::vector<Place> all;
  for (const Equation e : equations)
    for (int axis = 0; axis < 3; ++axis) all.push_back({e, axis});
  return all;
}

/// When intervals end, from the beginning of their recording [s]: how long after the one before it
/// begins nobody knows.
std::vector<double> ends_of(const MeasuredRows& rows) {
  std::vector<double> all;
  for (const IntervalDrive& d : rows.drives)
    all.push_back(all.empty() || d.begins ? d.length : all.back() + d.gap + d.length);
  return all;
}

/// What each interval is told of a sinusoid in one equation: rows of a readout stand for their own
/// instant, what turns the platform for all that come after it in its chain.
class Instants {
 public:
  explicit Instants(const LinearProblem& rows) : rows_(rows), end_(ends_of(rows)) {}

  /// Of the longest recording [s].
  double span() const { return *std::ranges::max_element(end_); }
  /// Middles of the intervals that have a row [s].
  std::vector<double> read() const {
    std::vector<double> all;
    for (Eigen::Index r = 0; r < rows_.r0.size(); ++r) {
      const std::size_t i = rows_.tags[at(r)].interval;
      if (r == 0 || i != rows_.tags[at(r - 1)].interval) all.push_back(middle(i));
    }
    return all;
  }
  bool of_case() const { return std::ranges::any_of(rows_.drives, &IntervalDrive::rest); }

  /// Residuals u as they speak of an equation: take(time, value). What turns the platform back and
  /// forth shows as attitude, but for a constant that the attitude at caging takes up.
  template <class Take>
  void each_instant(const Place& p, const VecX& u, Take&& take) const {
    for (Eigen::Index r = 0; r < u.size(); ++r) {
      const RowTag& tag = rows_.tags[at(r)];
      const IntervalDrive& d = rows_.drives[tag.interval];
      const double unit = p.equation == Equation::rate
                              ? rows_.psi.row(r).dot(d.per_rate.col(p.axis)) / d.length +
                                    rows_.per_drift(tag, p.axis)
                              : unit_of(p, r);
      if (unit != 0.0) take(time_of(r), unit * u[r]);
    }
  }

  /// Cosine and sine of a frequency [1/s] in one equation, as the rows see them.
  void signature(const Place& p, double frequency, Eigen::Ref<MatX> out) const {
    out.setZero();
    const auto wave = [&](double t) {
      return Eigen::RowVector2d(std::cos(two_pi * frequency * t), std::sin(two_pi * frequency * t));
    };
    if (p.equation != Equation::rate) {
      for (Eigen::Index r = 0; r < out.rows(); ++r)
        if (const double unit = unit_of(p, r); unit != 0.0) out.row(r) = unit * wave(time_of(r));
      return;
    }
    Eigen::Matrix<double, 3, 2> turned = Eigen::Matrix<double, 3, 2>::Zero();
    Eigen::Index r = 0;
    for (std::size_t i = 0; i < rows_.drives.size(); ++i) {
      const IntervalDrive& d = rows_.drives[i];
      if (i > 0 && rows_.drives[i - 1].chain != d.chain) turned.setZero();
      const Eigen::RowVector2d now = wave(middle(i));
      const Eigen::Matrix<double, 3, 2> more = d.per_rate.col(p.axis) * now;
      for (; r < out.rows() && rows_.tags[at(r)].interval == i; ++r) {
        const RowTag& tag = rows_.tags[at(r)];
        out.row(r) = -rows_.psi.row(r) * (turned + (tag.accelerometer() ? 0.5 : 1.0) * more) -
                     rows_.per_drift(tag, p.axis) * now;
      }
      turned += more;
    }
  }

 private:
  static std::size_t at(Eigen::Index r) { return static_cast<std::size_t>(r); }
  double middle(std::size_t i) const { return end_[i] - 0.5 * rows_.drives[i].length; }
  /// Accelerometers read a mean, resolvers the end of an interval.
  double time_of(Eigen::Index r) const {
    const RowTag& tag = rows_.tags[at(r)];
    return tag.accelerometer() ? middle(tag.interval) : end_[tag.interval];
  }
  /// One of a readout in a row; 0 in rows of others.
  double unit_of(const Place& p, Eigen::Index r) const {
    const RowTag& tag = rows_.tags[at(r)];
    if (p.equation == Equation::accelerometer && tag.channel == p.axis)
      return 1.0 / rows_.acc_sigma_of(tag);
    if (p.equation == Equation::gimbal && tag.channel == 3 + p.axis)
      return 1.0 / rows_.gimbal_sigma_of(tag);
    return 0.0;
  }

  const LinearProblem& rows_;
  std::vector<double> end_;
};

double variance_of(const std::vector<double>& t) {
  double sum = 0.0, squares = 0.0;
  for (const double x : t) {
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<double>(t.size());
  return squares / n - sum / n * (sum / n);
}

double usual_distance(const std::vector<double>& t) {
  std::vector<double> all;
  for (std::size_t k = 1; k < t.size(); ++k) all.push_back(t[k] - t[k - 1]);
  return stats::upper_median(std::move(all));
}

/// Frequencies, quarters of a cycle over the longest recording apart.
struct Band {
  std::size_t first = 0, end = 0;
  double step = 0.0;  ///< [1/s]

  explicit Band(const Instants& at) : step(0.25 / at.span()) {
    constexpr std::size_t least_cycles = 2, least_rows = 8;
    const std::vector<double> t = at.read();
    if (t.size() < least_rows) return;
    first = 4 * least_cycles;
    const double distance =
        at.of_case() ? at.span() / static_cast<double>(t.size()) : usual_distance(t);
    // Some rows close together and days between them are no reason for a spectrum without end.
    const double most = 64.0 * static_cast<double>(t.size());
    end = static_cast<std::size_t>(std::min(0.5 / distance / step, most));
    width = static_cast<double>(end - std::min(first, end)) * step *
            std::sqrt(4.0 * std::numbers::pi * variance_of(t));
  }
  double width = 0.0;  ///< PeriodicInput::log_tries
  bool empty() const { return end < first + 8; }
};

/// Where the spectrum of an equation's innovations is highest, and where it stands out most from
/// what is beside it: a line among what parameters or noise make of slow frequencies.
std::array<std::size_t, 2> strongest_lines(const Instants& at, const Place& place,
                                           const VecX& innovations, const Band& band) {
  std::size_t bins = 1;
  while (bins < 8 * band.end) bins *= 2;  // eight or more to the fastest cycle
  std::vector<double> sum(bins, 0.0);
  const double per_s = static_cast<double>(bins) * band.step;  // four times the test in all
  at.each_instant(place, innovations, [&](double t, double value) {
    sum[static_cast<std::size_t>(std::llround(t * per_s)) % bins] += value;
  });
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, sum);
  std::vector<double> power(band.end);
  for (std::size_t k = 0; k < band.end; ++k) power[k] = std::norm(spectrum[k]);

  constexpr std::size_t block = 64;  // sixteen independent ones
  const auto from_first = [&](std::size_t k) {
    return power.begin() + static_cast<std::ptrdiff_t>(k);
  };
  const auto highest = std::max_element(from_first(band.first), power.end());
  std::array<std::size_t, 2> best{static_cast<std::size_t>(highest - power.begin()), band.first};
  double farthest = -1.0;
  for (std::size_t from = band.first; from < band.end; from += block) {
    const std::size_t to = std::min(from + block, band.end),
                      wide = from > band.first + block / 2 ? from - block / 2 : band.first,
                      until = std::min(to + block / 2, band.end);
    const double beside =
        std::max(stats::upper_median({from_first(wide), from_first(until)}), 1e-300);
    for (std::size_t k = from; k < to; ++k)
      if (const double out = power[k] / beside; out > farthest) {
        farthest = out;
        best[1] = k;
      }
  }
  return best;
}

struct Line {
  Place place;
  double frequency;
};

/// Some lines with their projected scores, strongest first.
std::vector<PeriodicInput> scored(const Instants& at, const std::vector<Line>& lines,
                                  const Projector& projector) {
  MatX columns(projector.r0().size(), static_cast<Eigen::Index>(2 * lines.size()));
  for (std::size_t k = 0; k < lines.size(); ++k)
    at.signature(lines[k].place, lines[k].frequency,
                 columns.middleCols(static_cast<Eigen::Index>(2 * k), 2));
  const MatX white = projector.whitener().apply(std::move(columns)), clean = projector.clean(white);
  std::vector<PeriodicInput> all;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(2 * k);
    const Eigen::Matrix2d C = white.middleCols(c, 2).transpose() * clean.middleCols(c, 2);
    const Eigen::Vector2d g = clean.middleCols(c, 2).transpose() * projector.r0();
    const double raw = white.middleCols(c, 2).squaredNorm(), trace = C.trace(),
                 least = 0.5 * trace - std::hypot(0.5 * (C(0, 0) - C(1, 1)), C(0, 1));
    PeriodicInput line{
        lines[k].place.equation, lines[k].place.axis, 1.0 / lines[k].frequency, 0.0, 0.0, 0.0, 0.0};
    if (least > VisibleLimits::left * raw) {
      const Eigen::Vector2d amplitude = C.inverse() * g;
      line.cosine = amplitude[0];
      line.sine = amplitude[1];
      line.T = g.dot(amplitude);
    }
    all.push_back(line);
  }
  std::ranges::stable_sort(all, std::greater{}, &PeriodicInput::T);
  return all;
}

}  // namespace

double PeriodicInput::p_value() const {
  return T > 0.0 ? std::min(1.0, std::exp(log_tries - 0.5 * T)) : 1.0;
}

double PeriodicInput::log_evidence() const {
  constexpr double least = VisibleLimits::size;
  if (!(T > 0.0)) return -std::numeric_limits<double>::infinity();
  // Of int exp(-a^2/2) I0(a z) da / (a log 100), for large a z.
  const double z = std::sqrt(T), far = std::max(z, least);
  return log_gain() +
         std::log(stats::normal_distribution(z - least) / (far * far * std::log(100.0)));
}

PeriodicInput strongest_periodic_input(const LinearProblem& problem, const Projector& projector) {
  const Instants at(problem);
  const Band band(at);
  const std::vector<Place> places = places_of(problem);
  if (band.empty() || places.empty()) return {};
  const VecX innovations = projector.clean_residual();
  std::vector<Line> lines;
  for (const Place& p : places)
    for (const std::size_t k : strongest_lines(at, p, innovations, band))
      lines.push_back({p, static_cast<double>(k) * band.step});
  std::vector<PeriodicInput> found = scored(at, lines, projector);
  // The best of them lie between the frequencies that were looked at; parts of a quarter cycle.
  constexpr std::size_t refined = 3;
  lines.clear();
  for (std::size_t k = 0; k < std::min(refined, found.size()); ++k)
    for (const double off : {-0.5, -0.25, 0.0, 0.25, 0.5})
      lines.push_back(
          {{found[k].equation, found[k].axis}, 1.0 / found[k].period_s + off * band.step});
  found = scored(at, lines, projector);
  PeriodicInput best = found.front();
  if (best.T <= 0.0) return {};
  lines.clear();
  for (const double off : {-0.125, -0.0625, 0.0625, 0.125})
    lines.push_back({{best.equation, best.axis}, 1.0 / best.period_s + off * band.step});
  if (const PeriodicInput beside = scored(at, lines, projector).front(); beside.T > best.T)
    best = beside;
  best.log_tries =
      std::log(static_cast<double>(places.size()) * (1.0 + band.width * std::sqrt(0.5 * best.T)));
  return best;
}

VecX trace_of(const PeriodicInput& input, const LinearProblem& problem,
              const Projector& projector) {
  MatX columns(problem.rows(), 2);
  Instants(problem).signature({input.equation, input.axis}, 1.0 / input.period_s, columns);
  return projector.clean(projector.whitener().apply(std::move(columns))) *
         Eigen::Vector2d(input.cosine, input.sine);
}

}  // namespace drift::inference
