#include "analysis/planning/position_pool.hpp"

#include <fmt/format.h>

namespace drift::planning {
namespace {

constexpr double longer = 3.0;  // long dwells over usual ones

}  // namespace

std::string description(const Position& p, double usual_dwell) {
  return fmt::format(
      "{}, {}{}{}{}", attitude_text(p), key_of(p.mode), p.entry == Entry::torqued ? ", slewed" : "",
      p.case_heading ? fmt::format(", case at {:.0f} deg", *p.case_heading / unit::deg.to_si) : "",
      p.dwell == usual_dwell ? "" : fmt::format(", for {:.3g} min", p.dwell / unit::minute.to_si));
}

std::vector<Addition> held(const std::vector<Attitude>& attitudes, const Hold& hold) {
  std::vector<Addition> all;
  for (const Attitude& a : attitudes)
    for (const CommandLaw mode : {CommandLaw::free, CommandLaw::level})
      for (const std::optional<double>& heading : hold.headings) {
        Position p;
        p.axes = a.axes;
        p.R_lp = a.R_lp;
        p.dwell = hold.dwell;
        p.sample = hold.sample;
        p.mode = mode;
        p.entry = hold.entry;
        p.case_heading = heading;
        all.push_back({std::move(p)});
      }
  return all;
}

std::vector<Addition> position_pool(double usual_dwell, double sample) {
  const std::vector<Attitude> cardinal = cardinal_attitudes();
  std::vector<Addition> pool =
      held(all_attitudes(), {Entry::caged, usual_dwell, sample, {0.0, 90.0 * unit::deg.to_si}});
  for (Addition& a : held(cardinal, {Entry::caged, longer * usual_dwell, sample, {0.0}}))
    pool.push_back(std::move(a));
  for (const Addition& a : held(cardinal, {Entry::torqued, usual_dwell, sample})) {
    Position start = a.front();
    if (start.R_lp.isIdentity()) continue;  // no way to go
    start.axes = "x=N y=W z=U";
    start.R_lp.setIdentity();
    start.entry = Entry::caged;
    pool.push_back({start, a.front()});
  }
  return pool;
}

}  // namespace drift::planning
