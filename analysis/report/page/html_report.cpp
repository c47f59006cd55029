#include "analysis/report/page/html_report.hpp"

#include <fmt/format.h>

#include "analysis/report/page/escape.hpp"

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
  std::string out = fmt::format("<ul class=\"{}\">\n", css_class);
  for (const auto& item : items) out += "<li>" + escaped(item) + "</li>\n";
  return out + "</ul>\n";
}

struct BlockWriter {
  std::string operator()(const Paragraph& p) const { return "<p>" + escaped(p.text) + "</p>\n"; }
  std::string operator()(const Sentences& s) const { return list_of(s.items, "sentences"); }
  std::string operator()(const Preformatted& p) const {
    return "<pre>" + escaped(p.text) + "</pre>\n";
  }
  std::string operator()(const Table& t) const { return html_of(t); }
  std::string operator()(const Picture& p) const {
    return "<figure>\n" + inlined(p.svg) + "<figcaption>" + escaped(p.caption) +
           "</figcaption>\n</figure>\n";
  }
};

}  // namespace

std::string to_html(const HtmlReport& report) {
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<header><h1>{0}</h1>\n"
      "<p class=\"subtitle\">{2}</p></header>\n",
      escaped(report.title), style, escaped(report.subtitle));
  if (!report.headlines.empty()) out += list_of(report.headlines, "headlines");
  if (report.sections.size() > 2) {
    out += "<nav><ul>\n";
    for (std::size_t k = 0; k < report.sections.size(); ++k)
      out += fmt::format("<li><a href=\"#s{}\">{}</a></li>\n", k + 1,
                         escaped(report.sections[k].heading));
    out += "</ul></nav>\n";
  }
  for (std::size_t k = 0; k < report.sections.size(); ++k) {
    out += fmt::format("<section id=\"s{}\">\n<h2>{}</h2>\n", k + 1,
                       escaped(report.sections[k].heading));
    for (const Block& block : report.sections[k].blocks) out += std::visit(BlockWriter{}, block);
    out += "</section>\n";
  }
  return out + "<footer><p>" + escaped(report.footer) + "</p></footer>\n</body>\n</html>\n";
}

}  // namespace drift::report
