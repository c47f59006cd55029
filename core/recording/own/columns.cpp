#include "core/recording/own/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/config/nearest.hpp"
#include "core/recording/own/like_temperature.hpp"
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

constexpr std::array<std::string_view, 10> parts_of_a_degree{
    "min", "'", "\u2032", "arcmin", "minutes", "s", "sec", "\u2033", "arcsec", "seconds"};

/// A header without its unit, and the unit, that of an ending too: "outer min".
std::pair<std::string, std::string> name_and_unit(const HeaderCell& cell) {
  if (cell.unit) return {cell.name, *cell.unit};
  const auto last = cell.name.find_last_of(" _");
  if (last == std::string::npos) return {};
  return {cell.name.substr(0, last), cell.name.substr(last + 1)};
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
    if (report_split_angles()) return {};
    require_own_names();
    for (const HeaderCell& cell : header_) uses_.push_back(use_of(cell));
    report_contradictions();
    settle_others();
    return std::move(uses_);
  }

  std::vector<std::string> renamed;
  std::vector<HeaderCell> temperatures;  ///< that look like one and are mapped as nothing

 private:
  const MappedColumn* mapping(const HeaderCell& cell) const {
    const auto it = std::ranges::find_if(
        format_.columns, [&](const MappedColumn& m) { return is_called(cell, m.own); });
    return it == format_.columns.end() ? nullptr : &*it;
  }

  bool is_left_out(const HeaderCell& cell) const {
    return std::ranges::any_of(format_.ignore,
                               [&](const std::string& own) { return is_called(cell, own); });
  }

  /// An angle in three columns, degrees, minutes and seconds: the degrees alone would be read.
  bool report_split_angles() {
    std::map<std::string, std::vector<const HeaderCell*>> degrees, parts;  // by the name of all
    for (const HeaderCell& cell : header_) {
      const auto [name, unit] = name_and_unit(cell);
      const bool part = std::ranges::find(parts_of_a_degree, unit) != parts_of_a_degree.end();
      if (name.empty() || is_left_out(cell)) continue;
      if (part)
        parts[name].push_back(&cell);
      else if (const auto known = parse_recording_unit(unit); known && same_unit(*known, unit::deg))
        degrees[name].push_back(&cell);
    }
    std::vector<std::string> split;
    for (const auto& [name, cells] : degrees)
      if (parts[name].size() == 2) {
        split.push_back(in_quotes(cells.front()->whole));
        for (const HeaderCell* cell : parts[name]) split.push_back(in_quotes(cell->whole));
      }
    if (split.empty()) return false;
    problems_.add(fmt::format("{}", fmt::join(split, ", ")),
                  "angles in degrees, minutes and seconds", "one column for each angle",
                  "Write them in decimal degrees; or, if the others are something else, leave them "
                  "out with ignore in [recording]");
    return true;
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
    for (const HeaderCell& c : header_)
      if (mapping(c) == nullptr) names.push_back(c.name);
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
    require(format_.date, "recording.date");
    report_missing();
  }

  ColumnUse use_of(const HeaderCell& cell) {
    const auto called = [&](const std::string& own) { return is_called(cell, own); };
    if (called(format_.counter)) return {Role::counter, "counter", {}, 1.0};
    if (called(format_.date)) return {Role::date, "date", {}, 1.0};
    if (is_left_out(cell)) return {Role::ignored, cell.whole, {}, 1.0};
    if (const MappedColumn* m = mapping(cell)) return mapped(cell, *m);
    if (is_channel(cell.name)) return {role_of(cell.name, kind_), cell.name, cell.unit, 1.0};
    return {Role::covariate, "", cell.unit, 1.0};  // its name is settled when all are known
  }

  ColumnUse mapped(const HeaderCell& cell, const MappedColumn& m) {
    ColumnUse use{role_of(m.channel, kind_), m.channel, m.unit ? m.unit : cell.unit, m.sign};
    if (!m.unit || !cell.unit || names_unit_too(cell, m.own)) return use;
    const auto given = parse_recording_unit(*m.unit), written = parse_recording_unit(*cell.unit);
    // What stands in brackets in the file may be a word, and no unit.
    if (given && written && !same_unit(*given, *written)) contradictions_.push_back({&cell, &m});
    return use;
  }

  /// Columns whose unit is one in the file and another in the study file: one mistake for all
  /// that have the same two.
  void report_contradictions() {
    for (std::size_t i = 0; i < contradictions_.size(); ++i) {
      const Contradiction& first = contradictions_[i];
      std::vector<std::string> columns, keys;
      bool said = false;
      for (std::size_t k = 0; k < contradictions_.size(); ++k) {
        const Contradiction& c = contradictions_[k];
        if (c.cell->unit != first.cell->unit || c.mapped->unit != first.mapped->unit) continue;
        said = said || k < i;
        columns.push_back(in_quotes(c.cell->whole));
        keys.push_back("recording.columns." + c.mapped->channel);
      }
      if (said) continue;
      const std::string &in_file = *first.cell->unit, &in_study = *first.mapped->unit;
      problems_.add(
          fmt::format("{}", fmt::join(columns, ", ")),
          fmt::format("the file says [{}], {} say{} [{}]", in_file, fmt::join(keys, ", "),
                      keys.size() == 1 ? "s" : "", in_study),
          "one unit",
          fmt::format("Correct the one that is wrong, or leave the unit out of [recording]; if the "
                      "file is wrong, overrule it: {} = \"{} [{}] [{}]\"",
                      first.mapped->channel, first.cell->name, in_file, in_study));
    }
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
      // One that a term follows by its name would be lost to it as the temperature.
      const bool followed = std::ranges::find(format_.of_terms, name) != format_.of_terms.end();
      if (looks_like_temperature(cell) && !followed) temperatures.push_back(cell);
    }
    if (is_used("temperature")) temperatures.clear();
  }

  struct Contradiction {
    const HeaderCell* cell;
    const MappedColumn* mapped;
  };

  const std::vector<HeaderCell>& header_;
  const RecordingFormat& format_;
  RecordingKind kind_;
  Problems& problems_;
  std::vector<ColumnUse> uses_;
  std::vector<Contradiction> contradictions_;
  std::vector<std::pair<std::string, std::string>> missing_;  ///< header, key of the study file
};

}  // namespace

std::vector<ColumnUse> uses_of_columns(const std::vector<HeaderCell>& header,
                                       const RecordingFormat& format, RecordingKind kind,
                                       Problems& problems, RawRecording& raw) {
  Assignment assignment(header, format, kind, problems);
  auto uses = assignment.assign();
  if (!assignment.renamed.empty())
    raw.remarks.add(Weight::note, fmt::format("columns under another name: {}",
                                              fmt::join(assignment.renamed, ", ")));
  if (!assignment.temperatures.empty()) {
    raw.unmapped_temperature = unmapped_temperature_remark(assignment.temperatures);
    raw.remarks.add(Weight::doubtful, raw.unmapped_temperature);
  }
  return uses;
}

}  // namespace drift
