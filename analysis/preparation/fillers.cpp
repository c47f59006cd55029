#include "analysis/preparation/fillers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/words.hpp"
#include "core/params/covariates.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"

namespace drift::preparation {
namespace {

/// Rows of a position whose number is one and the same.
struct Run {
  std::size_t first = 0, last = 0;
};

/// Whether no row beside the run, in its position, is near it: at least one is there.
bool stands_apart(const std::vector<double>& x, const Channel& position, const Run& run,
                  double apart, bool angle) {
  const double value = x[run.first];
  std::size_t beside = 0;
  const auto far = [&](std::size_t row) {
    if (position.values[row] != position.values[run.first] || !std::isfinite(x[row])) return true;
    ++beside;
    const double by = x[row] - value, turn = 360.0 * detail::deg;
    // Beyond a turn an angle is not that angle less whole turns.
    const bool round = angle && std::max(std::abs(x[row]), std::abs(value)) <= 1.01 * turn;
    return std::abs(round ? std::remainder(by, turn) : by) > apart;
  };
  const bool alone =
      (run.first == 0 || far(run.first - 1)) && (run.last + 1 == x.size() || far(run.last + 1));
  return alone && beside > 0;
}

/// Its rows from one that `goes_on` accepts together with the row before it.
template <class GoesOn>
std::vector<Run> runs_of(std::size_t rows, const Channel& position, GoesOn&& goes_on) {
  std::vector<Run> all;
  for (std::size_t i = 0; i < rows; ++i)
    if (i > 0 && position.values[i] == position.values[i - 1] && goes_on(i))
      all.back().last = i;
    else
      all.push_back({i, i});
  return all;
}

/// The runs of every number that stands apart; where it is near its neighbours it may be read.
std::map<double, std::vector<Run>> standing_apart(const Channel& c, const Channel& position,
                                                  double apart, bool angle) {
  std::map<double, std::vector<Run>> runs;
  for (const Run& run : runs_of(c.values.size(), position,
                                [&](std::size_t i) { return c.values[i] == c.values[i - 1]; }))
    if (std::isfinite(c.values[run.first]) && stands_apart(c.values, position, run, apart, angle))
      runs[c.values[run.first]].push_back(run);
  return runs;
}

std::vector<Run> runs_of_number(const Channel& c, const Channel& position, double number) {
  std::vector<Run> all = runs_of(c.values.size(), position,
                                 [&](std::size_t i) { return c.values[i] == c.values[i - 1]; });
  std::erase_if(all, [&](const Run& run) { return c.values[run.first] != number; });
  return all;
}

bool enough(const std::vector<Run>& runs, const Channel& position,
            std::size_t fewest = FillerLimits::positions) {
  std::size_t rows = 0;
  std::set<double> positions;
  for (const Run& run : runs) {
    rows += run.last - run.first + 1;
    positions.insert(position.values[run.first]);
  }
  return rows >= FillerLimits::rows && positions.size() >= fewest;
}

/// The runs of every number that all three read at once and that stands apart in one of them, often
/// enough to be none that is read; then it is that wherever all three read it. A platform may rest
/// at one angle in all three gimbals, in one position; no specific force is alike to the last
/// digit.
std::map<double, std::vector<Run>> alike_in_all(const std::array<Channel*, 3>& c,
                                                const Channel& position, double apart, bool angle) {
  const std::size_t fewest = angle ? FillerLimits::positions : 1;
  const auto alike = [&](std::size_t i) {
    return c[0]->values[i] == c[1]->values[i] && c[0]->values[i] == c[2]->values[i];
  };
  std::map<double, std::vector<Run>> all, far;
  for (const Run& run : runs_of(c[0]->values.size(), position, [&](std::size_t i) {
         return alike(i) && alike(i - 1) && c[0]->values[i] == c[0]->values[i - 1];
       })) {
    if (!alike(run.first)) continue;
    const double number = c[0]->values[run.first];
    all[number].push_back(run);
    if (std::ranges::any_of(c, [&](const Channel* one) {
          return stands_apart(one->values, position, run, apart, angle);
        }))
      far[number].push_back(run);
  }
  std::erase_if(all,
                [&](const auto& entry) { return !enough(far[entry.first], position, fewest); });
  return all;
}

/// Takes the runs out of the channels.
void leave_out(const std::vector<Channel*>& channels, const std::vector<Run>& runs,
               const Recording& r, std::vector<std::string>& remarks) {
  const Channel& first = *channels.front();
  std::vector<std::string> names;
  for (const Channel* c : channels) names.push_back(c->name);
  std::size_t rows = 0;
  for (const Run& run : runs) rows += run.last - run.first + 1;
  remarks.push_back(fmt::format(
      "{}: {} {} {:.10g} {} in {} rows, the first in line {}, far from what is beside {}: taken as "
      "not measured",
      r.source.empty() ? "recording" : r.source, listed(names, "and"),
      names.size() == 1 ? "reads" : "all read", first.values[runs.front().first] / first.unit.to_si,
      first.unit.symbol.view(), rows, r.lines[runs.front().first], rows == 1 ? "it" : "them"));
  for (Channel* c : channels)
    for (const Run& run : runs)
      std::fill(c->values.begin() + static_cast<std::ptrdiff_t>(run.first),
                c->values.begin() + static_cast<std::ptrdiff_t>(run.last) + 1,
                std::numeric_limits<double>::quiet_NaN());
}

void leave_out_of_one(Channel& c, const Channel& position, double apart, bool angle,
                      const Recording& r, std::vector<std::string>& remarks) {
  auto all = standing_apart(c, position, apart, angle);
  std::erase_if(all, [&](const auto& entry) { return !enough(entry.second, position); });
  // To the last digit a fine readout does not come back to it.
  if (!all.empty() && !reading_step(c, &position))
    for (auto& [number, runs] : all) runs = runs_of_number(c, position, number);
  for (const auto& [number, runs] : all) leave_out({&c}, runs, r, remarks);
}

std::vector<Channel*> channels_of(Recording& r, const ChannelTriple& triple) {
  std::vector<Channel*> channels;
  for (const std::string_view name : triple.names)
    if (const auto c = std::ranges::find(r.channels, name, &Channel::name); c != r.channels.end())
      channels.push_back(&*c);
  return channels;
}

/// Takes the rows of the runs out of gyros that read alike there, too; whether any did.
bool leave_out_alike(const std::vector<Channel*>& gyros, const std::vector<Run>& runs) {
  if (gyros.size() != 3) return false;
  bool any = false;
  for (const Run& run : runs)
    for (std::size_t i = run.first; i <= run.last; ++i) {
      const double first = gyros[0]->values[i];
      if (gyros[1]->values[i] != first || gyros[2]->values[i] != first) continue;
      any = true;
      for (Channel* c : gyros) c->values[i] = std::numeric_limits<double>::quiet_NaN();
    }
  return any;
}

}  // namespace

void leave_out_fillers_on_a_case(Recording& r, std::vector<std::string>& remarks) {
  const std::vector<Channel*> acc = channels_of(r, accelerometer_channels);
  if (acc.size() != 3) return;
  const auto coarse = [](const Channel* c) {
    const auto step = reading_step(*c, nullptr);
    return step && *step > FillerLimits::force;
  };
  if (std::ranges::any_of(acc, coarse)) return;
  const Channel anywhere{"position", unit::one, std::vector<double>(r.rows(), 1.0)};
  for (const auto& [number, runs] :
       alike_in_all({acc[0], acc[1], acc[2]}, anywhere, FillerLimits::force, false)) {
    leave_out(acc, runs, r, remarks);
    if (leave_out_alike(channels_of(r, gyro_channels), runs))
      remarks.back() += ", with gyro_x, gyro_y and gyro_z where they read alike, too";
  }
}

void leave_out_fillers(Recording& r, std::vector<std::string>& remarks) {
  const Channel* const found = r.find("position");
  if (found == nullptr) return;
  const Channel position = *found;
  for (const ChannelTriple& triple : {accelerometer_channels, gimbal_channels}) {
    const std::vector<Channel*> channels = channels_of(r, triple);
    const bool angle = triple.names == gimbal_channels.names;
    const double apart = angle ? FillerLimits::angle : FillerLimits::force;
    if (channels.size() == 3)
      for (const auto& [number, runs] :
           alike_in_all({channels[0], channels[1], channels[2]}, position, apart, angle))
        leave_out(channels, runs, r, remarks);
    for (Channel* c : channels) leave_out_of_one(*c, position, apart, angle, r, remarks);
  }
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k) {
      const auto of = std::ranges::find(r.channels, c.column(k).view(), &Channel::name);
      if (of != r.channels.end())
        leave_out_of_one(*of, position, c.usual * c.unit.to_si, false, r, remarks);
    }
}

}  // namespace drift::preparation
