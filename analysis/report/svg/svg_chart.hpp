#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/report/svg/axis_scale.hpp"
#include "analysis/report/svg/svg_canvas.hpp"

namespace drift::report {

/// How the points of a series are shown: joined, or each by itself with a bar from low to high.
enum class Drawn { curve, points };

/// A curve, with an optional band of +-1 sigma around it.
struct Series {
  std::string label;  ///< in the legend; series of equal label share one entry
  std::vector<double> x, y;
  std::vector<double> sigma;                ///< empty: no band
  std::vector<double> low = {}, high = {};  ///< instead of sigma: a band with edges of its own
  std::size_t colour = 0;                   ///< index in the palette
  Stroke stroke = Stroke::solid;
  Drawn drawn = Drawn::curve;
};

/// What an area says of what lies in it, and the colour that says so.
enum class Shade {
  expected,  ///< values should lie here
  located,   ///< something is here
};
std::string_view fill_of(Shade shade);

/// An area behind the curves.
struct ExpectedBand {
  std::string label;
  std::vector<double> x, low, high;
  Shade shade = Shade::expected;
};

/// A horizontal line, named in the legend: at the line, curves that end there would cross its name.
struct ReferenceLine {
  double y = 0.0;
  std::string label;
  Stroke stroke = Stroke::dashed;
};

/// One pair of axes.
struct Panel {
  std::string title, x_label, y_label;  ///< labels with their units
  std::vector<ExpectedBand> expected;
  std::vector<Series> series;
  std::vector<ReferenceLine> references;
  std::optional<Range> y_range;    ///< empty: all of the curves; what is outside is cut off
  std::string note;                ///< in the middle of the panel, where there is nothing to draw
  std::vector<double> marks = {};  ///< vertical lines, where something begins
  Spacing x_spacing = Spacing::linear, y_spacing = Spacing::linear;
};

/// Panels in a grid, filled row by row, with one legend.
struct Chart {
  std::string title;
  std::vector<Panel> panels;
  std::size_t columns = 1;
  double panel_width = 360.0, panel_height = 250.0;  ///< [px]
};

/// The chart as an SVG document. Curves of more than 2000 points are thinned, extremes kept; NaN
/// and infinity are gaps.
std::string svg_of(const Chart& chart);

/// The same in parts, each an SVG document, for a page that lets them flow: title and legend, and
/// every panel.
struct ChartParts {
  std::string head;
  double head_width = 0.0;  ///< [px]
  std::vector<std::string> panels;
};
ChartParts parts_of(const Chart& chart);

}  // namespace drift::report
