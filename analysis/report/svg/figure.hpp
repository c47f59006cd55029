#pragma once

#include "analysis/report/page/report.hpp"
#include "analysis/report/svg/svg_chart.hpp"

namespace drift::report {

/// The chart as a picture whose panels flow on a page.
Figure figure_of(const Chart& chart, std::string caption, std::string file = {});

/// A drawing of one width (bars, dumbbells, a heat map); for a narrow page it is drawn anew, as
/// text that is scaled down cannot be read.
template <class Drawing>
requires requires(Drawing d) {
  d.width = narrow_page;
}
Figure figure_of(Drawing drawing, const std::string& caption, const std::string& file = {}) {
  Figure figure{.svg = svg_of(drawing), .caption = caption, .file = file};
  if (drawing.width <= narrow_page) return figure;
  drawing.width = narrow_page;
  figure.narrow = svg_of(drawing);
  return figure;
}

}  // namespace drift::report
