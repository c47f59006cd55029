#include "analysis/report/identify/turned_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/words.hpp"

namespace drift::report {
namespace {

double degrees(double angle) {
  return angle / unit::deg.to_si;
}

std::string turn_text(double turn) {
  const double by = degrees(turn);
  const std::string_view toward = std::abs(by) == 180.0 ? ""
                                  : by > 0.0            ? ", from North toward West,"
                                                        : ", from North toward East,";
  return fmt::format("by {:.0f} deg{}", std::abs(by), toward);
}

}  // namespace

std::string turned_text(const identification::HeadingDoubt& doubt) {
  constexpr std::size_t most = 8;
  std::map<double, std::vector<std::string>> by_turn;
  for (const identification::TurnedPosition& t : doubt.turned)
    by_turn[t.turn].push_back(fmt::format("{}", t.position + 1));
  std::vector<std::string> parts;
  for (const auto& [turn, numbers] : by_turn)
    parts.push_back(turn_text(turn) + (doubt.all_alike ? " in every position"
                                                       : fmt::format(" in position{} {}",
                                                                     numbers.size() == 1 ? "" : "s",
                                                                     listed_up_to(numbers, most))));
  return "The platform did not head as the plan says, but turned about Up " + listed(parts, "and");
}

std::string corrected_text(const identification::HeadingDoubt& doubt, std::string_view command) {
  return fmt::format(
      "Next: {} again with corrected.toml of the results folder (-o), the study with the headings "
      "of the recording{}.",
      command,
      doubt.recorded ? ", and without its case_heading, which is as wrong: --set "
                       "'recording.ignore=[\"case_heading\"]', or what the column is called"
                     : "");
}

Json heading_json(const identification::HeadingDoubt& doubt) {
  Json turned = Json::array();
  for (const identification::TurnedPosition& t : doubt.turned) {
    const Position& p = doubt.positions[static_cast<std::size_t>(t.position)];
    turned.push_back(
        {{"position", t.position + 1},
         {"turn_deg", degrees(t.turn)},
         {"axes", p.axes},
         {"case_heading_deg", p.case_heading ? Json(degrees(*p.case_heading)) : Json(nullptr)}});
    for (const AxisTurn& own : p.turns) turned.back()["turns_of_platform"].push_back(own.text);
  }
  return {{"turned", std::move(turned)},
          {"chi2_per_dof_before", doubt.chi2_per_dof_before},
          {"chi2_per_dof_after", doubt.chi2_per_dof_after},
          {"chance", doubt.chance},
          {"chance_after", doubt.chance_after},
          {"alone", doubt.alone()}};
}

}  // namespace drift::report
