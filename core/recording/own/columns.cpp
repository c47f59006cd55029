#include "core/recording/own/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/nearest.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

using Role = ColumnUse::Role;

Role role_of(std::string_view channel, RecordingKind kind) {
  if (channel == "time") return Role::time;
  if (kind == RecordingKind::platform && channel == "position") return Role::position;
  if (kind == RecordingKind::platform && channel == "phase") return Role::phase;
  return is_covariate(channel, kind) ? Role::covariate : Role::sensor;
}

std::string listed(const std::vector<HeaderCell>& header) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;
  for (const HeaderCell& c : header)
    if (!c.whole.empty() && names.size() < most) names.push_back(c.whole);
  return fmt::format("{}{}", fmt::join(names, ", "), header.size() > most ? ", ..." : "");
}

class Assignment {
 public:
  Assignment(const std::vector<HeaderCell>& header, const RecordingFormat& format,
             RecordingKind kind, Problems& problems)
      : header_(header), format_(format), kind_(kind), problems_(problems) {}

  std::vector<ColumnUse> assign() {
    require_own_names();
    for (const HeaderCell& cell : header_) uses_.push_back(use_of(cell));
    settle_others();
    return std::move(uses_);
  }

  std::vector<std::string> renamed;

 private:
  const MappedColumn* mapping(const HeaderCell& cell) const {
    const auto it = std::ranges::find_if(
        format_.columns, [&](const MappedColumn& m) { return is_called(cell, m.own); });
    return it == format_.columns.end() ? nullptr : &*it;
  }

  void require(const std::string& own, const std::string& key) {
    if (own.empty()) return;
    const auto count =
        std::ranges::count_if(header_, [&](const HeaderCell& c) { return is_called(c, own); });
    if (count == 1) return;
    if (count > 1) {
      problems_.add(in_quotes(own), fmt::format("{} columns are called that", count),
                    fmt::format("one column for {} of the study file", key),
                    "Rename the others, or give the whole header with its unit");
      return;
    }
    missing_.emplace_back(own, key);
  }

  /// Names that the file does not have are one problem.
  void report_missing() {
    if (missing_.empty()) return;
    std::vector<std::string_view> names;
    for (const HeaderCell& c : header_) names.push_back(c.name);
    std::vector<std::string> own, keys;
    for (const auto& [name, key] : missing_) {
      own.push_back(in_quotes(name));
      keys.push_back(key);
    }
    problems_.add("",
                  fmt::format("there is no column {}, which the study file names ({})",
                              fmt::join(own, ", "), fmt::join(keys, ", ")),
                  fmt::format("one of: {}", listed(header_)),
                  own.size() == 1 ? config::suggestion(missing_.front().first, names,
                                                       "Correct the name in [recording]")
                                  : "Correct the names in [recording], or is it another file?");
  }

  void require_own_names() {
    for (const MappedColumn& m : format_.columns)
      require(m.own, fmt::format("recording.columns.{}", m.channel));
    require(format_.counter, "recording.counter");
    report_missing();
  }

  ColumnUse use_of(const HeaderCell& cell) {
    const auto called = [&](const std::string& own) { return is_called(cell, own); };
    if (called(format_.counter)) return {Role::counter, "counter", {}, 1.0};
    if (std::ranges::any_of(format_.ignore, called)) return {Role::ignored, cell.whole, {}, 1.0};
    if (const MappedColumn* m = mapping(cell)) return mapped(cell, *m);
    if (is_channel(cell.name)) return {role_of(cell.name, kind_), cell.name, cell.unit, 1.0};
    return {Role::covariate, "", cell.unit, 1.0};  // its name is settled when all are known
  }

  ColumnUse mapped(const HeaderCell& cell, const MappedColumn& m) {
    ColumnUse use{role_of(m.channel, kind_), m.channel, m.unit ? m.unit : cell.unit, m.sign};
    if (!m.unit || !cell.unit) return use;
    const auto given = parse_recording_unit(*m.unit), written = parse_recording_unit(*cell.unit);
    if (given && written && (given->dim != written->dim || given->to_si != written->to_si))
      problems_.add(in_quotes(cell.whole),
                    fmt::format("the file says [{}], recording.columns.{} says [{}]", *cell.unit,
                                m.channel, *m.unit),
                    "one unit",
                    "Correct the one that is wrong, or leave the unit out of [recording]");
    return use;
  }

  bool is_channel(const std::string& name) const {
    const auto all = canonical_channels(kind_);
    return std::ranges::find(all, name) != all.end() || known_quantity(name).has_value();
  }

  bool is_used(std::string_view channel) const {
    return std::ranges::find(uses_, channel, &ColumnUse::channel) != uses_.end();
  }

  /// Headers that are no channel: slips of the pen are asked about, the others are covariates.
  void settle_others() {
    std::vector<std::string_view> absent;
    for (const auto channel : canonical_channels(kind_))
      if (!is_used(channel)) absent.push_back(channel);
    if (format_.rate || !format_.counter.empty()) std::erase(absent, "time");
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      if (!uses_[i].channel.empty()) continue;
      const HeaderCell& cell = header_[i];
      if (const auto meant = meant_channels(cell.name, absent); !meant.empty())
        problems_.add(
            in_quotes(cell.whole), "this channel is not known",
            fmt::format("'{}', or a name that is not so close to it", fmt::join(meant, "' or '")),
            fmt::format("Did you mean '{}'? Rename the column, or name it in [recording] "
                        "of the study file: columns = {{ {} = \"{}\" }}, or ignore = "
                        "[\"{}\"]",
                        fmt::join(meant, "' or '"), meant.front(), cell.whole, cell.name));
      std::string name = cell.name.empty() ? std::string() : cell.name;
      if (!valid_channel_name(name)) {
        name = plain_channel_name(cell.name);
        while (is_used(name)) name += "_2";
        if (!cell.name.empty())
          renamed.push_back(fmt::format("{} as {}", in_quotes(cell.name), name));
      }
      uses_[i].channel = name;
    }
  }

  const std::vector<HeaderCell>& header_;
  const RecordingFormat& format_;
  RecordingKind kind_;
  Problems& problems_;
  std::vector<ColumnUse> uses_;
  std::vector<std::pair<std::string, std::string>> missing_;  ///< header, key of the study file
};

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

RawColumn time_column(std::vector<double> values) {
  RawColumn time;
  time.name = "time";
  time.unit = "s";
  time.values = std::move(values);
  return time;
}

}  // namespace

std::vector<ColumnUse> uses_of_columns(const std::vector<HeaderCell>& header,
                                       const RecordingFormat& format, RecordingKind kind,
                                       Problems& problems, std::vector<std::string>& remarks) {
  Assignment assignment(header, format, kind, problems);
  auto uses = assignment.assign();
  if (!assignment.renamed.empty())
    remarks.push_back(
        fmt::format("columns under another name: {}", fmt::join(assignment.renamed, ", ")));
  return uses;
}

RawRecording with_channels(RawRecording raw, const std::vector<ColumnUse>& uses,
                           const RecordingFormat& format, Problems& problems) {
  RawRecording out;
  out.facts = std::move(raw.facts);
  out.remarks = std::move(raw.remarks);
  out.kind = format.kind;
  out.settled = raw.settled;
  const RawColumn* counter = nullptr;
  std::vector<std::string> texts;
  const bool own_time = format.rate || !format.counter.empty();
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (uses[i].role == Role::counter) counter = &raw.columns[i];
  if (own_time && (counter != nullptr || format.counter.empty()))
    out.columns.push_back(time_column(time_of(raw, counter, format, problems)));
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const ColumnUse& use = uses[i];
    RawColumn& column = raw.columns[i];
    if (use.role == Role::ignored || use.role == Role::counter) continue;
    if (own_time && use.channel == "time") {
      out.remarks.push_back(fmt::format("{}: left out, time comes from {} of the study file",
                                        in_quotes(column.name),
                                        format.rate ? "recording.rate" : "recording.counter"));
      continue;
    }
    if (use.role == Role::covariate && column.texts > 0) {
      if (column.numbers == 0) {
        texts.push_back(in_quotes(column.name));
        continue;
      }
      out.remarks.push_back(fmt::format("{}: {} cells hold text and are taken as not measured",
                                        use.channel, column.texts));
    }
    if (column.name.empty() && column.numbers == 0) continue;  // a superfluous delimiter
    const auto offset = std::ranges::find(format.offsets, use.channel, &ChannelOffset::channel);
    if (!column.clock) column.unit = use.unit;
    column.name = use.channel;
    column.sign = use.sign;
    if (offset != format.offsets.end()) column.offset = *offset;
    out.columns.push_back(std::move(column));
  }
  if (!texts.empty())
    out.remarks.push_back(
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
