#include "analysis/report/svg/svg_chart.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/svg/decimate.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "core/base/check.hpp"

namespace drift::report {
namespace {

// Around the axes of a panel [px].
constexpr double left = 70.0, right = 14.0, top = 32.0, bottom = 48.0;
constexpr double legend_line = 20.0;
constexpr std::string_view reference_colour = "#222222";

/// Draws one panel; its outer rectangle is given [px].
class PanelPainter {
 public:
  PanelPainter(SvgCanvas& canvas, const Panel& panel, double x, double y, double width,
               double height)
      : canvas_(canvas),
        panel_(panel),
        x0_(x + left),
        y0_(y + top),
        w_(width - left - right),
        h_(height - top - bottom) {
    Range xs, ys;
    const auto include = [](Range& range, const std::vector<double>& values, Spacing spacing) {
      for (const double v : values) range.include(spaced(v, spacing));
    };
    for (const auto& b : panel.expected) {
      include(xs, b.x, panel.x_spacing);
      include(ys, b.low, panel.y_spacing);
      include(ys, b.high, panel.y_spacing);
    }
    for (const auto& s : panel.series) {
      DRIFT_DEMAND(s.x.size() == s.y.size() && (s.sigma.empty() || s.sigma.size() == s.y.size()));
      include(xs, s.x, panel.x_spacing);
      for (const auto* values : {&s.y, &s.low, &s.high}) include(ys, *values, panel.y_spacing);
    }
    if (!ys.empty())
      for (const auto& r : panel.references) ys.include(spaced(r.y, panel.y_spacing));
    const bool linear = panel.x_spacing == Spacing::linear;
    if (linear && xs.low > 0.0 && xs.low < 0.05 * xs.high) xs.include(0.0);  // time starts at zero
    if (panel.y_range)
      ys = {spaced(panel.y_range->low, panel.y_spacing),
            spaced(panel.y_range->high, panel.y_spacing)};
    x_scale_ = make_scale(xs, static_cast<int>(w_ / (linear ? 56.0 : 40.0)), linear ? 0.0 : 0.02,
                          panel.x_spacing);
    y_scale_ = make_scale(ys, static_cast<int>(h_ / 32.0), 0.06, panel.y_spacing);
  }

  void paint() {
    axes();
    const bool empty = panel_.series.empty() && panel_.expected.empty();
    canvas_.push_window(x0_, y0_, w_, h_);
    if (!empty) {
      for (const auto& b : panel_.expected) area(b.x, b.low, b.high, fill_of(b.shade), 0.16);
      for (const double x : panel_.marks)
        canvas_.line(x_of(x), 0.0, x_of(x), h_, "#8a8a8a", 1.0, Stroke::dotted);
      for (const auto& s : panel_.series) sigma_band(s);
      for (const auto& r : panel_.references)
        canvas_.line(0.0, y_of(r.y), w_, y_of(r.y), reference_colour, 1.2, r.stroke);
      for (const auto& s : panel_.series) curve(s);
    }
    if (!panel_.note.empty())
      canvas_.text(0.5 * w_, 0.5 * h_, panel_.note,
                   {.anchor = "middle", .colour = "#666666", .halo = true});
    canvas_.pop_window();
  }

 private:
  double x_of(double x) const { return x_scale_.at(spaced(x, panel_.x_spacing), w_); }
  double y_of(double y) const { return h_ - y_scale_.at(spaced(y, panel_.y_spacing), h_); }

  void axes() {
    canvas_.text(x0_ + 0.5 * w_, y0_ - 12.0, panel_.title,
                 {.size = 13.0, .anchor = "middle", .bold = true});
    for (std::size_t i = 0; i < y_scale_.ticks.size(); ++i) {
      const double y = y0_ + h_ - y_scale_.at(y_scale_.ticks[i], h_);
      canvas_.line(x0_, y, x0_ + w_, y, "#e4e4e4", 1.0);
      canvas_.text(x0_ - 6.0, y + 3.5, y_scale_.labels[i], {.size = small_type, .anchor = "end"});
    }
    for (std::size_t i = 0; i < x_scale_.ticks.size(); ++i) {
      const double x = x0_ + x_scale_.at(x_scale_.ticks[i], w_);
      canvas_.line(x, y0_, x, y0_ + h_, "#f0f0f0", 1.0);
      canvas_.line(x, y0_ + h_, x, y0_ + h_ + 4.0, "#555555", 1.0);
      const std::string& label = x_scale_.labels[i];
      const double last = x0_ + w_ + right - 0.5 * text_pixels(label, small_type) - 3.0;
      canvas_.text(std::min(x, last), y0_ + h_ + 16.0, label,
                   {.size = small_type, .anchor = "middle"});
    }
    canvas_.line(x0_, y0_ + h_, x0_ + w_, y0_ + h_, "#555555", 1.0);
    canvas_.line(x0_, y0_, x0_, y0_ + h_, "#555555", 1.0);
    const auto labelled = [](const std::string& label, const AxisScale& scale) {
      return scale.factor.empty() ? label : label + "  " + scale.factor;
    };
    canvas_.text(x0_ + 0.5 * w_, y0_ + h_ + 34.0, labelled(panel_.x_label, x_scale_),
                 {.anchor = "middle"});
    canvas_.text(x0_ - left + 14.0, y0_ + 0.5 * h_, labelled(panel_.y_label, y_scale_),
                 {.anchor = "middle", .turned = -90.0});
  }

  void area(const std::vector<double>& x, const std::vector<double>& low,
            const std::vector<double>& high, std::string_view colour, double opacity) {
    // Thinned on either edge, so that neither loses its extremes.
    std::vector<std::size_t> kept = decimated(low, 1000), more = decimated(high, 1000);
    kept.insert(kept.end(), more.begin(), more.end());
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    std::vector<double> px, py_low, py_high;
    for (const std::size_t i : kept) {
      px.push_back(x_of(x[i]));
      py_low.push_back(y_of(low[i]));
      py_high.push_back(y_of(high[i]));
    }
    canvas_.area(px, py_low, py_high, colour, opacity);
  }

  void sigma_band(const Series& s) {
    if (s.drawn == Drawn::points) return;
    if (!s.low.empty()) area(s.x, s.low, s.high, palette(s.colour), 0.13);
    if (s.sigma.empty()) return;
    std::vector<double> low(s.y), high(s.y);
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      low[i] -= s.sigma[i];
      high[i] += s.sigma[i];
    }
    area(s.x, low, high, palette(s.colour), 0.13);
  }

  /// Dots with their intervals.
  void points(const Series& s) {
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      const double x = x_of(s.x[i]), y = y_of(s.y[i]);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      if (!s.low.empty())
        canvas_.line(x, y_of(s.low[i]), x, y_of(s.high[i]), palette(s.colour), 1.0);
      canvas_.rectangle(x - 1.8, y - 1.8, 3.6, 3.6, palette(s.colour));
    }
  }

  void curve(const Series& s) {
    if (s.drawn == Drawn::points) return points(s);
    std::vector<double> px, py;
    for (const std::size_t i : decimated(s.y)) {
      px.push_back(x_of(s.x[i]));
      py.push_back(y_of(s.y[i]));
    }
    canvas_.curve(px, py, palette(s.colour), 1.5, s.stroke);
  }

  SvgCanvas& canvas_;
  const Panel& panel_;
  double x0_, y0_, w_, h_;
  AxisScale x_scale_, y_scale_;
};

struct LegendEntry {
  std::string label;
  std::string_view colour;
  Stroke stroke;
  bool area;
};

std::vector<LegendEntry> legend_of(const Chart& chart) {
  std::vector<LegendEntry> entries;
  const auto add = [&](LegendEntry entry) {
    if (!entry.label.empty() &&
        std::ranges::find(entries, entry.label, &LegendEntry::label) == entries.end())
      entries.push_back(std::move(entry));
  };
  for (const auto& p : chart.panels)
    for (const auto& s : p.series) add({s.label, palette(s.colour), s.stroke, false});
  for (const auto& p : chart.panels)
    for (const auto& r : p.references) add({r.label, reference_colour, r.stroke, false});
  for (const auto& p : chart.panels)
    for (const auto& b : p.expected) add({b.label, fill_of(b.shade), Stroke::solid, true});
  return entries;
}

/// Draws the entries in lines of `width`, or measures if there is no canvas; returns the height.
double paint_legend(SvgCanvas* canvas, const std::vector<LegendEntry>& entries, double y,
                    double width) {
  double x = left, line = y;
  for (const auto& e : entries) {
    const double needed = 30.0 + text_pixels(e.label, label_type) + 18.0;
    if (x > left && x + needed > width) {
      x = left;
      line += legend_line;
    }
    if (canvas != nullptr) {
      if (e.area)
        canvas->rectangle(x, line - 9.0, 24.0, 10.0, e.colour, 0.25);
      else
        canvas->line(x, line - 4.0, x + 24.0, line - 4.0, e.colour, 2.0, e.stroke);
      canvas->text(x + 30.0, line, e.label);
    }
    x += needed;
  }
  return entries.empty() ? 0.0 : line - y + legend_line;
}

}  // namespace

std::string_view fill_of(Shade shade) {
  return shade == Shade::located ? palette(amber) : "#7F7F7F";
}

ChartParts parts_of(const Chart& chart) {
  const auto legend = legend_of(chart);
  const double title = chart.title.empty() ? 6.0 : 34.0,
               width = std::max(narrow_page, text_pixels(chart.title, 15.0) + 2.0 * canvas_edge);
  ChartParts parts{.head = {}, .head_width = width, .panels = {}};
  SvgCanvas head(width, title + paint_legend(nullptr, legend, 0.0, width), chart.title);
  head.text(canvas_edge, 24.0, chart.title, {.size = 15.0, .bold = true});
  paint_legend(&head, legend, title + 14.0, width);
  parts.head = std::move(head).finish();
  for (const Panel& panel : chart.panels) {
    SvgCanvas canvas(chart.panel_width, chart.panel_height, panel.title);
    PanelPainter(canvas, panel, 0.0, 0.0, chart.panel_width, chart.panel_height).paint();
    parts.panels.push_back(std::move(canvas).finish());
  }
  return parts;
}

std::string svg_of(const Chart& chart) {
  const std::size_t columns = std::max<std::size_t>(chart.columns, 1);
  const std::size_t rows = (chart.panels.size() + columns - 1) / columns;
  const double width = std::max(static_cast<double>(columns) * chart.panel_width + canvas_edge,
                                text_pixels(chart.title, 15.0) + 2.0 * canvas_edge);
  const auto legend = legend_of(chart);
  const double title = chart.title.empty() ? 6.0 : 34.0;
  const double head = title + paint_legend(nullptr, legend, 0.0, width);
  SvgCanvas canvas(width, head + static_cast<double>(rows) * chart.panel_height + 6.0, chart.title);
  canvas.text(canvas_edge, 24.0, chart.title, {.size = 15.0, .bold = true});
  paint_legend(&canvas, legend, title + 14.0, width);
  for (std::size_t k = 0; k < chart.panels.size(); ++k) {
    const std::size_t row = k / columns, column = k % columns;
    PanelPainter(canvas, chart.panels[k], static_cast<double>(column) * chart.panel_width,
                 head + static_cast<double>(row) * chart.panel_height, chart.panel_width,
                 chart.panel_height)
        .paint();
  }
  return std::move(canvas).finish();
}

}  // namespace drift::report
