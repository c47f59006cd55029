#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drift::report {

inline constexpr double canvas_edge = 14.0;   ///< [px] left empty on either side of a picture
inline constexpr double narrow_page = 540.0;  ///< [px] what a window of 600 has for a picture
inline constexpr double half_sheet =
    448.0;  ///< [px] of a panel, two of which fit side by side on paper
inline constexpr double least_plot = 90.0;  ///< [px] of an axis beside labels; else they go above

/// Sizes of type [px]: the smallest, on axes and beside bars, and that of labels. Pages do not
/// scale pictures down on a screen of 600 px or more, so that no text is smaller than this; how far
/// they do on a smaller one and on paper: page/style.hpp.
inline constexpr double small_type = 12.0, label_type = 12.5;
inline constexpr double label_line = 15.0;  ///< [px] from one line of a label to the next

/// How a line is drawn, beside its colour: curves must be told apart in print too.
enum class Stroke { solid, dashed, dotted };

/// Colours that people with any colour vision tell apart (Okabe and Ito 2008), repeated beyond 7.
std::string_view palette(std::size_t index);
/// Indices of those that mean something, whatever stands beside them.
inline constexpr std::size_t blue = 0, orange = 1, amber = 4, sky_blue = 5;

struct TextStyle {
  double size = label_type;           ///< [px]
  std::string_view anchor = "start";  ///< start, middle, end
  std::string_view colour = "#333333";
  bool bold = false;
  bool halo = false;    ///< white outline, to be read on top of curves
  double turned = 0.0;  ///< [deg]
};

/// Elements of an SVG picture, in pixels from the upper left corner. All text is escaped.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height, std::string_view title);

  void rectangle(double x, double y, double width, double height, std::string_view fill,
                 double opacity = 1.0);
  void line(double x1, double y1, double x2, double y2, std::string_view colour, double width,
            Stroke stroke = Stroke::solid);
  /// A curve through the points, broken where x or y is not finite; a lonely point is a dot.
  void curve(std::span<const double> x, std::span<const double> y, std::string_view colour,
             double width, Stroke stroke);
  /// The area between two curves, broken where one of them is not finite.
  void area(std::span<const double> x, std::span<const double> low, std::span<const double> high,
            std::string_view colour, double opacity);
  void text(double x, double y, std::string_view text, const TextStyle& style = {});
  /// Lines of labels under each other, centred at x or as near as they stay within `width`.
  void label(double x, double y, const std::vector<std::string>& lines, double width);

  /// What is drawn until pop() counts from (x, y) and is cut off outside the rectangle.
  void push_window(double x, double y, double width, double height);
  void pop_window();

  /// The whole document.
  std::string finish() &&;

 private:
  std::string out_;
};

/// Text in lines that are no wider, but for single words [px].
std::vector<std::string> lines_within(std::string_view text, double width, double size);

/// Width of text, about right for sans-serif type [px].
double text_pixels(std::string_view text, double size);

}  // namespace drift::report
