#include "core/recording/rows/quality_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/words.hpp"
#include "core/recording/instants/clock_leap.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/recording/rows/row_remarks.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

/// Intervals and gaps. Every position and phase has its own sample interval; from one position to
/// the next time may pass.
void look_at_time(const Recording& r, QualityCard& card) {
  const Channel* time = r.find("time");
  if (!time || r.rows() == 0) return;
  const auto& t = time->values;
  const Channel* position = r.find("position");
  card.start = t.front();
  card.span = t.back() - t.front();
  const RowSpacing spacing = row_spacing(r);
  const std::vector<ClockLeap> leaps = clock_leaps(r, spacing);
  if (std::string text = clock_leaps_text(r, leaps); !text.empty())
    card.remarks.add(Weight::wrong, std::move(text));
  std::vector<double> within;
  card.positions = position ? 1 : 0;
  std::size_t begin = 0, told = 0;  // row and gap with which this position begins
  const auto end_position = [&](std::size_t last) {
    for (; told < card.gaps.size(); ++told) card.gaps[told].within = t[last] - t[begin];
  };
  for (std::size_t row = 1; row < t.size(); ++row) {
    const bool other = position && position->values[row] != position->values[row - 1];
    if (other) {
      ++card.positions;
      end_position(row - 1);
      begin = row;
    }
    if (!other) within.push_back(spacing.step[row]);
    if (!spacing.gap(row) || std::ranges::find(leaps, row, &ClockLeap::row) != leaps.end())
      continue;
    (other ? card.between : card.gaps).push_back({r.lines[row], t[row - 1], spacing.step[row]});
    if (!other) card.lost += spacing.missing(row);
  }
  end_position(t.size() - 1);
  card.interval = stats::median(within);
  card.shortest = spacing.shortest;
  card.longest = spacing.longest;
  card.jitter = spacing.jitter;
}

ChannelQuality look_at_channel(const Channel& c, const Recording& r, RecordingKind kind) {
  ChannelQuality q;
  q.name = c.name;
  const auto quantity = known_quantity(c.name);
  q.unit = quantity && !quantity->needs_unit ? "" : std::string(c.unit.symbol.view());
  q.covariate = is_covariate(c.name, kind);
  q.min = q.max = q.mean = q.sd = nan_value;
  double mean = 0.0, squares = 0.0, low = 0.0, high = 0.0;
  for (const double x : c.values) {
    if (!std::isfinite(x)) {
      ++q.missing;
      continue;
    }
    low = q.measured == 0 ? x : std::min(low, x);
    high = q.measured == 0 ? x : std::max(high, x);
    ++q.measured;
    const double step = x - mean;  // Welford: no cancellation
    mean += step / static_cast<double>(q.measured);
    squares += step * (x - mean);
  }
  if (q.measured == 0) return q;
  q.min = in_unit(low, c.unit);
  q.max = in_unit(high, c.unit);
  q.mean = mean / c.unit.to_si;
  q.sd = q.measured > 1 ? std::sqrt(squares / static_cast<double>(q.measured - 1)) / c.unit.to_si
                        : 0.0;
  q.step = reading_step(c, r.find("position")).value_or(0.0) / c.unit.to_si;
  for (std::size_t i = 0; i < c.values.size();) {
    const double x = c.values[i];
    std::size_t end = i + 1;
    while (end < c.values.size() && c.values[end] == x) ++end;
    if (std::isfinite(x)) {
      if (end - i > q.stuck) {
        q.stuck = end - i;
        q.stuck_line = r.lines[i];
      }
    }
    i = end;
  }
  return q;
}

/// A sensor, which cannot read one and the same value for long; a plan or a command can.
bool is_sensor(const ChannelQuality& q) {
  return !q.covariate && (q.name.starts_with("acc_") || q.name.starts_with("gyro_") ||
                          q.name.starts_with("gimbal_"));
}

/// What looks broken.
void remark_channels(const Recording& r, QualityCard& card) {
  for (const auto& q : card.channels) {
    const bool said = std::ranges::any_of(q.standing, [&](const Saturation& s) {
      return std::ranges::any_of(s.rows, [&](std::size_t k) { return r.lines[k] == q.stuck_line; });
    });
    if (q.measured == 0)
      card.remarks.add(Weight::wrong, q.name + ": nothing was measured");
    else if (is_sensor(q) && q.stuck >= 3 && q.step > 0.0)
      card.remarks.add(
          Weight::doubtful,
          fmt::format(
              "{0}: its readings are steps of {1:.3g} {2} (identical for up to {3} samples): "
              "a noise of less than {4:.2g} {2} is not in them",
              q.name, q.step, q.unit, q.stuck, q.step / std::sqrt(12.0)));
    else if (is_sensor(q) && q.stuck >= 20 && !said)
      card.remarks.add(Weight::wrong,
                       fmt::format("{}: {} identical samples from line {} on: a stuck sensor?",
                                   q.name, q.stuck, q.stuck_line));
  }
}

/// What a sensor at the end of its range reads, or one that hangs while it turns.
void remark_saturated(const Recording& r, QualityCard& card) {
  for (const auto& q : card.channels)
    for (const Saturation& s : q.standing) {
      const Unit& unit = r.find(q.name)->unit;
      const std::size_t runs = s.runs();
      card.remarks.add(
          Weight::wrong,
          fmt::format("{}: {} rows in {} run{} read {:.5g} {}, {}, which noise does not give so "
                      "often, the first in line {}: {}",
                      q.name, s.rows.size(), runs, runs == 1 ? "" : "s", in_unit(s.value, unit),
                      q.unit,
                      s.at == Saturation::At::low    ? "its least"
                      : s.at == Saturation::At::high ? "its greatest"
                                                     : "while it turns",
                      r.lines[s.rows.front()],
                      s.at == Saturation::At::between ? "stuck, or saturated?" : "saturated"));
    }
}

/// A temperature that is called degC and would be one of a room, or of a chamber, in degF. Beside a
/// room an instrument sees 15 to 40 degC and some kelvins of its own heat; 15 degC, that of the
/// coldest laboratory, are 59 degF. Heated gyros and chambers go there too, to 85 degC (185 degF):
/// it is asked, and not refused.
void ask_about_fahrenheit(QualityCard& card) {
  constexpr double coldest_room = 59.0, hottest_chamber = 185.0;  // [degF]
  for (const auto& q : card.channels)
    if (q.name == "temperature" && q.unit == "degC" && q.mean >= coldest_room &&
        q.mean <= hottest_chamber)
      card.remarks.add(
          Weight::doubtful,
          fmt::format("temperature: {:.3g} degC in the mean, more than instruments see beside a "
                      "room: is it degF ({:.3g} degC)? Then write temperature = \"its header as "
                      "it stands, then [degF]\" in columns of [recording]",
                      q.mean, (q.mean - 32.0) / 1.8));
}

/// Without commands those of the plan are taken; columns that may be commands under another name
/// are asked about first: what can be learned hangs on what the platform was told.
void remark_no_commands(const Recording& r, QualityCard& card) {
  std::vector<std::string> rates;
  for (const Channel& c : r.channels)
    if (c.unit.dim == unit::deg_per_h.dim && is_covariate(c.name, RecordingKind::platform))
      rates.push_back(c.name);
  const std::string none = "no commands (cmd_*): those of the plan are taken";
  if (rates.empty()) {
    card.remarks.add(Weight::note, none);
    return;
  }
  card.remarks.add(
      Weight::doubtful,
      fmt::format("{}, though {} {} in a unit of rates: if the platform was told so, write cmd_x, "
                  "cmd_y, cmd_z = \"the header as it stands\" in columns of [recording]",
                  none, listed(rates, "and"), rates.size() == 1 ? "is" : "are"));
}

/// What is not there, and what is made of that.
void remark_absent(const Recording& r, RecordingKind kind, QualityCard& card) {
  if (kind == RecordingKind::platform) {
    if (!r.find("cmd_x")) remark_no_commands(r, card);
    if (!r.find("phase")) card.remarks.add(Weight::note, "no phase: every row is taken as dwell");
    for (const auto& triple : {channel_triples[0], channel_triples[1]}) {
      std::vector<std::string_view> absent;
      for (const auto name : triple.names)
        if (!r.find(name)) absent.push_back(name);
      if (absent.size() == triple.names.size())
        card.remarks.add(Weight::doubtful, fmt::format("no {}", triple.what));
      else
        for (const auto name : absent)
          card.remarks.add(Weight::doubtful, fmt::format("no {}: taken as not measured", name));
    }
  }
}

/// At most five significant digits, "-" for none.
std::string digits(double x) {
  return std::isnan(x) ? "-" : fmt::format("{:.5g}", x);
}

std::string gap_text(const std::vector<Gap>& gaps) {
  if (gaps.empty()) return "none";
  const auto& g = *std::ranges::max_element(gaps, {}, &Gap::length);
  return fmt::format("{}, largest {} s after {} s (line {})", gaps.size(), digits(g.length),
                     fmt::format("{:.10g}", g.start), g.line);
}

}  // namespace

std::size_t ChannelQuality::saturated() const {
  std::size_t n = 0;
  for (const Saturation& s : standing) n += s.at != Saturation::At::between ? s.runs() : 0;
  return n;
}

QualityCard quality_card(const Recording& recording, RecordingKind kind) {
  QualityCard card;
  card.file = recording.source;
  const auto dot = card.file.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : card.file.substr(dot);
  card.format = extension.empty()                                                  ? "simulated"
                : extension == ".mat" || extension == ".MAT"                       ? "MATLAB"
                : extension == ".h5" || extension == ".hdf5" || extension == ".H5" ? "HDF5"
                                                                                   : "CSV";
  card.rows = recording.rows();
  card.facts = recording.facts;
  look_at_time(recording, card);
  for (const auto& c : recording.channels)
    if (c.name != "time") card.channels.push_back(look_at_channel(c, recording, kind));
  const auto sensors = static_cast<std::size_t>(std::ranges::count_if(card.channels, is_sensor));
  for (ChannelQuality& q : card.channels)
    if (is_sensor(q)) q.standing = saturations(recording, *recording.find(q.name), sensors);
  // A platform's gimbals are not read while it slews, which is no loss.
  if (kind == RecordingKind::strapdown)
    for (const ChannelQuality& q : card.channels)
      if (is_sensor(q) && q.measured > 0) card.empty += q.missing;
  // In the order of harm, which those of one weight keep.
  remark_saturated(recording, card);
  remark_repeats(recording, card);
  remark_gaps(card);
  remark_channels(recording, card);
  ask_about_fahrenheit(card);
  card.remarks.add(recording.remarks);
  remark_absent(recording, kind, card);
  return card;
}

std::string to_text(const QualityCard& card) {
  std::string out = fmt::format("{} ({}): {} rows, {:.10g} s from {:.10g} s on",
                                card.file.empty() ? "recording" : card.file, card.format, card.rows,
                                card.span, card.start);
  if (card.positions > 0) out += fmt::format(", {} positions", card.positions);
  const std::string range =
      card.longest > 1.5 * card.shortest
          ? fmt::format("; {} s to {} s by stretches", digits(card.shortest), digits(card.longest))
          : "";
  out += fmt::format("\nsample interval {} s (median{}), jitter {} s\n", digits(card.interval),
                     range, digits(card.jitter));
  out += fmt::format("gaps {}", gap_text(card.gaps));
  if (!card.gaps.empty()) out += fmt::format(", about {:.0f} samples lost", card.lost);
  if (card.empty > 0) out += fmt::format("; cells without a number: {}", card.empty);
  if (card.positions > 0) out += fmt::format("; between positions {}", gap_text(card.between));
  out += fmt::format("\n{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}{:>9}{:>8}{:>6}\n", "channel", "unit",
                     "min", "max", "mean", "sd", "missing", "stuck", "sat");
  for (const auto& q : card.channels)
    out += fmt::format("{:<16}{:<10}{:>12}{:>12}{:>12}{:>12}{:>9}{:>8}{:>6}{}\n", q.name, q.unit,
                       digits(q.min), digits(q.max), digits(q.mean), digits(q.sd), q.missing,
                       q.stuck, q.saturated(), q.covariate ? "  covariate" : "");
  if (!card.channels.empty())
    out +=
        "stuck: samples in the longest run of one value; sat: runs at the minimum or maximum that "
        "noise does not make\n";
  for (const auto& sentence : card.remarks.texts()) out += "! " + sentence + "\n";
  for (const auto& [key, value] : card.facts) {
    std::string shown = value.substr(0, 90);
    while (shown.size() < value.size() && !shown.empty() && !valid_utf8(shown)) shown.pop_back();
    out += fmt::format("# {} = {}{}\n", key, shown, shown.size() < value.size() ? "..." : "");
  }
  return out;
}

}  // namespace drift
