#include "core/recording/recording_read_back.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

bool holds(const RawColumn& column, const Channel& channel) {
  if (column.name != channel.name || column.unit.value_or("") != channel.unit.symbol.view() ||
      column.values.size() != channel.values.size())
    return false;
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    if (!same_bits(column.values[i], in_unit(channel.values[i], channel.unit))) return false;
  return true;
}

}  // namespace

std::string lost_in_writing(const Recording& recording, const Facts& facts,
                            const RawRecording& back, const Problems& problems) {
  if (problems.count() > 0) return problems.messages().front();
  if (back.columns.size() != recording.channels.size())
    return fmt::format("{} of {} channels read back", back.columns.size(),
                       recording.channels.size());
  for (std::size_t i = 0; i < back.columns.size(); ++i)
    if (!holds(back.columns[i], recording.channels[i]))
      return fmt::format("the channel {} does not read back as written",
                         recording.channels[i].name);
  if (back.facts != facts) return "the facts do not read back as written";
  return {};
}

}  // namespace drift
