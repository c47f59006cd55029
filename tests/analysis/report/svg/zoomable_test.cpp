// Figures that can be zoomed: their numbers, and the script of the page.
#include "analysis/report/svg/zoomable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/analysis/report/own_script.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::zoomable_test {
namespace {

using namespace report;

Chart chart() {
  Chart c{"Course </script><b>", {}, 1};
  Panel panel;
  panel.title = "x </script> & \"y\"";
  for (const std::size_t k : {0u, 1u}) {
    Series s;
    s.label = "start";
    s.colour = k;
    for (int i = 0; i < 9000; ++i) {
      s.x.push_back(0.01 * i);
      s.y.push_back(i == 77 ? std::nan("") : i == 4321 ? 7.25 : std::sin(0.001 * i));
      s.sigma.push_back(0.5);
    }
    panel.series.push_back(s);
  }
  panel.expected.push_back({"band", {0.0, 90.0}, {-1.0, -1.0}, {1.0, 1.0}});
  panel.marks = {30.0};
  c.panels.push_back(panel);
  return c;
}

TEST(Zoomable, NumbersAreThoseOfTheCurveThinnedWithItsExtremesAndGaps) {
  const std::string text = zoom_numbers(chart());
  EXPECT_EQ(text.find('<'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["title"], chart().panels[0].title);
  const auto& s = json[0]["series"][0];
  ASSERT_EQ(s["x"].size(), s["y"].size());
  ASSERT_EQ(s["sigma"].size(), s["y"].size());
  EXPECT_LE(s["y"].size(), 4000u);
  EXPECT_GT(s["y"].size(), 2000u);
  EXPECT_EQ(json[0]["series"][1]["x"], 0);  // that of the first
  int gaps = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < s["y"].size(); ++i) {
    if (s["y"][i].is_null()) {
      ++gaps;
      continue;
    }
    const double x = s["x"][i], y = s["y"][i];
    most = std::max(most, y);
    if (y < 7.0) {
      EXPECT_NEAR(y, std::sin(0.1 * x), 1e-4);
    }
  }
  EXPECT_EQ(gaps, 1);
  EXPECT_EQ(most, 7.25);
  EXPECT_EQ(json[0]["bands"][0]["high"][1], 1.0);
  EXPECT_EQ(json[0]["bands"][0]["colour"], fill_of(Shade::expected));
  EXPECT_EQ(json[0]["marks"][0], 30.0);
  EXPECT_TRUE(json[0]["range"].is_null());
}

TEST(Zoomable, PagesHoldTheScriptOnceAndLetNoOtherRun) {
  if (zoom_script().empty()) GTEST_SKIP() << "not compared: built without dygraphs";
  Report report{.command = "identify", .title = "t"};
  const Figure figure = zoomable(chart(), "c");
  report.add({{"One", {figure}}, {"Two", {figure}}});
  const std::string page = to_html(report);
  EXPECT_FALSE(test::xml_problem(page, {"meta"}));
  const auto script = page.find("<script>");
  ASSERT_NE(script, std::string::npos);
  EXPECT_EQ(page.find("<script>", script + 1), std::string::npos);
  EXPECT_GT(script, page.rfind("</svg>"));  // pictures come first, and stay without it
  const std::string rest = test::without_own_script(page);
  EXPECT_EQ(rest.find("<script"), std::string::npos);
  EXPECT_NE(rest.find("<svg"), std::string::npos);

  Report still{.command = "rank", .title = "t"};
  still.add({{"One", {Figure{figure.svg, "c"}}}});
  EXPECT_EQ(to_html(still).find("<script"), std::string::npos);
  EXPECT_EQ(to_html(still).find("script-src"), std::string::npos);
}

TEST(Zoomable, PolicyIsTheHashThatBrowsersCompute) {
  // echo -n "alert('Hello, world.');" | openssl dgst -sha256 -binary | base64: as in the CSP
  // standard
  EXPECT_EQ(policy_of("alert('Hello, world.');"),
            "sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=");
}

}  // namespace
}  // namespace drift::zoomable_test
