#include "analysis/preparation/rows/raw_spikes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/nan.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/check_time.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/stats/among_neighbours.hpp"
#include "core/stats/median.hpp"

namespace drift::preparation {
namespace {

constexpr std::size_t reach = 2;  // readings to either side

/// Whether a row is of a slew, by its phase or what it commands.
class Slewed {
 public:
  explicit Slewed(const Recording& r) : phase_(r.find("phase")) {
    for (std::size_t i = 0; i < 3; ++i) commands_[i] = r.find(command_channels.names[i]);
  }
  bool operator()(std::size_t row) const {
    if (phase_ != nullptr && phase_->values[row] == 1.0) return true;
    double squares = 0.0;
    for (const Channel* c : commands_)
      if (c != nullptr) squares += c->values[row] * c->values[row];
    return squares > fastest_drift * fastest_drift;
  }

 private:
  const Channel* phase_;
  const Channel* commands_[3] = {};
};

/// Calls `look(row, among)` for every reading of a channel with two measured on either side in its
/// position.
template <typename Look>
void among_their_neighbours(const Channel& c, const Channel* position, const Slewed& slewed,
                            const Look& look) {
  std::size_t rows[2 * reach + 1] = {}, held = 0;
  std::vector<double> around(2 * reach);
  const bool angle = is_angle(c.name);
  for (std::size_t row = 0; row < c.values.size(); ++row) {
    const bool turns = slewed(row);
    if (turns ||
        (row > 0 && position != nullptr && position->values[row] != position->values[row - 1]))
      held = 0;
    if (turns || !std::isfinite(c.values[row])) continue;
    if (held == std::size(rows)) {
      std::shift_left(std::begin(rows), std::end(rows), 1);
      --held;
    }
    rows[held++] = row;
    if (held < std::size(rows)) continue;
    const double x = c.values[rows[reach]];
    for (std::size_t k = 0, n = 0; k < std::size(rows); ++k) {
      if (k == reach) continue;
      const double off = c.values[rows[k]] - x;
      around[n++] = angle ? std::remainder(off, 2.0 * std::numbers::pi) : off;
    }
    look(rows[reach], stats::among_neighbours(0.0, around, true));
  }
}

/// Of a reading of the channel [internal unit], by what is usual; empty where it does not tell.
std::optional<double> noise_of(const Channel& c, const Channel* position, const Slewed& slewed) {
  std::vector<double> sizes;
  const std::size_t every = c.values.size() / RawSpikeLimits::of_noise + 1;
  std::size_t seen = 0;
  among_their_neighbours(c, position, slewed, [&](std::size_t, const auto& among) {
    if (seen++ % every == 0) sizes.push_back(among.size);
  });
  if (sizes.size() < RawSpikeLimits::enough) return std::nullopt;
  const double noise = stats::upper_median(std::move(sizes)) / stats::usual_size_among_four,
               step = reading_step(c, position).value_or(0.0);
  return std::max(noise, step) > 0.0 ? std::optional(std::max(noise, step)) : std::nullopt;
}

}  // namespace

std::vector<RawSpikes> raw_spikes(const Recording& recording) {
  std::vector<RawSpikes> all;
  const Channel* position = recording.find("position");
  const Slewed slewed(recording);
  for (const ChannelTriple& triple : {accelerometer_channels, gimbal_channels})
    for (const std::string_view name : triple.names) {
      const Channel* c = recording.find(name);
      const auto noise = c != nullptr ? noise_of(*c, position, slewed) : std::nullopt;
      if (!noise) continue;
      RawSpikes spikes{std::string(name), {}};
      const auto most =
          static_cast<std::size_t>(RawSpikeLimits::most * static_cast<double>(c->values.size()));
      among_their_neighbours(*c, position, slewed, [&](std::size_t row, const auto& among) {
        if (spikes.rows.size() <= most &&
            among.size > RawSpikeLimits::size * *noise + RawSpikeLimits::spread * among.spread)
          spikes.rows.push_back(row);
      });
      if (!spikes.rows.empty() && spikes.rows.size() <= most) all.push_back(std::move(spikes));
    }
  return all;
}

std::string raw_spikes_text(const Recording& r, const RawSpikes& spikes) {
  constexpr std::size_t named = 5;
  const std::size_t count = spikes.rows.size(), shown = std::min(count, named);
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < shown; ++k) lines.push_back(line_of(r, spikes.rows[k]));
  return fmt::format("{}: {}: {} isolated reading{} far from those around (line{} {}{})",
                     r.source.empty() ? "recording" : r.source, spikes.channel, count,
                     count == 1 ? "" : "s", count == 1 ? "" : "s", fmt::join(lines, ", "),
                     count > shown ? fmt::format(" and {} more", count - shown) : "");
}

void leave_out_raw_spikes(Recording& r, std::vector<std::string>& remarks) {
  for (const RawSpikes& spikes : raw_spikes(r)) {
    remarks.push_back(raw_spikes_text(r, spikes) + ": taken as not measured");
    const auto c = std::ranges::find(r.channels, spikes.channel, &Channel::name);
    for (const std::size_t row : spikes.rows) c->values[row] = nan_value;
  }
}

}  // namespace drift::preparation
