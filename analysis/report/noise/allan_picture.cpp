#include <cmath>

#include "analysis/report/noise/noise.hpp"
#include "analysis/report/noise/noise_units.hpp"
#include "analysis/report/svg/curve.hpp"

namespace drift::report {
namespace {

using preparation::ChannelNoise, preparation::NoiseCard;

Panel panel_of(std::string title, std::string x, std::string y) {
  Panel panel{};
  panel.title = std::move(title);
  panel.x_label = std::move(x);
  panel.y_label = std::move(y);
  panel.x_spacing = panel.y_spacing = Spacing::logarithmic;
  return panel;
}

/// The deviation of every channel, the fit through it and, dotted, each noise in it.
void add_deviation(Panel& panel, const ChannelNoise& c, std::size_t colour, double size) {
  Series dots = curve(c.channel, colour), fit = curve(c.channel, colour);
  dots.drawn = Drawn::points;
  for (const stats::AllanPoint& p : c.fit.points) {
    dots.x.push_back(p.tau);
    dots.y.push_back(p.deviation / size);
    dots.low.push_back(p.low / size);
    dots.high.push_back(p.high / size);
    fit.x.push_back(p.tau);
    fit.y.push_back(p.fitted / size);
  }
  std::size_t parts = 0;
  for (const auto& k : c.fit.coefficients) parts += k.found ? 1 : 0;
  for (int a = 0; parts > 1 && a < stats::allan_noises; ++a) {
    const stats::AllanCoefficient& k = c.fit.coefficients[a];
    if (!k.found) continue;
    Series part = curve("", colour, Stroke::dotted);
    for (const stats::AllanPoint& p : c.fit.points) {
      part.x.push_back(p.tau);
      const double deviation = k.value * std::sqrt(stats::allan_slopes(p.tau)[a]);
      // Where a part is far below the whole it only makes the picture taller.
      part.y.push_back(deviation > 0.2 * p.fitted ? deviation / size : std::nan(""));
    }
    panel.series.push_back(std::move(part));
  }
  panel.series.push_back(std::move(fit));
  panel.series.push_back(std::move(dots));
}

void add_spectrum(Panel& panel, const ChannelNoise& c, std::size_t colour, double size) {
  Series line = curve(c.channel, colour);
  for (std::size_t i = 0; i < c.spectrum.frequency.size(); ++i) {
    line.x.push_back(c.spectrum.frequency[i]);
    line.y.push_back(std::sqrt(c.spectrum.density[i]) / size);
  }
  panel.series.push_back(std::move(line));
}

}  // namespace

std::string allan_picture(const NoiseCard& card) {
  Chart chart;
  chart.title = "Noise at rest";
  chart.columns = 2;
  chart.panel_width = 268.0;  // two fit into a page of 600 px
  chart.panel_height = 270.0;
  for (const Sensor sensor : sensors) {
    const double size = noise_units(sensor, 1.0)[2].size;
    const std::string unit = sensor == Sensor::gyro ? "deg/h" : "ug";
    Panel allan = panel_of(
        sensor == Sensor::gyro ? "Gyros: Allan deviation" : "Accelerometers: Allan deviation",
        "averaging time [s]", "[" + unit + "]");
    Panel spectrum = panel_of("Spectral density", "frequency [Hz]", "[" + unit + "/sqrt(Hz)]");
    std::size_t colour = sensor == Sensor::gyro ? 0 : 3;
    for (const ChannelNoise& c : card.channels) {
      if (sensor_of(c.channel) != sensor) continue;
      add_deviation(allan, c, colour, size);
      add_spectrum(spectrum, c, colour++, size);
    }
    if (allan.series.empty()) continue;
    if (spectrum.series.front().x.empty()) spectrum.note = "rests too short";
    chart.panels.push_back(std::move(allan));
    chart.panels.push_back(std::move(spectrum));
  }
  return svg_of(chart);
}

}  // namespace drift::report
