#pragma once

#include <concepts>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/report/page/table.hpp"
#include "core/base/results_folder.hpp"

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

/// An SVG document of this program, put into the page itself and into a file of its own.
struct Figure {
  std::string svg;
  std::string caption;
  std::string file = {};  ///< "estimates.svg"; empty: on the page alone
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

/// Without a title it goes on with the section before it.
struct Section {
  std::string title = {};
  Blocks blocks = {};
  On on = On::both;  ///< of all its blocks

  void add(Blocks more) { blocks.insert(blocks.end(), more.begin(), more.end()); }
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

  void add(std::vector<Section> more);  ///< those that say something
};

/// What functions, one for each section, say of a view.
template <class View, class List>
std::vector<Section> sections_of(const View& view, const List& list) {
  std::vector<Section> all;
  for (Section (*const make)(const View&) : list) all.push_back(make(view));
  return all;
}

/// Declares the sections of a view and lists them in the order of the report.
#define DRIFT_SECTIONS(View, list, ...)                   \
  std::type_identity_t<Section(const View&)> __VA_ARGS__; \
  inline constexpr Section (*list[])(const View&) = {__VA_ARGS__}

/// The report for a terminal.
std::string to_text(const Report& report, std::size_t width = 100);

/// Sections alone, a blank line between blocks.
std::string text_of(const std::vector<Section>& sections, std::size_t width = 100);

/// One HTML page that needs nothing else: no script, no address, fit for print. All text is
/// escaped.
std::string to_html(const Report& report);

/// Writes document, files, figures and report.html into a folder, made if need be. Returns the
/// names of the files. InputError (io) if one cannot be written.
std::vector<std::string> write_report(const Report& report, const std::string& folder);

}  // namespace drift::report
