#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/report.hpp"
#include "analysis/report/page/style.hpp"
#include "analysis/report/page/tone_class.hpp"
#include "analysis/report/page/zoom.hpp"

namespace drift::report {
namespace {

/// Inside HTML an <svg> needs no namespace, and the page shall hold no address at all; how wide it
/// was drawn is told to the style, which scales it on paper and on a telephone.
std::string inlined(std::string svg) {
  constexpr std::string_view name_space = " xmlns=\"http://www.w3.org/2000/svg\"",
                             box = " viewBox=\"0 0 ";
  for (auto at = svg.find(name_space); at != std::string::npos; at = svg.find(name_space)) {
    std::string drawn;
    if (const auto from = at + name_space.size(); svg.compare(from, box.size(), box) == 0) {
      const auto width = from + box.size();
      drawn =
          fmt::format(" style=\"--drawn: {}\"", svg.substr(width, svg.find(' ', width) - width));
    }
    svg.replace(at, name_space.size(), drawn);
  }
  return svg;
}

std::string list_of(const std::vector<std::string>& items, std::string_view css_class) {
  if (items.empty()) return "";
  std::string out = fmt::format("<ul class=\"{}\">\n", css_class);
  for (const auto& item : items) out += "<li>" + escaped(item) + "</li>\n";
  return out + "</ul>\n";
}

/// Lines of a table or a text beyond which it is folded in place.
constexpr std::size_t most_open = 12, most_open_sentences = 8;

/// Folded under a line that says what it is.
std::string folded(const std::string& summary, const std::string& body) {
  return fmt::format("<details>\n<summary>{}</summary>\n{}</details>\n", summary, body);
}

/// A picture as it stands on a page, `classes` besides.
std::string picture_of(const Figure& f, std::string_view classes) {
  const FlowingPanels& flowing = f.flowing;
  if (flowing.panels.empty())
    return fmt::format("<div class=\"scroll{}\">{}</div>", classes, inlined(f.svg));
  const std::size_t columns = std::min(flowing.columns, flowing.panels.size());
  const double width =
      std::max(static_cast<double>(columns) * flowing.panel_width, flowing.head_width);
  std::string out = fmt::format(
      "<div class=\"scroll panels{}\" style=\"max-width: {:.0f}px\"><div class=\"head\">{}</div>",
      classes, width + 1.0, inlined(flowing.head));
  for (const std::string& panel : flowing.panels) out += inlined(panel);
  return out + "</div>";
}

/// The same, and beside it what a narrow window shows in its place.
std::string pictures_of(const Figure& f) {
  if (f.narrow.empty()) return picture_of(f, "");
  return fmt::format("{}\n<div class=\"scroll narrow\">{}</div>", picture_of(f, " roomy"),
                     inlined(f.narrow));
}

struct BlockHtml {
  std::string operator()(const Paragraph& p) const { return "<p>" + escaped(p.text) + "</p>\n"; }
  std::string operator()(const Sentences& s) const {
    const std::string body = list_of(s.items, "sentences");
    return s.items.size() > most_open_sentences
               ? folded(fmt::format("{} remarks", s.items.size()), body)
               : body;
  }
  std::string operator()(const Preformatted& p) const {
    const std::string body = "<pre>" + escaped(p.text) + "</pre>\n";
    const auto lines = static_cast<std::size_t>(std::ranges::count(p.text, '\n'));
    return lines > most_open ? folded(fmt::format("As text, {} lines", lines), body) : body;
  }
  std::string operator()(const Table& t) const {
    if (t.rows.empty()) return t.title.empty() ? "" : "<p>" + escaped(t.title) + ": none.</p>\n";
    if (t.rows.size() <= most_open) return html_of(t);
    Table body = t;
    body.title.clear();
    const std::vector<TableRow> rows = shown(t, t.limit.page).rows;
    const auto counted = std::ranges::count_if(rows, [](const TableRow& r) { return !r.heading; });
    return folded(
        fmt::format("{} ({} rows)", escaped(t.title.empty() ? "Table" : t.title), counted),
        html_of(body));
  }
  std::string operator()(const Figure& f) const {
    const bool zoomed = !f.zoom.empty() && !zoom_script().empty();
    return fmt::format("<figure{}>\n{}{}<figcaption>{}</figcaption>\n</figure>\n",
                       zoomed ? " class=\"zoomable\"" : "", pictures_of(f),
                       zoomed ? "<script type=\"application/json\">" + f.zoom + "</script>" : "",
                       escaped(f.caption));
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

/// The answer: its light, what belongs to it, what to do next, and when it was made.
std::string answer_of(const Report& report) {
  const InBrief& brief = report.brief;
  std::string out = fmt::format("<section class=\"answer{}\">\n", tone_class(brief.tone));
  if (!brief.verdict.empty()) out += "<p class=\"verdict\">" + escaped(brief.verdict) + "</p>\n";
  out += list_of(brief.verdict.empty() ? report.headlines : brief.more.texts(), "headlines");
  if (!brief.next.empty()) out += "<p class=\"next\">" + escaped(brief.next) + "</p>\n";
  if (const Provenance& p = report.provenance; !p.version.empty()) {
    out += fmt::format("<p class=\"small\">driftscope {} ({}), {}", escaped(p.version),
                       escaped(p.commit), escaped(p.date));
    for (const auto* files : {&p.study, &p.recordings})
      for (const SourceFile& file : *files)
        out += fmt::format("; {} {}", escaped(file.path), file.sha256.substr(0, 12));
    out += "</p>\n";
  }
  return out + "</section>\n";
}

/// Headlines that the answer does not say already.
std::string headlines_of(const Report& report) {
  std::vector<std::string> others;
  for (const std::string& said : report.headlines) {
    bool known = report.brief.verdict.empty() ||
                 report.brief.verdict.find(said) != std::string::npos ||
                 report.brief.next.find(said) != std::string::npos;
    for (const std::string& more : report.brief.more.texts())
      known = known || more.find(said) != std::string::npos;
    if (!known) others.push_back(said);
  }
  return list_of(others, "sentences");
}

std::string provenance_html(const Report& report) {
  const Provenance& p = report.provenance;
  if (p.version.empty()) return "";
  Table table("", "< | <");
  table.add({"program", fmt::format("driftscope {}, commit {}", p.version, p.commit)});
  table.add({"made", p.date});
  table.add({"command line", p.command_line});
  for (const SourceFile& file : p.study)
    table.add({"study file", fmt::format("{}, SHA-256 {}", file.path, file.sha256)});
  for (const SourceFile& file : p.recordings)
    table.add({"recording", fmt::format("{}, SHA-256 {}", file.path, file.sha256)});
  return html_of(table);
}

std::string_view title_of(Part part) {
  switch (part) {
    case Part::evidence:
      return "Evidence";
    case Part::how_sure:
      return "How sure";
    case Part::details:
      return "Details";
    case Part::provenance:
      break;
  }
  return "Provenance";
}

/// A part of the page with all its sections; empty without any.
std::string part_of(const Report& report, Part part) {
  const bool fold = part == Part::details || part == Part::provenance;
  std::string out, title;
  const auto end_section = [&](const std::string& body) {
    if (body.empty()) return;
    if (fold)
      out += folded(title.empty() ? "More" : title, body);
    else
      out += (title.empty() ? "" : "<h3>" + title + "</h3>\n") + body;
  };
  if (part == Part::how_sure) out += headlines_of(report);
  std::string body;
  if (part == Part::provenance) {
    title = "Program, command, files";
    body = provenance_html(report);
  }
  std::string topic;  // the last title, of whatever part: a section without one goes on with it
  for (const Section& section : report.sections) {
    const bool next = !section.title.empty();
    if (next) topic = escaped(section.title);
    if (section.part != part) continue;
    const std::string more = body_of(section);
    if (more.empty()) continue;
    if (next || (fold && title != topic)) {
      end_section(body);
      body.clear();
      title = topic;
    }
    body += more;
  }
  end_section(body);
  if (out.empty()) return "";
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title_of(part), out);
}

}  // namespace

std::string to_html(const Report& report) {
  std::string body = answer_of(report);
  for (const Part part : {Part::evidence, Part::how_sure, Part::details, Part::provenance})
    body += part_of(report, part);
  const bool zoomed = body.find("<figure class=\"zoomable\">") != std::string::npos;
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; {4}base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}{3}</style>\n</head>\n<body>\n<header><h1>{0}</h1>\n"
      "<p class=\"subtitle\">{2}</p></header>\n",
      escaped(report.title), page_style, escaped(report.subtitle), zoomed ? zoom_style() : "",
      zoomed ? fmt::format("script-src '{}'; ", policy_of(zoom_script())) : "");
  out += body + fmt::format("<footer><p>Written by driftscope {}. {}</p></footer>\n",
                            escaped(report.command), escaped(report.footer));
  if (zoomed) out.append("<script>").append(zoom_script()).append("</script>\n");
  return out + "</body>\n</html>\n";
}

}  // namespace drift::report
