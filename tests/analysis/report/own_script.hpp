#pragma once

#include <string>

#include "analysis/report/page/zoom.hpp"

namespace drift::test {

/// A page without the script that zooms its figures, its numbers and its style, where they are as
/// this build has them and the page's policy names the script: of what is left nothing may run.
inline std::string without_own_script(std::string page) {
  const auto erase = [&](const std::string& begin, const std::string& end) {
    for (auto at = page.find(begin); at != std::string::npos; at = page.find(begin)) {
      const auto stop = page.find(end, at + begin.size());
      if (stop == std::string::npos) return;
      page.erase(at, stop + end.size() - at);
    }
  };
  if (report::zoom_script().empty()) return page;
  if (page.find("script-src '" + report::policy_of(report::zoom_script()) + "';") ==
      std::string::npos)
    return page;
  erase("<script>" + std::string(report::zoom_script()), "</script>");
  erase("<script type=\"application/json\">", "</script>");
  return page;
}

}  // namespace drift::test
