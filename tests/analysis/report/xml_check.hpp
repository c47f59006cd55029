#pragma once

#include <cctype>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace drift::test {

/// What keeps a text from being well-formed XML: tags that do not balance, attributes without
/// quotes or twice, '<' in a value, '&' that starts no entity. Empty if nothing. Comments and
/// doctypes are for `void_tags` pages (HTML) only.
inline std::optional<std::string> xml_problem(std::string_view text,
                                              const std::set<std::string>& void_tags = {}) {
  std::vector<std::string> open;
  bool rooted = false;
  const auto entity_ok = [&](std::size_t at) {
    const auto end = text.find(';', at);
    if (end == std::string_view::npos || end - at > 8) return false;
    const auto name = text.substr(at + 1, end - at - 1);
    return name == "amp" || name == "lt" || name == "gt" || name == "quot" || name.starts_with("#");
  };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '&' && !entity_ok(i)) return "bare & at " + std::to_string(i);
    if (c == '>') return "bare > at " + std::to_string(i);
    if (c != '<') {
      if (open.empty() && !std::isspace(static_cast<unsigned char>(c)))
        return "text outside the root";
      ++i;
      continue;
    }
    if (text.substr(i).starts_with("<!DOCTYPE html>")) {
      i += 15;
      continue;
    }
    const bool closing = text[++i] == '/';
    if (closing) ++i;
    std::size_t end = i;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0)) ++end;
    const std::string name(text.substr(i, end - i));
    if (name.empty()) return "no tag name at " + std::to_string(i);
    i = end;
    std::set<std::string> attributes;
    bool empty_tag = false;
    while (i < text.size() && text[i] != '>') {
      if (std::isspace(static_cast<unsigned char>(text[i]))) {
        ++i;
      } else if (text[i] == '/') {
        empty_tag = true;
        ++i;
      } else {
        const auto equals = text.find("=\"", i);
        if (equals == std::string_view::npos) return "attribute without value in <" + name;
        const std::string attribute(text.substr(i, equals - i));
        if (attribute.find_first_of(" <>'\"") != std::string::npos)
          return "attribute '" + attribute + "'";
        if (!attributes.insert(attribute).second) return "attribute twice: " + attribute;
        const auto close = text.find('"', equals + 2);
        if (close == std::string_view::npos) return "open quote in <" + name;
        for (std::size_t k = equals + 2; k < close; ++k)
          if (text[k] == '<' || (text[k] == '&' && !entity_ok(k)))
            return "bad value of " + attribute;
        i = close + 1;
      }
    }
    if (i >= text.size()) return "tag not ended: " + name;
    ++i;
    if (closing) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (!empty_tag && !void_tags.contains(name)) {
      if (open.empty() && rooted) return "a second root: " + name;
      rooted = true;
      open.push_back(name);
      if (name == "style") i = text.find("</style>", i);
      if (name == "script") i = text.find("</script>", i);
    }
  }
  if (!open.empty()) return "<" + open.back() + "> never closed";
  return rooted ? std::nullopt : std::optional<std::string>("no root");
}

}  // namespace drift::test
