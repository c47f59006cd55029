#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/report/page/table.hpp"

namespace drift::report {

/// A paragraph; escaped.
struct Paragraph {
  std::string text;
};

/// A list of sentences; escaped.
struct Sentences {
  std::vector<std::string> items;
};

/// Lines kept as they are, in fixed width; escaped.
struct Preformatted {
  std::string text;
};

/// An SVG document of this program, put into the page itself.
struct Picture {
  std::string svg;
  std::string caption;
};

using Block = std::variant<Paragraph, Sentences, Preformatted, Table, Picture>;

struct Section {
  std::string heading;
  std::vector<Block> blocks;
};

/// A report of any command.
struct HtmlReport {
  std::string title;
  std::string subtitle;
  std::vector<std::string> headlines;  ///< what a reader must not miss; at the top
  std::vector<Section> sections;
  std::string footer;
};

/// One HTML page that needs nothing else: no script, no address, fit for print. All text is
/// escaped.
std::string to_html(const HtmlReport& report);

}  // namespace drift::report
