#include "analysis/report/svg/svg_canvas.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/style.hpp"

namespace drift::report {
namespace {

constexpr std::array<std::string_view, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                  "#E69F00", "#56B4E9", "#4D4D4D"};

/// What the style of pages, which is below pictures, has behind a key: of a light page the first,
/// of a dark one the last.
constexpr std::string_view accent = "--accent: ";
static_assert(page_style.substr(page_style.find(accent) + accent.size(), 7) == colours[blue]);
static_assert(page_style.substr(page_style.rfind(accent) + accent.size(), 7) == colours[sky_blue]);

std::string_view dashes(Stroke stroke) {
  switch (stroke) {
    case Stroke::dashed:
      return " stroke-dasharray=\"6 3\"";
    case Stroke::dotted:
      return " stroke-dasharray=\"1.5 3\"";
    case Stroke::solid:
      break;
  }
  return "";
}

template <class... Args>
void append(std::string& out, fmt::format_string<Args...> text, Args&&... args) {
  fmt::format_to(std::back_inserter(out), text, std::forward<Args>(args)...);
}

}  // namespace

std::string_view palette(std::size_t index) {
  return colours[index % colours.size()];
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view title) {
  append(
      out_,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\">\n"
      "<title>{2}</title>\n",
      width, height, escaped(title));
  rectangle(0.0, 0.0, width, height, "#ffffff");
}

void SvgCanvas::rectangle(double x, double y, double width, double height, std::string_view fill,
                          double opacity) {
  append(out_,
         "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
         "fill-opacity=\"{:.2g}\"/>\n",
         x, y, std::max(width, 0.0), std::max(height, 0.0), fill, opacity);
}

void SvgCanvas::line(double x1, double y1, double x2, double y2, std::string_view colour,
                     double width, Stroke stroke) {
  append(out_,
         "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
         "stroke-width=\"{:.2g}\"{}/>\n",
         x1, y1, x2, y2, colour, width, dashes(stroke));
}

void SvgCanvas::curve(std::span<const double> x, std::span<const double> y, std::string_view colour,
                      double width, Stroke stroke) {
  std::string path;
  std::size_t run = 0;  // points since the last gap
  const auto end_run = [&] {
    if (run == 1) path += "h0.01";
    run = 0;
  };
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      end_run();
      continue;
    }
    append(path, "{}{:.1f} {:.1f}", run == 0 ? 'M' : 'L', x[i], y[i]);
    ++run;
  }
  end_run();
  if (path.empty()) return;
  append(
      out_,
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2g}\" stroke-linecap=\"round\" "
      "stroke-linejoin=\"round\"{}/>\n",
      path, colour, width, dashes(stroke));
}

void SvgCanvas::area(std::span<const double> x, std::span<const double> low,
                     std::span<const double> high, std::string_view colour, double opacity) {
  std::string path;
  const auto shown = [&](std::size_t i) {
    return std::isfinite(x[i]) && std::isfinite(low[i]) && std::isfinite(high[i]);
  };
  for (std::size_t begin = 0; begin < x.size();) {
    std::size_t end = begin;
    while (end < x.size() && shown(end)) ++end;
    if (end > begin + 1) {
      for (std::size_t i = begin; i < end; ++i)
        append(path, "{}{:.1f} {:.1f}", i == begin ? 'M' : 'L', x[i], high[i]);
      for (std::size_t i = end; i-- > begin;) append(path, "L{:.1f} {:.1f}", x[i], low[i]);
      path += 'Z';
    }
    begin = end + 1;
  }
  if (!path.empty())
    append(out_, "<path d=\"{}\" fill=\"{}\" fill-opacity=\"{:.2g}\"/>\n", path, colour, opacity);
}

void SvgCanvas::text(double x, double y, std::string_view text, const TextStyle& style) {
  append(out_,
         "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.3g}\" text-anchor=\"{}\" fill=\"{}\"", x,
         y, style.size, style.anchor, style.colour);
  if (style.bold) out_ += " font-weight=\"bold\"";
  if (style.halo)
    out_ +=
        " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  if (style.turned != 0.0)
    append(out_, " transform=\"rotate({:.3g} {:.1f} {:.1f})\"", style.turned, x, y);
  out_ += '>' + escaped(text) + "</text>\n";
}

void SvgCanvas::push_window(double x, double y, double width, double height) {
  // A nested <svg> clips without an id, which could clash where a page holds several pictures.
  append(out_,
         "<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" overflow=\"hidden\">\n",
         x, y, width, height);
}

void SvgCanvas::pop_window() {
  out_ += "</svg>\n";
}

std::string SvgCanvas::finish() && {
  return std::move(out_) + "</svg>\n";
}

std::vector<std::string> lines_within(std::string_view text, double width, double size) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    std::string& line = lines.back();
    if (line.empty())
      line = word;
    else if (text_pixels(line + " " + std::string(word), size) <= width)
      line.append(" ").append(word);
    else
      lines.emplace_back(word);
    at = end + 1;
  }
  return lines;
}

void SvgCanvas::label(double x, double y, const std::vector<std::string>& lines, double width) {
  for (const std::string& line : lines) {
    const double half = 0.5 * text_pixels(line, label_type) + canvas_edge;
    text(std::max(std::min(x, width - half), half), y, line, {.anchor = "middle"});
    y += label_line;
  }
}

double text_pixels(std::string_view text, double size) {
  return 0.56 * size * static_cast<double>(display_width(text));
}

}  // namespace drift::report
