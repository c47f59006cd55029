#include <algorithm>
#include <cmath>

#include "analysis/report/strapdown/report.hpp"
#include "core/base/check.hpp"

namespace drift::report {
namespace {

using strapdown::Score;
using strapdown::Trial;

std::string line(std::size_t width) {
  return std::string(width, '-') + "\n";
}

constexpr std::size_t score_width = 34;

std::string score_head() {
  return fmt::format("{:>10}{:>9} {:<14}", "in", "held out", "95 %");
}

std::string held(const std::optional<Score>& score) {
  if (!score) return std::string(score_width, ' ');
  return fmt::format("{:>10.3g}{:>9.3g} {:<14}", score->in_sample, score->held_out,
                     fmt::format("{:.3g}..{:.3g}", score->low, score->high));
}

/// Why each trial ended as it did, numbered as in the table above.
std::string reasons(const std::vector<Trial>& trials) {
  std::string text;
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (!trials[k].reason.empty())
      text +=
          fmt::format("{:>3} {} against '{}': {}\n", k + 1, strapdown::name_of(trials[k].verdict),
                      trials[k].against, trials[k].reason);
  return text + "\n";
}

std::size_t name_width(const std::vector<Trial>& trials) {
  std::size_t width = 5;
  for (const Trial& t : trials) width = std::max(width, t.name.size());
  return width + 2;
}

std::string dwells_text(const strapdown::StrapdownResult& r) {
  const auto& dwells = r.search.dwells;
  std::vector<double> lengths;
  for (const auto& d : dwells) lengths.push_back(d.duration());
  std::sort(lengths.begin(), lengths.end());
  std::string text = fmt::format(
      "{} dwells of {} s or more: first {:.1f} s, median {:.1f} s; {} turns between them",
      dwells.size(), r.options.static_min, dwells.front().duration(), lengths[lengths.size() / 2],
      r.rotations);
  if (r.rotations_omitted > 0) text += fmt::format(", {} left out for gaps", r.rotations_omitted);
  return text +
         fmt::format(
             "\nquiet: gyro spread below {:.3g} deg/s (at rest {:.3g}), accelerometer spread "
             "below {:.3g} m/s^2 (at rest {:.3g})\n\n",
             r.search.gyro_threshold / unit::deg_per_s.to_si,
             r.search.gyro_floor / unit::deg_per_s.to_si,
             r.search.acc_threshold * r.options.gravity, r.search.acc_floor * r.options.gravity);
}

std::string accelerometers_text(const strapdown::StrapdownResult& r) {
  const std::size_t width = name_width(r.accelerometer_trials);
  std::string text = fmt::format(
      "Accelerometers: |f| - g in dwells [m/s^2], root mean square; z: gain in standard errors\n"
      "    {:<{}}{:>4}{}{:>6}  {}\n",
      "model", width, "par", score_head(), "z", "verdict");
  text += line(width + 60);
  std::size_t number = 0;
  for (const Trial& t : r.accelerometer_trials)
    text += fmt::format("{:>3} {:<{}}{:>4}{}{:>6.1f}  {}\n", ++number, t.name, width, t.parameters,
                        held(t.gravity), t.z_dwell, strapdown::name_of(t.verdict));
  return text + reasons(r.accelerometer_trials);
}

std::string gyros_text(const strapdown::StrapdownResult& r) {
  const std::size_t width = name_width(r.gyro_trials);
  std::string text = fmt::format(
      "Gyros: w_g - w_l in dwells [deg/s], then up after a turn [deg], root mean square\n"
      "    {:<{}}{:<4}{:>4}{}{:>6}{}{:>6}  {}\n",
      "model", width, "eq", "par", score_head(), "z", score_head(), "z", "verdict");
  text += line(width + 104);
  std::size_t number = 0;
  for (const Trial& t : r.gyro_trials)
    text += fmt::format("{:>3} {:<{}}{:<4}{:>4}{}{:>6.1f}{}{:>6.1f}  {}\n", ++number, t.name, width,
                        t.equation, t.parameters, held(t.dwell), t.z_dwell, held(t.rotation),
                        t.z_rotation, strapdown::name_of(t.verdict));
  return text + reasons(r.gyro_trials);
}

std::string parameters_text(const strapdown::StrapdownResult& r) {
  std::string text = fmt::format("Parameters of '{}'\n{:<8}{:>14}{:>12}  {:<12}{}\n",
                                 r.accepted.front().name, "key", "value", "sigma", "unit", "");
  text += line(46);
  for (const auto& p : r.parameters)
    text +=
        fmt::format("{:<8}{:>14.6g}{:>12.3g}  {:<12}{}\n", p.key, p.value, p.sigma, p.unit, p.note);
  return text + "\n";
}

}  // namespace

std::string to_text(const strapdown::StrapdownResult& r) {
  std::string text = fmt::format("Strapdown recording {}\n", r.source);
  text += dwells_text(r) + accelerometers_text(r) + gyros_text(r);
  for (const auto& c : r.contest)
    text += fmt::format(
        "Held-out turns: eq. (5) {:.4g} deg, eq. (6) {:.4g} deg ({:.1f} standard errors {})\n\n",
        c.eq5.held_out, c.eq6.held_out, std::abs(c.z),
        c.z > 0.0 ? "in favour of eq. (5)" : (c.z < 0.0 ? "in favour of eq. (6)" : "apart"));
  text += parameters_text(r) + "Not observable in this recording\n" + line(46);
  for (const auto& u : r.unobservable) text += fmt::format("{}: {}\n", u.what, u.reason);
  return text;
}

}  // namespace drift::report
