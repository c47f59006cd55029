#include <fmt/format.h>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {
namespace {

constexpr std::string_view style = R"css(
:root { color-scheme: light; }
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #222; background: #fff;
       margin: 0 auto; padding: 1.5rem; max-width: 1180px; }
h1 { font-size: 1.6rem; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; border-bottom: 1px solid #ccc;
     overflow-wrap: anywhere; }
.subtitle, .note, figcaption, footer { color: #555; font-size: .9rem; }
.headlines { background: #f3f6fa; border-left: 4px solid #0072B2; padding: .6rem 1rem .6rem 2rem; }
nav ul { columns: 2; padding-left: 1.2rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; margin: .8rem 0 .3rem;
        font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: bold; padding-bottom: .3rem; }
th, td { padding: .16rem .65rem; white-space: nowrap; }
thead th { border-bottom: 2px solid #888; }
tbody tr:nth-child(even) { background: #f7f7f7; }
tbody th { font-weight: normal; font-style: italic; color: #444; background: #e9eef4;
           white-space: normal; }
.left { text-align: left; } .right { text-align: right; } td.left { white-space: normal; }
.good { color: #00664d; } .doubtful { color: #8a5a00; } .bad { color: #b03000; font-weight: bold; }
figure { margin: 1rem 0; } figure svg { max-width: 100%; height: auto; }
pre { font-size: .82rem; overflow-x: auto; background: #f7f7f7; padding: .8rem; }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; } nav { display: none; }
  figure, tr { break-inside: avoid; } h2 { break-after: avoid; } .scroll { overflow: visible; }
  thead { display: table-header-group; }
}
)css";

/// Inside HTML an <svg> needs no namespace, and the page shall hold no address at all.
std::string inlined(std::string svg) {
  constexpr std::string_view name_space = " xmlns=\"http://www.w3.org/2000/svg\"";
  for (auto at = svg.find(name_space); at != std::string::npos; at = svg.find(name_space))
    svg.erase(at, name_space.size());
  return svg;
}

std::string list_of(const std::vector<std::string>& items, std::string_view css_class) {
  if (items.empty()) return "";
  std::string out = fmt::format("<ul class=\"{}\">\n", css_class);
  for (const auto& item : items) out += "<li>" + escaped(item) + "</li>\n";
  return out + "</ul>\n";
}

std::string_view tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return " good";
    case Tone::doubtful:
      return " doubtful";
    case Tone::bad:
      return " bad";
    case Tone::plain:
      break;
  }
  return "";
}

struct BlockHtml {
  std::string operator()(const Paragraph& p) const { return "<p>" + escaped(p.text) + "</p>\n"; }
  std::string operator()(const Sentences& s) const { return list_of(s.items, "sentences"); }
  std::string operator()(const Preformatted& p) const {
    return "<pre>" + escaped(p.text) + "</pre>\n";
  }
  std::string operator()(const Table& t) const { return html_of(t); }
  std::string operator()(const Figure& f) const {
    return "<figure>\n" + inlined(f.svg) + "<figcaption>" + escaped(f.caption) +
           "</figcaption>\n</figure>\n";
  }
};

/// What stands on the page of a section.
std::string body_of(const Section& section) {
  std::string out;
  for (const Block& block : section.blocks)
    if (seen(section.on, On::page) && seen(block.on, On::page))
      out += std::visit(BlockHtml{}, block.content);
  return out;
}

}  // namespace

std::string html_of(const Table& whole) {
  const Table table = shown(whole, whole.limit.page);
  const auto side = [&](std::size_t c) { return table.columns[c].left ? "left" : "right"; };
  std::string out = "<div class=\"scroll\"><table>\n";
  if (!table.title.empty()) out += "<caption>" + escaped(table.title) + "</caption>\n";
  out += "<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", side(c),
                       escaped(table.columns[c].heading));
  out += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : table.rows) {
    out += "<tr>";
    if (row.heading)
      out += fmt::format("<th colspan=\"{}\" class=\"left\">{}</th>", table.columns.size(),
                         escaped(row.cells.front().text));
    else
      for (std::size_t c = 0; c < row.cells.size(); ++c)
        out += fmt::format("<td class=\"{}{}\">{}</td>", side(c), tone_class(row.cells[c].tone),
                           escaped(row.cells[c].text));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  if (!table.note.empty()) out += "<p class=\"note\">" + escaped(table.note) + "</p>\n";
  return out;
}

std::string to_html(const Report& report) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<header><h1>{0}</h1>\n"
      "<p class=\"subtitle\">{2}</p></header>\n",
      escaped(report.title), style, escaped(report.subtitle));
  out += list_of(report.headlines, "headlines");
  std::string nav, main;
  std::size_t titled = 0;
  for (const Section& section : report.sections) {
    const std::string body = body_of(section);
    if (!body.empty() && !section.title.empty()) {
      const std::string title = escaped(section.title);
      main += fmt::format("{}<section id=\"s{}\">\n<h2>{}</h2>\n", titled > 0 ? "</section>\n" : "",
                          titled + 1, title);
      nav += fmt::format("<li><a href=\"#s{}\">{}</a></li>\n", ++titled, title);
    }
    main += body;
  }
  if (titled > 2) out += "<nav><ul>\n" + nav + "</ul></nav>\n";
  out += main + (titled > 0 ? "</section>\n" : "");
  return out +
         fmt::format("<footer><p>Written by driftscope {}. {}</p></footer>\n</body>\n</html>\n",
                     escaped(report.command), escaped(report.footer));
}

}  // namespace drift::report
