#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/recording/own/columns.hpp"
#include "core/recording/own/csv_cells.hpp"

namespace drift {
namespace {

using Role = ColumnUse::Role;

/// Time from a counter or from the rate; and what stands in a column of time beside it is left out.
std::vector<double> time_of(const RawRecording& raw, const RawColumn* counter,
                            const RecordingFormat& format, Problems& problems) {
  const std::size_t rows = raw.columns.empty() ? 0 : raw.columns.front().values.size();
  std::vector<double> time(rows);
  const double step = format.tick ? *format.tick : format.rate ? 1.0 / *format.rate : 1.0;
  double turns = 0.0, last = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (counter == nullptr) {
      time[i] = static_cast<double>(i + 1) * step;
      continue;
    }
    const double count = counter->values[i];
    if (i > 0 && count < last) {
      // A counter that begins again has gone on by less than half a turn.
      if (format.wrap && count + *format.wrap - last < 0.5 * *format.wrap)
        turns += *format.wrap;
      else
        problems.add(
            fmt::format("{}:{}", i < raw.lines.size() ? raw.lines[i] : i + 1, counter->name),
            fmt::format("the counter goes back from {:.12g} to {:.12g}", last, count),
            format.wrap ? fmt::format("it to begin again at {:.12g}", *format.wrap)
                        : std::string("it to increase"),
            "Give recording.wrap, the count at which it begins again, or sort the rows");
    }
    last = count;
    time[i] = (count + turns) * step;
  }
  return time;
}

/// Numbers that stand for what was not measured become that, kept in single precision too.
void leave_out(RawColumn& column, const std::vector<double>& missing) {
  for (double& x : column.values)
    if (std::ranges::any_of(missing, [&](double number) {
          return x == number || x == static_cast<double>(static_cast<float>(number));
        }))
      x = std::numeric_limits<double>::quiet_NaN();
}

RawColumn time_column(std::vector<double> values) {
  RawColumn time;
  time.name = "time";
  time.unit = "s";
  time.values = std::move(values);
  return time;
}

}  // namespace

RawRecording with_channels(RawRecording raw, const std::vector<ColumnUse>& uses,
                           const RecordingFormat& format, Problems& problems) {
  RawRecording out;
  out.facts = std::move(raw.facts);
  out.remarks = std::move(raw.remarks);
  out.unmapped_temperature = std::move(raw.unmapped_temperature);
  out.kind = format.kind;
  out.angles = format.angles;
  out.settled = raw.settled;
  const RawColumn* counter = nullptr;
  std::vector<std::string> texts;
  std::vector<double> missing;
  for (const std::string& text : format.missing)
    if (const double number = cell_number(text); std::isfinite(number)) missing.push_back(number);
  const bool own_time = format.rate || !format.counter.empty();
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (uses[i].role == Role::counter) counter = &raw.columns[i];
  if (own_time && (counter != nullptr || format.counter.empty()))
    out.columns.push_back(time_column(time_of(raw, counter, format, problems)));
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const ColumnUse& use = uses[i];
    RawColumn& column = raw.columns[i];
    if (use.role == Role::ignored || use.role == Role::counter || use.role == Role::date) continue;
    if (own_time && use.channel == "time") {
      out.remarks.add(
          Weight::note,
          fmt::format("{}: left out, time comes from {} of the study file", in_quotes(column.name),
                      format.rate ? "recording.rate" : "recording.counter"));
      continue;
    }
    if (use.role == Role::covariate && column.texts > 0) {
      if (column.numbers == 0) {
        texts.push_back(in_quotes(column.name));
        continue;
      }
      out.remarks.add(Weight::doubtful,
                      fmt::format("{}: {} cells hold text and are taken as not measured",
                                  use.channel, column.texts));
    }
    if (column.name.empty() && column.numbers == 0) continue;  // a superfluous delimiter
    const auto offset = std::ranges::find(format.offsets, use.channel, &ChannelOffset::channel);
    if (use.role == Role::sensor || use.role == Role::covariate) leave_out(column, missing);
    if (!column.clock) column.unit = use.unit;
    column.name = use.channel;
    column.sign = use.sign;
    if (offset != format.offsets.end()) column.offset = *offset;
    out.columns.push_back(std::move(column));
  }
  if (!texts.empty())
    out.remarks.add(Weight::note,
                    fmt::format("columns of text are passed over: {}", fmt::join(texts, ", ")));
  for (const ChannelOffset& o : format.offsets)
    if (std::ranges::find(out.columns, o.channel, &RawColumn::name) == out.columns.end())
      problems.add(o.channel,
                   fmt::format("there is no such channel, but recording.offset.{} of the "
                               "study file adds to it",
                               o.channel),
                   "a channel of the recording", "Remove the offset, or map the column");
  out.lines = std::move(raw.lines);
  return out;
}

}  // namespace drift
