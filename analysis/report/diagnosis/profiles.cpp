#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/zoomable.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

using diagnosis::Profile;

constexpr double shown_loss = 14.0, loss_95 = 3.841;
constexpr double shown_sigmas = 5.0;  // further refits would press the rest into a line

std::vector<Profile::Point> shown_points(const Profile& p) {
  std::vector<Profile::Point> shown = p.points;
  std::erase_if(shown, [&](const Profile::Point& q) {
    return std::abs(q.value - p.value) > shown_sigmas * p.sigma;
  });
  return shown;
}

/// Between the refits on the signed root of the loss, which is straight where the profile is a
/// parabola.
Series between_refits(const Profile& p) {
  Series s = curve("refits, everything else fitted again", 0, Stroke::solid);
  std::vector<std::pair<double, double>> roots{{p.top, 0.0}};
  for (const Profile::Point& q : shown_points(p))
    if (q.value != p.top)
      roots.emplace_back(q.value, std::copysign(std::sqrt(q.loss), q.value - p.top));
  std::ranges::sort(roots);
  constexpr int fine = 24;
  for (std::size_t k = 0; k + 1 < roots.size(); ++k)
    for (int i = 0; i <= fine; ++i) {
      const double part = static_cast<double>(i) / fine;
      const double root = (1.0 - part) * roots[k].second + part * roots[k + 1].second;
      s.x.push_back((1.0 - part) * roots[k].first + part * roots[k + 1].first);
      s.y.push_back(root * root);
    }
  return s;
}

Panel profile_panel(const Profile& p) {
  Panel panel;
  panel.title = fmt::format("{}: {}", p.label, p.key);
  const std::string what = p.less_mean ? fmt::format("{} {}", p.key, note_in_words(p)) : p.key;
  panel.x_label = p.unit == "1" ? what : fmt::format("{} [{}]", what, p.unit);
  panel.y_label = "loss, 2 log likelihood";
  Series parabola = curve("what its sigma says", 1, Stroke::dashed);
  const double low = p.value - 3.5 * p.sigma, high = p.value + 3.5 * p.sigma;
  constexpr int fine = 100;
  for (int i = 0; i <= fine; ++i) {
    const double x = low + (high - low) * i / fine;
    parabola.x.push_back(x);
    parabola.y.push_back(std::pow((x - p.value) / p.sigma, 2));
  }
  Series refits = curve("refits, everything else fitted again", 0);
  refits.drawn = Drawn::points;
  for (const Profile::Point& q : shown_points(p)) {
    refits.x.push_back(q.value);
    refits.y.push_back(q.loss);
  }
  panel.series = {std::move(parabola), between_refits(p), std::move(refits)};
  panel.references.push_back({loss_95, "95 % interval", Stroke::dotted});
  panel.y_range = Range{0.0, shown_loss};
  for (const double end : {p.low_95, p.high_95})
    if (std::isfinite(end)) panel.marks.push_back(end);
  return panel;
}

std::string unit_after(const Profile& p) {
  return p.unit == "1" ? "" : " " + p.unit;
}

/// The interval by refits beside that of the sigma.
std::string profile_in_words(const Profile& p) {
  const double half = stats::half_width_95 * p.sigma, low = p.value - half, high = p.value + half;
  const auto number = [&](double v) {
    if (!std::isfinite(v)) return std::string("beyond the refits");
    return p.param == closure_param ? lambda_in_words(v, 0.5 * p.sigma)
                                    : to_match(v, 0.5 * p.sigma);
  };
  const bool agrees = stats::normal_says(p.value, p.sigma, p.low_95, p.high_95);
  std::string said =
      fmt::format("{} {}{}: {} to {}{} by refits, {} to {} by its sigma: {}.", p.label, p.key,
                  p.less_mean ? ", " + note_in_words(p) : "", number(p.low_95), number(p.high_95),
                  unit_after(p), number(low), number(high),
                  agrees ? "they agree" : "take the interval by refits");
  if (p.param == closure_param)
    for (const Profile::Point& q : p.points)
      if (q.value == 0.0 || q.value == 1.0)
        said += fmt::format(" Eq. ({}), lambda = {:.0f}, loses {}.", q.value == 0.0 ? 5 : 6,
                            q.value, number_text(q.loss));
  return said;
}

}  // namespace

Json profiles_json(const std::vector<Profile>& profiles) {
  Json all = Json::array();
  for (const Profile& p : profiles) {
    Json points = Json::array();
    for (const Profile::Point& q : p.points)
      points.push_back({{"value", q.value}, {"loss", q.loss}});
    all.push_back({{"cause", p.label},
                   {"key", p.key},
                   {"unit", p.unit},
                   {"note", text_or_null(note_in_words(p))},
                   {"value", p.value},
                   {"sigma", p.sigma},
                   {"top", p.top},
                   {"interval_95", {p.low_95, p.high_95}},
                   {"refits", std::move(points)}});
  }
  return all;
}

/// How the fit gets worse where a parameter of a cause is held elsewhere.
Section profiles(const diagnosis::Diagnosis& d) {
  if (d.profiles.empty()) return {};
  Chart chart{"Profiles of the parameters of the causes", {}, 2, half_sheet, 250.0};
  Sentences said;
  for (const Profile& p : d.profiles) {
    chart.panels.push_back(profile_panel(p));
    said.items.push_back(profile_in_words(p));
  }
  if (d.field)
    said.items.push_back(
        "The magnetic field is held as it is assumed: its error is in the ± of the verdict alone.");
  return {"How well is the size known?",
          {figure_of(chart,
                     "What is lost where the parameter is held at a value and everything else is "
                     "fitted again through the full dynamics (dots). Dashed: the parabola that its "
                     "sigma stands for. Below the dotted line is the 95 % interval, between the "
                     "vertical lines.",
                     "profiles.svg"),
           std::move(said)},
          On::page};
}

}  // namespace drift::report
