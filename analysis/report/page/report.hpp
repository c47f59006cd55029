#pragma once

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/tuple/elem.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <concepts>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/report/page/provenance.hpp"
#include "analysis/report/page/table.hpp"
#include "core/base/results/new_results.hpp"
#include "core/base/weighed_texts.hpp"

namespace drift::report {

struct Paragraph {
  std::string text;
};

/// A list of sentences; on a terminal each after a mark.
struct Sentences {
  std::vector<std::string> items;
  std::string mark = "- ";
};

/// Lines kept as they are, in fixed width.
struct Preformatted {
  std::string text;
};

/// A picture in panels, each an SVG document: on a page as many stand side by side as there is room
/// for, at most `columns`.
struct FlowingPanels {
  std::string head;  ///< title and legend
  std::vector<std::string> panels;
  std::size_t columns = 1;
  double panel_width = 0.0, head_width = 0.0;  ///< [px]
};

/// An SVG document of this program, put into the page itself and into a file of its own.
struct Figure {
  std::string svg;
  std::string caption;
  std::string file = {};  ///< "estimates.svg"; empty: on the page alone
  std::string zoom = {};  ///< numbers to zoom it by (svg/zoomable.hpp); empty: it stays as it is
  FlowingPanels flowing = {};  ///< the picture on the page, instead of svg; without panels: svg
  std::string narrow = {};     ///< instead of both in a narrow window; empty: as in any
};

/// Where a block stands. A figure with a file name is always a file too.
enum class On { both, page, terminal, neither };

/// What a section is made of. Text of any kind may come from users: renderers escape it.
using Content = std::variant<Paragraph, Sentences, Preformatted, Table, Figure>;
struct Block {
  Content content;
  On on = On::both;

  template <std::convertible_to<Content> T>
  Block(T content_, On on_ = On::both)  // NOLINT: a block is what it holds
      : content(std::move(content_)), on(on_) {}
};
using Blocks = std::vector<Block>;

/// Whether what stands at `on` is seen on the page, or on the terminal.
inline bool seen(On on, On where) {
  return on == On::both || on == where;
}

/// The parts of a page, in their order below the answer. Details and provenance are folded.
enum class Part { evidence, how_sure, details, provenance };

/// Without a title it goes on with the section before it.
struct Section {
  std::string title = {};
  Blocks blocks = {};
  On on = On::both;  ///< of all its blocks
  Part part = Part::evidence;
  std::string filter = {};  ///< the one of several that it is about: first column of its CSV files

  void add(Blocks more) { blocks.insert(blocks.end(), more.begin(), more.end()); }
};

/// The answer for a reader who reads nothing else.
struct InBrief {
  std::string verdict = {};  ///< one sentence, its judgement before a colon
  Tone tone = Tone::plain;   ///< good: model and data agree; bad: they do not, or nobody can tell
  WeighedTexts more = {};    ///< what belongs to it
  std::size_t asked = 0;     ///< so many of them, the first, were asked for: they have room first
  std::string next = {};     ///< what to do
  std::string kept = {};     ///< a sentence of the verdict that is shown whatever has no room
};

/// On a terminal, whose last lines are read first, headlines may come last.
enum class Order { headlines_first, headlines_last };

/// Everything a command has to say: for a terminal, as a page and as files.
struct Report {
  std::string command;  ///< that says it, "rank"
  std::string title = {}, subtitle = {};
  std::vector<std::string> headlines = {};  ///< what a reader must not miss
  std::vector<Section> sections = {};
  std::string footer = {};           ///< below the page, after the command
  TextFile document = {};            ///< what machines read: "rank.json" and its text
  std::vector<TextFile> files = {};  ///< beside document, figures and page
  Order order = Order::headlines_first;
  InBrief brief = {};
  Provenance provenance = {};  ///< of with_provenance()

  void add(std::vector<Section> more);  ///< those that say something
};

/// A section as a list has it: the function that says it, and its part of the page.
template <class View>
struct ListedSection {
  Section (*make)(const View&);
  Part part;
};

/// What the functions of a list say of a view, of one of several filters by its name.
template <class View, std::size_t n>
std::vector<Section> sections_of(const View& view, const ListedSection<View> (&list)[n],
                                 const std::string& filter = {}) {
  std::vector<Section> all;
  for (const ListedSection<View>& s : list) {
    all.push_back(s.make(view));
    all.back().part = s.part;
    all.back().filter = filter;
  }
  return all;
}

/// Declares the sections of a view and lists them in the order of the report, each with its part of
/// the page: DRIFT_SECTIONS(View, list, (verdict, evidence), (odds, how_sure)). A new one is its
/// file and a pair.
#define DRIFT_SECTIONS(View, list, ...)                                                      \
  BOOST_PP_SEQ_FOR_EACH(DRIFT_DECLARED_SECTION, View, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)) \
  inline constexpr ListedSection<View> list[] = {                                            \
      BOOST_PP_SEQ_FOR_EACH(DRIFT_LISTED_SECTION, View, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))}
#define DRIFT_DECLARED_SECTION(r, View, pair) Section BOOST_PP_TUPLE_ELEM(0, pair)(const View&);
#define DRIFT_LISTED_SECTION(r, View, pair) \
  {BOOST_PP_TUPLE_ELEM(0, pair), Part::BOOST_PP_TUPLE_ELEM(1, pair)},

/// The lines that a terminal shows of an answer unless it is asked for more.
inline constexpr std::size_t most_brief_lines = 10, least_brief_width = 80;

/// The answer in at most most_brief_lines lines: the verdict, what to do, and between them as much
/// as there is room for. How many sentences have none is said before what to do, "(2 more
/// sentences:
/// --full)"; a sentence that is cut ends with "...".
std::string brief_text(const InBrief& brief, std::size_t width = least_brief_width);

/// The answer with all its sentences, in as many lines as they take: that of --full.
std::string whole_text(const InBrief& brief, std::size_t width = least_brief_width);

/// The report for a terminal.
std::string to_text(const Report& report, std::size_t width = 100);

/// Sections alone, a blank line between blocks.
std::string text_of(const std::vector<Section>& sections, std::size_t width = 100);

/// One HTML page that needs nothing else: no address, fit for print, no script but the one that
/// zooms its time series, which is in it once. All text is escaped.
std::string to_html(const Report& report);

/// Every table that has an id as a file, "odds.csv"; those of several filters are one file, whose
/// first column names the filter. Tables of one id have the same columns.
std::vector<TextFile> csv_files(const std::vector<Section>& sections);

/// Adds document, files, tables, figures and report.html. InputError (io) if one cannot be written.
void add_report(NewResults& results, const Report& report);

/// Writes them into a folder, made if need be, all or none. Returns the names of the files.
/// InputError (io) if one cannot be written.
std::vector<std::string> write_report(const Report& report, const std::string& folder);

}  // namespace drift::report
