#include "analysis/report/page/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/json.hpp"
#include "core/base/number_text.hpp"
#include "core/stats/chi_square_band.hpp"
#include "tests/analysis/report/xml_check.hpp"

namespace drift::table_test {
namespace {

const std::set<std::string> void_tags{"meta"};

TEST(NumberText, SigmaHasOneOrTwoDigitsAndTheValueAsManyDecimals) {
  EXPECT_EQ(with_sigma(1.5104, 0.0302), "1.510±0.030");
  EXPECT_EQ(with_sigma(1.5104, 0.0502), "1.51±0.05");
  EXPECT_EQ(with_sigma(0.39779, 0.00097), "0.3978±0.0010");
  EXPECT_EQ(to_match(1.96484, 0.001), "1.9648");
  EXPECT_EQ(as_given(-1.2, 0.03), "-1.20±0.03");
  EXPECT_EQ(as_given(-157.02, 16.4), "-157.02±16.40");
  EXPECT_EQ(with_sigma(268.15, 14.98), "268±15");
  EXPECT_EQ(with_sigma(-0.0001, 0.15), "0.00±0.15");
  EXPECT_EQ(with_sigma(12345.6, 1234.0), "12346±1234");
  EXPECT_EQ(with_sigma(1.0, std::nan("")), "1");
  EXPECT_EQ(with_sigma(std::nan(""), 1.0), "-");
  EXPECT_EQ(number_text(HUGE_VAL), "-");
  EXPECT_EQ(number_text(1000.0), "1000");
  EXPECT_EQ(number_text(999.6), "1000");
  EXPECT_EQ(number_text(-12345.6, 2), "-12346");
  EXPECT_EQ(number_text(2.5e6), "2.5e+06");
  EXPECT_EQ(number_text(12.34), "12.3");
}

TEST(Escaped, KeepsTextAndNeutralisesTheRest) {
  EXPECT_EQ(report::escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(report::escaped("±°é漢😀"), "±°é漢😀");
  EXPECT_EQ(report::escaped("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // overlong '/'
  EXPECT_EQ(report::escaped(std::string_view("a\0b", 3)),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(report::escaped("\xE2\x82"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // cut short
}

TEST(FileNamePart, StaysInItsFolder) {
  EXPECT_EQ(report::file_name_part("eq5"), "eq5");
  EXPECT_EQ(report::file_name_part("../../etc/passwd"), "_._.._etc_passwd");
  EXPECT_EQ(report::file_name_part(""), "_");
  EXPECT_EQ(report::file_name_part(std::string_view("a/b\nc\0d", 7)), "a_b_c_d");
  EXPECT_LE(report::file_name_part(std::string(4096, 'x')).size(), 64u);
}

TEST(ChiSquareBand, AgreesWithTables) {
  // Percentage points of chi-square: 6 degrees 1.237, 14.449; 100 degrees 74.222, 129.561.
  EXPECT_NEAR(stats::chi_square_band(6).low, 1.237 / 6, 0.01);
  EXPECT_NEAR(stats::chi_square_band(6).high, 14.449 / 6, 0.01);
  EXPECT_NEAR(stats::chi_square_band(100).low, 0.74222, 1e-4);
  EXPECT_NEAR(stats::chi_square_band(100).high, 1.29561, 1e-4);
  EXPECT_NEAR(stats::chi_square_band(1).high, 5.024, 0.1);
  EXPECT_GE(stats::chi_square_band(1).low, 0.0);
}

report::Table sample() {
  report::Table t("A <table>", "<name | value", "a note");
  t.add_heading("group & co");
  t.add({"x", report::Cell("1.0±0.1", report::Tone::good)});
  t.add({"longer", report::Cell("10", report::Tone::bad)});
  return t;
}

TEST(Table, TextColumnsLineUp) {
  EXPECT_EQ(text_of(sample()),
            "A <table>\n"
            "name      value\n"
            "---------------\n"
            "group & co\n"
            "x       1.0±0.1\n"
            "longer       10\n"
            "a note\n");
}

TEST(Table, AnIntervalThatIsNotKnownIsADash) {
  const double none = std::nan("");
  EXPECT_EQ(report::span_cell(0.5, 2.0).text, "0.5 to 2");
  EXPECT_EQ(report::span_cell(0.5, none).text, "0.5 to -");
  EXPECT_EQ(report::span_cell(none, none).text, "-");
}

TEST(Table, HtmlIsWellFormedAndEscaped) {
  const std::string html = report::html_of(sample());
  EXPECT_EQ(test::xml_problem("<p>" + html + "</p>").value_or(""), "");
  EXPECT_NE(html.find("A &lt;table&gt;"), std::string::npos);
  EXPECT_NE(html.find("class=\"right bad\">10<"), std::string::npos);
  EXPECT_NE(html.find("colspan=\"2\""), std::string::npos);
}

TEST(Wrapped, LinesStayWithinTheWidth) {
  std::istringstream lines(
      report::wrapped(std::string("aaa bbb ") + std::string(30, 'x') + " cc dd", 10, 2));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  EXPECT_EQ(all, (std::vector<std::string>{"aaa bbb", "  " + std::string(30, 'x'), "  cc dd"}));
}

/// A name in the quotes of a shell stays one word, with every blank that is in it.
TEST(Wrapped, NamesInQuotesAreNotTakenApart) {
  EXPECT_EQ(report::wrapped("rank 'my  own study.toml' now", 12, 2),
            "rank\n  'my  own study.toml'\n  now\n");
  EXPECT_EQ(report::wrapped("rank 'it'\\''s mine' now", 12, 2), "rank\n  'it'\\''s mine'\n  now\n");
  EXPECT_EQ(report::wrapped("the others' parts 'and no end", 12, 2),
            "the others'\n  parts 'and\n  no end\n");
}

TEST(Report, IsOnePageWithoutScriptsAndAddresses) {
  report::Report report{.command = "<b>",
                        .title = "<script>alert(1)</script>",
                        .subtitle = "\"quoted\" & 'single'",
                        .headlines = {"</ul><img src=x onerror=alert(1)>"},
                        .footer = "<b>"};
  report.sections.push_back(
      {"one <i>",
       {report::Paragraph{"<script>"}, report::Sentences{{"a", "<b"}},
        report::Preformatted{"x < y"}, sample(),
        report::Figure{"<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>", "cap <tion>"}}});
  const std::string html = report::to_html(report);
  EXPECT_EQ(test::xml_problem(html, void_tags).value_or(""), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(html.find("@media print"), std::string::npos);
}

TEST(XmlCheck, FindsWhatIsBroken) {
  for (const char* bad :
       {"<a><b></a></b>", "<a>", "<a b=\"1\" b=\"2\"></a>", "<a>&</a>", "<a b=c></a>", "x"})
    EXPECT_TRUE(test::xml_problem(bad).has_value()) << bad;
  EXPECT_FALSE(test::xml_problem("<a b=\"1\"><c/>t &amp; u</a>").has_value());
}

}  // namespace
}  // namespace drift::table_test
