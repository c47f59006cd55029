// One description, from which the terminal, the page, JSON and CSV are made.
#include "analysis/report/page/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/style.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "tests/support/program.hpp"

namespace drift::report::report_test {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A column for all, one for people, one for machines.
Table sizes() {
  Table t("Sizes", "name=<name | size=size [m] | <remark | exact=");
  t.add({"a", 1.23456, {"good", Tone::good}, only_value(true)});
  t.add_heading("those without a size");
  t.add({"b, c", std::nan(""), "", only_value({})});
  return t;
}

TEST(OneTable, ShowsPeopleWhatHasAHeading) {
  EXPECT_EQ(text_of(sizes()),
            "Sizes\n"
            "name  size [m]  remark\n"
            "----------------------\n"
            "a         1.23  good\n"
            "those without a size\n"
            "b, c         -\n");
  const std::string html = html_of(sizes());
  EXPECT_TRUE(holds(html, "<td class=\"right\">1.23</td><td class=\"left good\">good</td></tr>"));
  EXPECT_FALSE(holds(html, "exact"));
}

TEST(OneTable, GivesMachinesNumbersUnderTheirKeys) {
  EXPECT_EQ(
      rows_json(sizes()).dump(),
      R"([{"name":"a","size":1.23456,"exact":true},{"name":"b, c","size":null,"exact":null}])");
  EXPECT_EQ(rows_json(sizes(), "exact name").dump(),
            R"([{"exact":true,"name":"a"},{"exact":null,"name":"b, c"}])");
  EXPECT_EQ(csv_of(sizes()), "name,size,exact\na,1.23456,1\n\"b, c\",,\n");
}

TEST(OneTable, HeadingsMayHoldAnEqualsSign) {
  const Table t("", "n=count >= 8 | effects >= 8 sigma");
  EXPECT_EQ(t.columns[0].key, "n");
  EXPECT_EQ(t.columns[0].heading, "count >= 8");
  EXPECT_EQ(t.columns[1].key, "");
  EXPECT_EQ(t.columns[1].heading, "effects >= 8 sigma");
}

TEST(OneTable, IsShortenedForPeopleAlone) {
  Table t("", "n=n");
  for (int k = 0; k < 6; ++k) t.add({k});
  t.rows[4].always = true;
  t.limit = {2, 3, "all.json"};
  EXPECT_EQ(text_of(t), "n\n-\n0\n1\n4\n3 weaker ones are in all.json.\n");
  EXPECT_TRUE(holds(html_of(t), "2 weaker ones are in all.json."));
  EXPECT_EQ(rows_json(t).size(), 6u);
}

TEST(OneTable, WrapsALastColumnOfWordsThatDoesNotFit) {
  Table t("", "number | <why");
  t.add({1, "because of this and of that and of yet another thing that takes many words"});
  std::istringstream lines(text_of(t, 40));
  std::string all;
  for (std::string line; std::getline(lines, line); all += line + "\n")
    EXPECT_LE(display_width(line), 40u) << line;
  EXPECT_TRUE(holds(all, "     1 because of this"));
  EXPECT_TRUE(holds(all, "\n       ")) << "continued below the words:\n" << all;
}

TEST(OneTable, LiesSidewaysOnPaperWithItsNoteOnlyWhereItsTextsNeedIt) {
  Table upright("Many columns", "a | b | c | d | e | f | g | h | <i | j of three words", "A note."),
      wide("Wide ones", "a | b | c | d | e | f", "Another.");
  upright.add(
      {"eq5", "eq5", 100, "0.9961", "1.006", "95.4", "99.0", "0.0", "eta_z", "0.0 % (0.0)"});
  wide.add(std::vector<Cell>(6, "0.0123 to 0.0345 arcsec"));
  EXPECT_TRUE(html_of(upright).starts_with("<div class=\"scroll\"><table>\n<caption>"));
  EXPECT_TRUE(html_of(wide).starts_with("<div class=\"wide\"><div class=\"scroll\"><table>\n"));
  EXPECT_TRUE(html_of(wide).ends_with("</div>\n<p class=\"note\">Another.</p>\n</div>\n"));
  // Sentences are broken, and take what others leave.
  upright.rows[0].cells[8] = "with it, others stay significant, and it would be 14 times its size";
  EXPECT_TRUE(html_of(upright).starts_with("<div class=\"scroll\"><table>\n"));
  EXPECT_TRUE(holds(html_of(upright), "<td class=\"left remark\">with it, others"));
  EXPECT_FALSE(holds(html_of(upright), "<td class=\"right remark\">"));
}

/// What the style multiplies the width of drawings by, from `place` on.
double scale_after(std::string_view place) {
  const std::string style(page_style);
  constexpr std::string_view factor = "calc(var(--drawn) * ";
  const auto at = style.find(factor, style.find(place));
  return at == std::string::npos ? 0.0 : std::strtod(style.c_str() + at + factor.size(), nullptr);
}

TEST(PageStyle, ScalesNoTextOfAFigureBelowWhatCanBeRead) {
  constexpr double sheet = 186.0 / 25.4 * 96.0, points = 72.0 / 96.0;  // [px], pt of a px
  const double printed = scale_after("@media print");
  EXPECT_GE(small_type * printed * points, 7.0);
  EXPECT_LE(2.0 * half_sheet * printed, sheet) << "two panels beside each other";
  EXPECT_LE(860.0 * printed, sheet) << "the widest drawings";
  EXPECT_GE(small_type * scale_after("@media screen and (max-width: 588px)"), 8.0);
}

TEST(PageStyle, IsToldHowWideADrawingIs) {
  const auto page_with = [](const char* svg) {
    Report report;
    report.add({{"One", {Figure{svg, "drawn"}}}});
    return to_html(report);
  };
  EXPECT_TRUE(
      holds(page_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 860 268\"></svg>"),
            "<svg style=\"--drawn: 860\" viewBox=\"0 0 860 268\"></svg>"));
  EXPECT_TRUE(holds(page_with("<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>"), "<svg></svg>"));
}

Report two_sections() {
  Report report{.command = "test", .title = "title", .subtitle = "subtitle", .headlines = {"said"}};
  Table table = sizes();
  table.id = "sizes";
  report.add(
      {{"One", {table, {Paragraph{"page words"}, On::page}, Figure{"<svg/>", "drawn", "a.svg"}}},
       {"Nothing", {}},
       {"Terminal", {{Sentences{{"spoken"}, "! "}, On::terminal}}},
       {"", {{Figure{"<svg/>", "unseen", "b.svg"}, On::neither}}}});
  report.document = {"doc.json", "{}\n"};
  report.files = {{"more.toml", "x = 1\n"}};
  return report;
}

TEST(OneReport, ShowsEachBlockWhereItBelongs) {
  const std::string text = to_text(two_sections()), html = to_html(two_sections());
  EXPECT_TRUE(text.starts_with("title\nsubtitle\n\n- said\n\nSizes\n")) << text;
  EXPECT_TRUE(text.ends_with("\n\n! spoken\n")) << text;
  EXPECT_FALSE(holds(text, "page words"));
  EXPECT_TRUE(holds(html, "<h2>Evidence</h2>\n<h3>One</h3>"));
  for (const char* part : {"page words", "drawn", "<li>said</li>", "driftscope test"})
    EXPECT_TRUE(holds(html, part)) << part;
  for (const char* part : {">Nothing<", ">Terminal<", "spoken", "unseen"})
    EXPECT_FALSE(holds(html, part)) << part;
  Report late = two_sections();
  late.order = Order::headlines_last;
  EXPECT_TRUE(to_text(late).ends_with("! spoken\n\n- said\n"));
}

TEST(OneReport, HasTheSamePartsWhateverTheCommand) {
  Report report = two_sections();
  report.brief.verdict = "Verdict: so <it> is.";
  report.brief.tone = Tone::bad;
  report.brief.more.add(Weight::note, "because");
  report.brief.next = "Next: that.";
  report.add({{"Late", {Paragraph{"known how well"}}, On::both, Part::how_sure},
              {"Long", {Paragraph{"all of it"}}, On::both, Part::details}});
  const Provenance made{"1.2",
                        "abcdef",
                        "2026-01-02T03:04:05Z",
                        "driftscope test",
                        {{"s.toml", std::string(64, 'a')}},
                        {{"r.csv", std::string(64, 'b')}}};
  report = with_provenance(std::move(report), made);
  const std::string html = to_html(report);
  std::size_t at = 0;
  for (const char* part :
       {"class=\"answer bad\"", "so &lt;it&gt; is.", "<li>because</li>", "Next: that.",
        "driftscope 1.2 (abcdef)", "<h2>Evidence</h2>", "<h2>How sure</h2>", "<li>said</li>",
        "known how well", "<h2>Details</h2>", "<details>\n<summary>Long</summary>",
        "<h2>Provenance</h2>", "driftscope test", "s.toml, SHA-256 aaaa", "r.csv, SHA-256 bbbb"}) {
    const auto next = html.find(part, at);
    ASSERT_NE(next, std::string::npos) << part << " is absent, or not in its place";
    at = next;
  }
  const Json json = Json::parse(report.document.second).at("provenance");
  EXPECT_EQ(json.at("version"), "1.2");
  EXPECT_EQ(json.at("command_line"), "driftscope test");
  EXPECT_EQ(json.at("study").at("sha256"), std::string(64, 'a'));
  EXPECT_EQ(json.at("recordings").at(0).at("path"), "r.csv");
}

TEST(OneReport, LongTablesAreFoldedInPlace) {
  Report report = two_sections();
  Table table("Many", "n=n");
  for (int k = 0; k < 40; ++k) table.add({k});
  report.add({{"Numbers", {table}}});
  EXPECT_TRUE(holds(to_html(report), "<details>\n<summary>Many (40 rows)</summary>"));
}

TEST(OneReport, WritesDocumentFilesFiguresAndPage) {
  const test::ScratchFolder folder;
  EXPECT_EQ(write_report(two_sections(), folder.file("out")),
            (std::vector<std::string>{"doc.json", "more.toml", "sizes.csv", "a.svg", "b.svg",
                                      "report.html"}));
  EXPECT_EQ(test::text_of(folder.file("out/doc.json")), "{}\n");
  EXPECT_EQ(test::text_of(folder.file("out/report.html")), to_html(two_sections()));
}

TEST(OneReport, NamedTablesAreFilesWithTheFilterAsAColumn) {
  Table table("Counts", "what=<what | n=n");
  table.id = "counts";
  table.add_heading("a heading is no row");
  table.add({"seen", 3});
  const Section of_none{"", {table}};
  Section one{"", {{table, On::page}, {table, On::terminal}}}, other{"", {table}};
  one.filter = "legacy, old";
  other.filter = "corrected";
  const auto alone = csv_files({of_none}), several = csv_files({one, other});
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0], (TextFile{"counts.csv", "what,n\nseen,3\n"}));
  ASSERT_EQ(several.size(), 1u);
  EXPECT_EQ(several[0].second, "filter,what,n\n\"legacy, old\",seen,3\ncorrected,seen,3\n");
  table.id.clear();
  EXPECT_TRUE(csv_files({{"", {table}}}).empty());
}

TEST(OneReport, NamedTablesReachADocumentThatDoesNotHoldThem) {
  Json document{{"schema", 1}};
  add_tables(document, two_sections().sections);
  EXPECT_EQ(document["sizes"].dump(), rows_json(sizes()).dump());  // null is NaN: unequal to itself
  document = {{"sizes", "fixed by the interface"}};
  add_tables(document, two_sections().sections);
  EXPECT_EQ(document["sizes"], "fixed by the interface");
}

}  // namespace
}  // namespace drift::report::report_test
