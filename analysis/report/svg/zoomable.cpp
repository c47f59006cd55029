#include "analysis/report/svg/zoomable.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "analysis/report/svg/decimate.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_points = 4000;
constexpr int x_digits = 7, y_digits = 5, sigma_digits = 3;

/// Numbers of a few digits: written by hand, as a JSON library writes seventeen.
std::string list_of_numbers(std::span<const double> values, const std::vector<std::size_t>& kept,
                            int digits) {
  std::string out = "[";
  for (const std::size_t i : kept) {
    if (out.size() > 1) out += ',';
    out += std::isfinite(values[i]) ? fmt::format("{:.{}g}", values[i], digits) : "null";
  }
  return out + "]";
}

std::string all_numbers(std::span<const double> values, int digits) {
  std::vector<std::size_t> all(values.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return list_of_numbers(values, all, digits);
}

/// A text as JSON that ends no script.
std::string quoted(const std::string& text) {
  std::string out =
      nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  for (auto at = out.find('<'); at != std::string::npos; at = out.find('<', at))
    out.replace(at, 1, "\\u003c");
  return out;
}

std::string_view word_of(Stroke stroke) {
  switch (stroke) {
    case Stroke::dashed:
      return "dashed";
    case Stroke::dotted:
      return "dotted";
    case Stroke::solid:
      break;
  }
  return "solid";
}

std::string series_numbers(const Panel& panel) {
  std::string out;
  std::vector<std::string> xs;
  for (const Series& s : panel.series) {
    const std::vector<std::size_t> kept = decimated(s.y, most_points);
    std::string x = list_of_numbers(s.x, kept, x_digits);
    const auto same = std::ranges::find(xs, x) - xs.begin();
    xs.push_back(x);
    if (same + 1 < std::ssize(xs)) x = std::to_string(same);
    out += fmt::format("{}{{\"label\":{},\"colour\":\"{}\",\"stroke\":\"{}\",\"x\":{},\"y\":{}",
                       out.empty() ? "" : ",", quoted(s.label), palette(s.colour),
                       word_of(s.stroke), x, list_of_numbers(s.y, kept, y_digits));
    if (!s.sigma.empty())
      out += fmt::format(",\"sigma\":{}", list_of_numbers(s.sigma, kept, sigma_digits));
    out += "}";
  }
  return out;
}

std::string panel_numbers(const Panel& panel) {
  std::string bands;
  for (const ExpectedBand& b : panel.expected)
    bands += fmt::format("{}{{\"colour\":\"{}\",\"x\":{},\"low\":{},\"high\":{}}}",
                         bands.empty() ? "" : ",", fill_of(b.shade), all_numbers(b.x, x_digits),
                         all_numbers(b.low, y_digits), all_numbers(b.high, y_digits));
  std::vector<double> lines;
  for (const ReferenceLine& r : panel.references) lines.push_back(r.y);
  const std::string range =
      panel.y_range ? fmt::format("[{:.5g},{:.5g}]", panel.y_range->low, panel.y_range->high)
                    : "null";
  return fmt::format(
      "{{\"title\":{},\"x\":{},\"y\":{},\"range\":{},\"series\":[{}],\"bands\":[{}],\"lines\":{},"
      "\"marks\":{}}}",
      quoted(panel.title), quoted(panel.x_label), quoted(panel.y_label), range,
      series_numbers(panel), bands, all_numbers(lines, y_digits),
      all_numbers(panel.marks, x_digits));
}

}  // namespace

std::string zoom_numbers(const Chart& chart) {
  std::string out;
  for (const Panel& panel : chart.panels) out += (out.empty() ? "" : ",") + panel_numbers(panel);
  return "[" + out + "]";
}

Figure figure_of(const Chart& chart, std::string caption, std::string file) {
  ChartParts parts = parts_of(chart);
  Figure figure{.svg = svg_of(chart),
                .caption = std::move(caption),
                .file = std::move(file),
                .flowing = {std::move(parts.head), std::move(parts.panels), chart.columns,
                            chart.panel_width, parts.head_width}};
  if (chart.panel_width <= narrow_page) return figure;
  Chart narrow = chart;
  narrow.panel_width = narrow_page - canvas_edge;
  narrow.columns = 1;
  figure.narrow = svg_of(narrow);
  return figure;
}

Figure zoomable(const Chart& chart, std::string caption, std::string file) {
  Figure figure = figure_of(chart, std::move(caption), std::move(file));
  figure.zoom = zoom_numbers(chart);
  return figure;
}

}  // namespace drift::report
