#include <fmt/format.h>

#include <algorithm>

#include "core/recording/recording_check.hpp"
#include "core/recording/rows/check_time.hpp"

namespace drift {
namespace {

/// Whether everything that has a number for every row has as many.
bool as_many_as_rows(const Recording& r, Problems& problems) {
  const std::size_t before = problems.count();
  for (const Channel& c : r.channels)
    if (c.values.size() != r.rows())
      problems.add(c.name, fmt::format("{} values", c.values.size()),
                   fmt::format("{}, as in {}", r.rows(), r.channels.front().name),
                   "Give every channel one value per row; remove what is no channel");
  const auto look_at = [&](const char* what, std::size_t size) {
    if (size != 0 && size != r.rows())
      problems.add(what, fmt::format("{} values", size),
                   fmt::format("{}, as in {}, or none", r.rows(), r.channels.front().name),
                   "Give one for each row, or leave all of them out");
  };
  look_at("lines", r.lines.size());
  look_at("begins", r.begins.size());
  look_at("samples", r.samples.size());
  look_at("readings", r.readings.size());
  return problems.count() == before;
}

void check_rows(const Recording& r, RecordingKind kind, Problems& problems) {
  const std::size_t before = problems.count();
  check_time(r, problems);
  const bool in_order = problems.count() == before;
  check_phase(r, problems);
  check_position(r, in_order ? RowOrder::known : RowOrder::broken, problems);
  for (const Channel& c : r.channels)
    for (std::size_t row = 0; row < c.values.size(); ++row) check_value(r, c, row, kind, problems);
}

}  // namespace

void check_recording(const Recording& r, RecordingKind kind) {
  Problems problems(r.source.empty() ? "recording" : r.source);
  const std::size_t fewest = kind == RecordingKind::strapdown ? 2 : 1;
  if (r.channels.empty())
    problems.add("", "there is no channel", "channels such as time, acc_x, acc_y, acc_z",
                 "Give those that were recorded");
  else if (as_many_as_rows(r, problems) && r.rows() < fewest)
    problems.add("", r.rows() == 0 ? "there are no rows" : "there is one row",
                 fewest == 1 ? "one row per sample" : "at least two, to tell the sample interval",
                 "Give a longer recording");
  problems.throw_if_any();
  check_columns(r, kind, "", problems);
  check_rows(r, kind, problems);
  problems.throw_if_any();
}

}  // namespace drift
