#include "analysis/report/svg/svg_chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/decimate.hpp"
#include "analysis/report/svg/dumbbell_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::svg_chart_test {
namespace {

const double nan_value = std::nan("");
const double inf = std::numeric_limits<double>::infinity();

report::Chart chart_of(std::vector<double> y) {
  report::Series s{.label = "start 1", .x = {}, .y = std::move(y), .sigma = {}};
  for (std::size_t i = 0; i < s.y.size(); ++i) s.x.push_back(static_cast<double>(i));
  report::Panel panel{.title = "a",
                      .x_label = "time [h]",
                      .y_label = "eta_x [arcsec]",
                      .expected = {},
                      .series = {s},
                      .references = {},
                      .y_range = {},
                      .note = {}};
  return {"title", {panel}};
}

std::size_t count(const std::string& text, std::string_view what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

/// The d attribute of the first curve.
std::string first_path(const std::string& svg) {
  const auto at = svg.find("<path d=\"");
  if (at == std::string::npos) return {};
  return svg.substr(at + 9, svg.find('"', at + 9) - at - 9);
}

TEST(SvgChart, IsWellFormedWithEveryKindOfContent) {
  report::Chart chart = chart_of({1.0, 3.0, 2.0});
  chart.panels[0].series[0].sigma = {0.5, 0.4, 0.3};
  chart.panels[0].expected.push_back({"95 % band", {0.0, 2.0}, {0.5, 0.6}, {1.5, 1.4}});
  chart.panels[0].references = {{2.0, "truth"}, {2.01, "component test", report::Stroke::dotted}};
  chart.panels.push_back({.title = "empty",
                          .x_label = "",
                          .y_label = "",
                          .expected = {},
                          .series = {},
                          .references = {},
                          .y_range = {},
                          .note = "not estimated"});
  chart.columns = 2;
  const std::string svg = report::svg_of(chart);
  EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
  for (const char* text :
       {"truth", "component test", "not estimated", "95 % band", "start 1", "time [h]"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(SvgChart, WhatIsLocatedHasAnotherColourThanWhatIsExpected) {
  EXPECT_NE(report::fill_of(report::Shade::located), report::fill_of(report::Shade::expected));
  report::Chart chart = chart_of({1.0, 3.0, 2.0});
  std::vector<report::ExpectedBand>& bands = chart.panels[0].expected;
  bands.push_back({"2 sigma", {0.0, 2.0}, {0.5, 0.6}, {1.5, 1.4}});
  bands.push_back({"located window", {0.5, 1.0}, {0.0, 0.0}, {3.0, 3.0}, report::Shade::located});
  const std::string svg = report::svg_of(chart);
  for (const report::ExpectedBand& b : bands)  // the area and its entry in the legend
    EXPECT_EQ(count(svg, std::string(report::fill_of(b.shade))), 2u) << b.label;
}

TEST(SvgChart, EscapesHostileText) {
  report::Chart chart = chart_of({1.0, 2.0});
  const std::string hostile = "<script>alert(\"1\")</script>' & \x01\xff]]>";
  chart.title = chart.panels[0].title = chart.panels[0].x_label = chart.panels[0].y_label = hostile;
  chart.panels[0].series[0].label = chart.panels[0].note = hostile;
  chart.panels[0].references = {{1.5, hostile}};
  const std::string svg = report::svg_of(chart);
  EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_EQ(svg.find('\x01'), std::string::npos);
  EXPECT_EQ(svg.find('\xff'), std::string::npos);
}

TEST(SvgChart, LeavesGapsWhereThereIsNoNumber) {
  const std::string svg = report::svg_of(chart_of({1.0, 2.0, nan_value, 3.0, inf, 4.0, 5.0, -inf}));
  EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  const std::string path = first_path(svg);
  EXPECT_EQ(count(path, "M"), 3u);      // {1, 2}, {3}, {4, 5}
  EXPECT_EQ(count(path, "h0.01"), 1u);  // the lonely 3
}

TEST(SvgChart, DrawsConstantsEmptySeriesAndHugeNumbers) {
  for (const auto& y : std::vector<std::vector<double>>{{},
                                                        {7.0},
                                                        {0.0, 0.0},
                                                        {1e6, 1e6 + 1e-9},
                                                        {nan_value, nan_value},
                                                        {-1e308, 1e308},
                                                        {1e-300, 2e-300},
                                                        {1e99, -1e99}}) {
    const std::string svg = report::svg_of(chart_of(y));
    EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_LT(svg.size(), 20000u);
  }
  EXPECT_EQ(test::xml_problem(report::svg_of(report::Chart{})).value_or(""), "");
}

TEST(SvgChart, ThinsLongCurves) {
  std::vector<double> y(200000);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::sin(0.01 * static_cast<double>(i));
  const std::string path = first_path(report::svg_of(chart_of(y)));
  const std::size_t points = count(path, "M") + count(path, "L");
  EXPECT_LE(points, 2000u);
  EXPECT_GE(points, 1000u);
}

TEST(Decimated, KeepsExtremesAndGaps) {
  std::vector<double> y(100000, 0.0);
  y[31234] = 9.0;
  y[31240] = -8.0;
  y[77777] = nan_value;
  const auto kept = report::decimated(y);
  EXPECT_LE(kept.size(), 2000u);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  for (const std::size_t i : {31234u, 31240u, 77777u})
    EXPECT_NE(std::ranges::find(kept, i), kept.end()) << i;
}

TEST(Decimated, KeepsShortCurvesWhole) {
  const std::vector<double> y{1.0, nan_value, 3.0};
  EXPECT_EQ(report::decimated(y), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(AxisScale, TicksAreRoundAndInRange) {
  const report::AxisScale s = report::make_scale({0.0, 6.3}, 6, 0.0);
  EXPECT_EQ(s.labels, (std::vector<std::string>{"0", "2", "4", "6"}));
  EXPECT_TRUE(s.factor.empty());
  const report::AxisScale fine = report::make_scale({-0.012, 0.031}, 5, 0.0);
  EXPECT_EQ(fine.labels, (std::vector<std::string>{"-0.01", "0.00", "0.01", "0.02", "0.03"}));
  const report::AxisScale large = report::make_scale({0.0, 4.1e7}, 5, 0.0);
  EXPECT_EQ(large.factor, "×10^7");
  EXPECT_EQ(large.labels.back(), "4");
}

TEST(AxisScale, LogarithmicTicksAreWhereTheirLabelsSay) {
  const auto ticks = [](double low, double high) {
    const report::AxisScale s = report::make_scale({std::log10(low), std::log10(high)}, 8, 0.0,
                                                   report::Spacing::logarithmic);
    EXPECT_EQ(s.ticks.size(), s.labels.size());
    for (std::size_t i = 0; i < s.ticks.size(); ++i)
      EXPECT_NEAR(std::stod(s.labels[i]), std::pow(10.0, s.ticks[i]), 1e-9 * high);
    return s.labels;
  };
  using Labels = std::vector<std::string>;
  EXPECT_EQ(ticks(0.85, 2.1), (Labels{"1", "1.2", "1.4", "1.6", "1.8", "2"}));
  EXPECT_EQ(ticks(1.0, 20.0), (Labels{"1", "2", "5", "10", "20"}));
  EXPECT_EQ(ticks(0.05, 200.0), (Labels{"0.1", "1", "10", "100"}));
  EXPECT_EQ(ticks(1e-9, 1e9), (Labels{"1e-05", "1", "100000"}));
}

TEST(AxisScale, ConstantStandsInTheMiddle) {
  for (const double c : {0.0, 5.0, -3e8})
    EXPECT_NEAR(report::make_scale({c, c}, 5, 0.05).at(c, 100.0), 50.0, 1e-6);
}

TEST(BarChart, HasABarAndWhiskersForEachNumber) {
  report::BarChart chart{
      .title = "learned <most>", .x_label = "posterior / prior", .bars = {}, .limit = {}};
  chart.bars = {{.label = "D_I_z", .value = 0.2, .low = 0.1, .high = 0.3},
                {.label = "eta_x", .value = -0.4},
                {.label = "K0 & co", .value = nan_value}};
  chart.limit = report::ReferenceLine{1.0, "prior"};
  const std::string svg = report::svg_of(chart);
  EXPECT_EQ(test::xml_problem(svg).value_or(""), "");
  EXPECT_EQ(count(svg, "<rect"), 3u);  // background and two bars
  EXPECT_NE(svg.find(">n/a<"), std::string::npos);
  EXPECT_NE(svg.find("K0 &amp; co"), std::string::npos);
}

/// All numbers that stand at `attribute="` in a document.
std::vector<double> numbers_at(const std::string& svg, const std::string& attribute) {
  std::vector<double> found;
  const std::string opening = attribute + "=\"";
  for (auto at = svg.find(opening); at != std::string::npos; at = svg.find(opening, at + 1))
    found.push_back(std::strtod(svg.c_str() + at + opening.size(), nullptr));
  return found;
}

TEST(BarChart, OfManyBarsIsNoHigherThanASheetOfPaperTakesAtAReadableSize) {
  for (const int bars : {20, 60, 80}) {
    report::BarChart chart{.title = "t", .x_label = "x", .bars = {}, .limit = {}};
    for (int k = 0; k < bars; ++k) chart.bars.push_back({.label = "D_I_z", .value = 1.0 + k});
    const std::string svg = svg_of(chart);
    EXPECT_LE(numbers_at(svg, "height").at(0), 1210.0) << bars;
    EXPECT_GE(numbers_at(svg, "height").at(0), 13.0 * bars) << "room for text of 12.5 px";
    const std::vector<double> heights = numbers_at(svg, " height");  // drawing, background, bars
    ASSERT_EQ(heights.size(), static_cast<std::size_t>(bars) + 2) << bars;
    EXPECT_GE(heights.back(), 9.0) << bars;
    if (bars == 20) EXPECT_EQ(heights.back(), 14.0);
  }
}

/// A picture that was drawn anew for a narrow page: it fits, and shows the same texts.
void expect_narrow(const report::Figure& figure, std::size_t texts) {
  EXPECT_EQ(test::xml_problem(figure.narrow).value_or(""), "");
  EXPECT_EQ(numbers_at(figure.narrow, "width").at(0), report::narrow_page);
  EXPECT_GT(numbers_at(figure.svg, "width").at(0), report::narrow_page);
  EXPECT_GE(count(figure.narrow, "<text"), texts);
  for (const char* attribute : {" x", "x1", "x2"})
    for (const double x : numbers_at(figure.narrow, attribute)) {
      EXPECT_GE(x, 0.0);
      EXPECT_LE(x, report::narrow_page);
    }
}

TEST(FigureOf, IsDrawnAnewForANarrowPageWithLongLabelsAboveTheirBars) {
  const std::string label = "eta_y:  the noise of the accelerometers in the free drift of it";
  report::BarChart bars{.title = "t", .x_label = "x", .bars = {}, .limit = {}, .width = 860.0};
  report::DumbbellChart dumbbells;
  for (int k = 1; k <= 4; ++k) {
    bars.bars.push_back({.label = label, .value = 1.0 * k, .text = "0.0123 to 0.00123"});
    dumbbells.lines.push_back(
        {.label = label, .before = 1.0 * k, .after = 2.0 * k, .text = "1.23 +- 0.12 arcsec"});
  }
  expect_narrow(report::figure_of(bars, ""), 8);
  expect_narrow(report::figure_of(dumbbells, ""), 8);
  report::HeatMap map;
  map.value = MatX::Ones(63, 63);
  for (int k = 0; k < 63; ++k) map.rows.push_back("theta_x_y");
  map.columns = map.rows;
  expect_narrow(report::figure_of(map, ""), 63);
  bars.width = 500.0;
  EXPECT_EQ(report::figure_of(bars, "").narrow, "") << "narrow already";
}

}  // namespace
}  // namespace drift::svg_chart_test
