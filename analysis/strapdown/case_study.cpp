#include "analysis/strapdown/case_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/preparation/fillers.hpp"
#include "analysis/preparation/gravity_check.hpp"
#include "analysis/preparation/held_rows.hpp"
#include "analysis/strapdown/checks/saturated.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "analysis/strapdown/dead_channels.hpp"
#include "analysis/strapdown/gyro_unit.hpp"
#include "analysis/strapdown/turn_scale.hpp"
#include "core/base/check.hpp"
#include "core/estimate/layout.hpp"
#include "core/estimate/strapdown/accelerometer_fit.hpp"
#include "core/estimate/strapdown/lone_samples.hpp"
#include "core/recording/rows/check_time.hpp"
#include "core/recording/rows/parabola.hpp"
#include "core/recording/rows/smooth_reading.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::strapdown {
namespace {

constexpr auto fixed_drift = TermLibrary::index("D_F_x");

/// What a thermometer says at an instant: of one that reads in steps what these show, of any other
/// the parabola through half a minute on both sides. Heat takes minutes to move: of a swing of ten
/// minutes that leaves 0.9999. Where rows are few, the row itself.
class Thermometer {
 public:
  Thermometer(const Recording& recording, const CovariateSpec& c)
      : times_(recording.find("time")->values),
        values_(recording.find(c.name)->values),
        stepped_(SmoothReading::of(recording, c.name)) {}

  double at(double t) const {
    constexpr double half = 30.0;  // [s]
    constexpr std::size_t fewest = 12;
    if (stepped_)
      if (const auto there = stepped_->at(t)) return *there;
    if (const auto there = parabola_at(times_, values_, t, half, fewest)) return there->value;
    const auto row = std::ranges::lower_bound(times_, t) - times_.begin();
    return values_[std::min(static_cast<std::size_t>(row), values_.size() - 1)];
  }

 private:
  const std::vector<double>&times_, &values_;
  std::optional<SmoothReading> stepped_;
};

/// A number, as its deviation from the mean of the recording, in each interval: a line with the
/// mean and the rate that it has while the gyros are read.
void take_number(const CovariateSpec& c, const Recording& recording, CaseTest& test) {
  Timeline& timeline = test.timeline;
  const Channel* column = recording.find(c.name);
  const Channel* time = recording.find("time");
  if (column == nullptr || time == nullptr) return;
  double mean = 0.0;
  for (const double v : column->values) {
    if (!std::isfinite(v)) return;
    mean += v / static_cast<double>(column->values.size());
  }
  timeline.carried |= c.set();
  timeline.mean[c] = mean;
  const Thermometer thermometer(recording, c);
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    Interval& i = timeline.intervals[k];
    const auto [begin, end] = test.read_over[k];
    const double at_begin = thermometer.at(begin), at_end = thermometer.at(end),
                 within = (at_begin + 4.0 * thermometer.at(0.5 * (begin + end)) + at_end) / 6.0;
    const double change = (at_end - at_begin) * i.length() / (end - begin);
    i.around0[c] = within - 0.5 * change - mean;
    i.around1[c] = within + 0.5 * change - mean;
  }
}

/// The accelerometers from what they read of gravity; nothing where the dwells are too few to tell.
Theta calibrated_on_gravity(const std::vector<Dwell>& dwells) {
  std::vector<Vec3> outputs;
  for (const Dwell& d : dwells) outputs.push_back(d.acc);
  for (const auto model : {AccelerometerModel::misaligned, AccelerometerModel::bias_scale})
    if (outputs.size() > parameters_of(model).size())
      return fit_accelerometers(model, outputs).theta;
  return Theta::Zero();
}

void lay_out_one_way(const mc::Study& study, const Signals& signals, CaseStudy& out) {
  out.start = calibrated_on_gravity(out.search.dwells);
  const SpecificForce force(out.start);
  std::vector<Dwell> dwells = out.search.dwells;
  for (Dwell& d : dwells) d.acc = force(d.acc);
  out.test = lay_out_case(signals, dwells, study.site, Carry::one_way);
  double still = 0.0;
  Vec3 drift = Vec3::Zero();
  for (std::size_t d = 0; d < dwells.size(); ++d)
    if (out.test.still[d]) {
      drift += dwells[d].gyro;
      still += 1.0;
    }
  for (int a = 0; a < 3; ++a)
    out.start[fixed_drift + static_cast<std::size_t>(a)] = drift[a] / still;
}

std::vector<preparation::RestingRows> resting_rows(const DwellSearch& search) {
  std::vector<preparation::RestingRows> rests;
  for (const Dwell& d : search.dwells) rests.push_back({d.first, d.last});
  return rests;
}

/// The first samples of a gyro that lie off those around them, alone, and how many there are.
void remark_lone_samples(const Signals& signals, const Recording& recording,
                         std::vector<std::string>& remarks) {
  constexpr std::size_t most_said = 3;
  const std::vector<LoneSample> all = lone_gyro_samples(signals);
  for (std::size_t k = 0; k < std::min(all.size(), most_said); ++k) {
    const LoneSample& s = all[k];
    const std::string line = s.sample < recording.lines.size()
                                 ? fmt::format(" (line {})", recording.lines[s.sample])
                                 : "";
    remarks.push_back(fmt::format(
        "gyro_{} at {:.6g} s{} lies {:.3g} deg/s off the samples around it, alone, as a motion "
        "does "
        "not: it turns the attitude by {:.2g} deg. If it is wrong, leave its cell empty",
        "xyz"[s.axis], signals.time[s.sample], line, std::abs(s.off) / detail::deg,
        std::abs(s.turns) / detail::deg));
  }
  if (all.size() > most_said)
    remarks.push_back(fmt::format("{} more samples of gyros lie off those around them, alone",
                                  all.size() - most_said));
}

/// What is lost to samples that are missing.
void remark_gaps(const CaseTest& test, std::vector<std::string>& remarks) {
  if (test.ways_with_gap == 0) return;
  const std::size_t all = test.ways.size() + test.ways_with_gap;
  remarks.push_back(
      fmt::format("{} of the {} turns between dwells {} left out for gaps, two samples or more "
                  "that are missing "
                  "in a row: nothing carries the attitude across",
                  test.ways_with_gap, all, test.ways_with_gap == 1 ? "is" : "are"));
}

constexpr auto scale_factor = TermLibrary::index("s_x");

/// 1 sigma of a gyro's scale factor, before it is known of which grade the unit is.
double widest_scale(const mc::Study& study) {
  double widest = 0.0;
  for (std::size_t p = scale_factor; p < scale_factor + 3; ++p) {
    widest = std::max(widest, consumer_prior(p).sigma());
    if (!study.filters.empty())
      widest = std::max(widest, study.filters.front().believed(p).sigma());
  }
  return widest;
}

/// The same of gyros x, y, z as they are fitted.
Vec3 scales(const mc::Study& study, const CaseStudy& of) {
  FilterSpec filter = study.filters.empty() ? FilterSpec{} : study.filters.front();
  if (!of.compass.sees_earth) take_consumer_priors(filter);
  Vec3 all;
  for (int a = 0; a < 3; ++a)
    all[a] = study.filters.empty()
                 ? widest_scale(study)
                 : filter.believed(scale_factor + static_cast<std::size_t>(a)).sigma();
  return all;
}

bool levelled_by_calibrated(const CaseStudy& of) {
  return of.start[TermLibrary::index("K0_x")] != 0.0;
}

}  // namespace

double drift_prior(const mc::Study& study) {
  double largest = 0.0;
  for (std::size_t p = fixed_drift; p < fixed_drift + 3; ++p) {
    const Prior library = TermLibrary::specs[p].prior_si();
    const Prior prior = study.filters.empty() ? library : study.filters.front().believed(p);
    largest = std::max(largest, prior.sigma());
  }
  return largest;
}

preparation::NoiseCard noise_of(const Recording& recording, const DwellSearch& search) {
  return preparation::noise_card(recording, RecordingKind::strapdown, resting_rows(search));
}

std::vector<Saturation> leave_out_not_measured(Recording& recording,
                                               std::vector<std::string>& remarks) {
  preparation::leave_out_fillers_on_a_case(recording, remarks);
  std::vector<Saturation> saturated = leave_out_saturated(recording);
  preparation::leave_out_stuck(recording, remarks);
  return saturated;
}

std::vector<std::string> CaseStudy::all_remarks() const {
  std::vector<std::string> all = remarks;
  if (!saturated.empty()) all.insert(all.begin(), saturated);
  return all;
}

CaseStudy case_study(const mc::Study& study, const Recording& given) {
  mc::require_own_terms(study);
  check_recording(given, RecordingKind::strapdown);
  CaseStudy out;
  Recording recording = given;
  number_rows(recording, recording.rows());
  const std::vector<Saturation> saturated = leave_out_not_measured(recording, out.remarks);
  out.source = recording.source;
  out.static_min = study.static_min;
  const Signals signals = signals_of(recording);
  out.search = find_dwells(signals, {.static_min = study.static_min});
  if (out.search.dwells.empty())
    throw InputError(ExitCode::recording,
                     fmt::format("{}: {}", out.source,
                                 why_no_dwell(signals, study.static_min, out.search.longest_left)));
  out.saturated = saturation_text(saturated, recording, out.search.dwells);
  require_live_accelerometers(out.search.dwells, out.source);
  if (const std::string wrong =
          preparation::accelerometers_in_another_unit(recording, resting_rows(out.search));
      !wrong.empty())
    throw InputError(ExitCode::recording, wrong);
  require_gyro_unit(signals, out.search.dwells, study.site, out.source);
  require_turn_scale(signals, out.search.dwells, study.site, out.source, widest_scale(study));
  remark_lone_samples(signals, recording, out.remarks);
  out.noise = noise_of(recording, out.search);
  // Each round knows better how the Earth turned the unit during the test.
  constexpr int rounds = 3;
  std::vector<double> azimuth;
  for (int round = 0; round < rounds; ++round) {
    out.test = lay_out_case(signals, out.search.dwells, study.site, Carry::through, azimuth,
                            study.accelerometers_in_turns ? InTurns::read : InTurns::left_out);
    out.compass = gyrocompass(out.test, azimuth, drift_prior(study));
    if (!out.compass.sees_earth) break;
    azimuth = out.compass.azimuth;
  }
  if (!out.compass.sees_earth) lay_out_one_way(study, signals, out);
  remark_gaps(out.test, out.remarks);
  if (const std::string off = turn_scale_remark(signals, out.search.dwells, scales(study, out));
      !off.empty())
    out.remarks.push_back(off);
  for (const CovariateSpec& c : known_covariates)
    if (!c.is_vector()) take_number(c, recording, out.test);
  return out;
}

FilterSpec case_filter(const FilterSpec& filter, const CaseStudy& of) {
  constexpr double of_the_same_data = 10.0, least = 2e-3, most = 1.0;  // [], [rad], [rad]
  // Levelled by accelerometers that are calibrated on gravity, and by some that are not.
  constexpr double calibrated = 0.03, as_bought = 0.3;  // [rad]
  FilterSpec out = filter;
  if (const auto other = facts(filter.coupling).other) out.coupling = *other;
  if (!of.compass.sees_earth) {
    take_consumer_priors(out);
    // Of a width of 20 deg/s a mean says nothing, but every fit starts from it.
    for (std::size_t p = fixed_drift; p < fixed_drift + 3; ++p)
      if (out.priors[p].kind == Prior::Kind::normal && out.priors[p].mean() == 0.0)
        out.priors[p] = normal(of.start[p], out.priors[p].sigma());
  }
  for (const std::size_t p : zero_by_definition) out.priors[p] = fixed(0.0);
  if (of.compass.sees_earth)
    out.initial_attitude = std::clamp(of_the_same_data * of.compass.sigma, least, most);
  else
    out.initial_attitude = levelled_by_calibrated(of) ? calibrated : as_bought;
  if (out.noise.angle_random_walk == 0.0) out.noise.angle_random_walk = of.test.angle_random_walk;
  return out;
}

Theta start_of(const FilterSpec& case_filter, const CaseStudy& of) {
  const Layout layout = make_layout(case_filter);
  Theta start = layout.theta;
  for (const std::size_t p : layout.params)
    if (of.start[p] != 0.0) start[p] = of.start[p];
  return start;
}

}  // namespace drift::strapdown
