#include "core/recording/own/format_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/nearest.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/header.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

using config::Option;
using config::Report;
using config::Section;

/// The members of a table of the user's own names; empty, with an error, if it is no table.
const std::vector<config::Member>& members(Section& section, std::string_view key,
                                           std::string_view example) {
  static const std::vector<config::Member> none;
  const std::string expected = "a table";
  const config::Node* node = section.take(key, Section::Kind::table, expected);
  if (node == nullptr) return none;
  if (node->is(config::Node::Kind::table)) return node->members;
  section.report().error(node->at,
                         fmt::format("'{}' is {} (expected {}). Write {}", section.full(key),
                                     describe(*node), expected, example));
  return none;
}

/// Whether a name may stand on the left of columns and offset.
bool check_channel(Section& section, std::string_view table, const config::Member& member,
                   RecordingKind kind) {
  const auto all = canonical_channels(kind);
  if (std::ranges::find(all, member.key) != all.end()) return true;
  auto meant = meant_channels(member.key, all);
  const std::string alias = guessed_channel(member.key);  // "accel_x", "inner", "temp"
  if (const auto known = std::ranges::find(all, alias); meant.empty() && known != all.end())
    meant.push_back(*known);
  if (meant.empty() && valid_channel_name(member.key)) return true;
  section.report().error(
      member.at,
      fmt::format("'{}.{}' is no channel (expected one of {}, or another name of letters, digits "
                  "and underscores for a covariate). {}",
                  section.full(table), member.key, fmt::join(all, ", "),
                  meant.empty() ? std::string("Correct it")
                                : fmt::format("Did you mean '{}'?", fmt::join(meant, "' or '"))));
  return false;
}

void read_columns(Section& section, RecordingKind kind, RecordingFormat& format) {
  constexpr std::string_view example = "columns = { acc_x = \"Ax [m/s^2]\" }";
  for (const auto& member : members(section, "columns", example)) {
    const std::string key = section.full(fmt::format("columns.{}", member.key));
    if (!check_channel(section, "columns", member, kind)) continue;
    const config::Node& value = member.value;
    std::string_view text = value.is(config::Node::Kind::string) ? trimmed(value.text) : "";
    const bool minus = text.starts_with('-');
    const HeaderCell cell = header_cell(minus ? text.substr(1) : text);
    if (cell.name.empty() || cell.open) {
      section.report().error(
          value.at, fmt::format("'{}' is {} (expected a header of the file with its unit, such as "
                                "\"Ax [m/s^2]\", with a leading - to change the sign). Correct it",
                                key, describe(value)));
      continue;
    }
    if (cell.unit && !parse_recording_unit(*cell.unit) && known_quantity(member.key)) {
      section.report().error(
          value.at,
          fmt::format("'{}' = \"{}\" has the unknown unit '{}' (expected {}). Correct the "
                      "unit",
                      key, value.text, *cell.unit, known_quantity(member.key)->words));
      continue;
    }
    for (const MappedColumn& other : format.columns)
      if (other.own == cell.name)
        section.report().error(
            value.at,
            fmt::format("'{}' and '{}' name the same column '{}' (expected one channel for "
                        "each column). Remove one",
                        section.full("columns." + other.channel), key, cell.name));
    format.columns.push_back({member.key, cell.name, cell.unit, minus ? -1.0 : 1.0});
    section.report().given(key, value.text, member.at);
  }
}

void read_positions(Section& section, const std::vector<std::string>& names,
                    RecordingFormat& format) {
  const auto most = static_cast<std::int64_t>(names.size());
  for (const auto& member : members(section, "positions", "positions = { \"x up\" = 1 }")) {
    const std::string key = section.full(fmt::format("positions.\"{}\"", member.key));
    const config::Node& value = member.value;
    const auto named =
        value.is(config::Node::Kind::string) ? std::ranges::find(names, value.text) : names.end();
    std::int64_t number = -1;
    if (value.is(config::Node::Kind::integer) && value.integer >= 0 && value.integer <= most)
      number = value.integer;
    if (named != names.end()) number = named - names.begin() + 1;
    if (number < 0) {
      const std::vector<std::string_view> known(names.begin(), names.end());
      section.report().error(value.at,
                             fmt::format("'{}' is {} (expected a position of the plan: 1 to {}, or "
                                         "its name, or 0 where it is turned). {}",
                                         key, describe(value), most,
                                         value.is(config::Node::Kind::string)
                                             ? config::suggestion(value.text, known, "Correct it")
                                             : "Correct it"));
      continue;
    }
    format.positions.emplace_back(member.key, static_cast<int>(number));
    section.report().given(key, config::to_toml(value), member.at);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    format.positions.emplace_back(names[i], static_cast<int>(i + 1));
}

void read_offsets(Section& section, RecordingKind kind, RecordingFormat& format) {
  for (const auto& member : members(section, "offset", "offset = { gimbal_inner = \"90 deg\" }")) {
    if (!check_channel(section, "offset", member, kind)) continue;
    const std::string key = section.full(fmt::format("offset.{}", member.key));
    const auto quantity = known_quantity(member.key);
    const Option option{
        .key = member.key, .unit = quantity ? quantity->unit : unit::one, .difference = true};
    const auto q = config::read_quantity(section.report(), member.value, key, option);
    if (!q) continue;
    format.offsets.push_back({member.key, q->si(), q->unit.dim});
    section.report().given(key, config::to_toml(member.value), member.at);
  }
}

/// A list of texts; `numbers`: a number is one, too.
std::vector<std::string> read_names(Section& section, std::string_view key,
                                    const std::string& expected, std::string_view example,
                                    bool numbers = false) {
  std::vector<std::string> names;
  const config::Node* node = section.take(key, Section::Kind::list, expected);
  if (node == nullptr) return names;
  const auto is_text = [&](const config::Node& item) {
    return item.is(config::Node::Kind::string) ||
           (numbers && (item.is(config::Node::Kind::integer) || item.is(config::Node::Kind::real)));
  };
  if (!node->is(config::Node::Kind::array) || !std::ranges::all_of(node->items, is_text)) {
    section.report().error(
        node->at, fmt::format("'{}' is {} (expected {}). Write {} = [\"{}\"]", section.full(key),
                              describe(*node), expected, key, example));
    return names;
  }
  for (const config::Node& item : node->items)
    names.push_back(item.is(config::Node::Kind::string) ? std::string(trimmed(item.text))
                                                        : config::to_toml(item));
  section.report().given(section.full(key), config::to_toml(*node), node->at);
  return names;
}

/// Names for the columns of a file without a header row: all of them, each its own.
void read_header(Section& section, RecordingFormat& format) {
  format.header = read_names(section, "header", "a list of names for the columns", "wx");
  for (std::size_t i = 0; i < format.header.size(); ++i)
    if (format.header[i].empty() ||
        std::find(format.header.begin(), format.header.begin() + static_cast<std::ptrdiff_t>(i),
                  format.header[i]) != format.header.begin() + static_cast<std::ptrdiff_t>(i))
      section.report().error(
          section.take("header")->at,
          fmt::format(
              "'{}' has \"{}\" as name {} (expected a name for every column, each its own). "
              "Correct it",
              section.full("header"), format.header[i], i + 1));
}

/// The header of one column; the key may be left out.
void read_own_header(Section& section, const Option& option, std::string& header) {
  if (section.has(option.key))
    section.read(option, header);
  else
    section.take(option.key, Section::Kind::text, config::expected_text());
}

/// Keys of time that do not go together.
void check_time(Section& section, const RecordingFormat& format) {
  const auto error = [&](std::string_view key, const std::string& text) {
    section.report().error(section.take(key)->at, fmt::format("'{}' {}", section.full(key), text));
  };
  const bool mapped =
      std::ranges::find(format.columns, "time", &MappedColumn::channel) != format.columns.end();
  for (const std::string_view key : {"wrap", "tick"})
    if (section.has(key) && format.counter.empty())
      error(key,
            "is given without a counter (expected counter = \"its header\" beside it). Add it, "
            "or remove the line");
  if (!format.counter.empty() && !format.tick && !format.rate)
    error("counter",
          "is given without the length of a count (expected tick = \"100 us\", or rate = "
          "\"100 Hz\" where it counts rows). Add one");
  if (!format.date.empty() && (format.rate || !format.counter.empty()))
    error("date", fmt::format("is given together with {} (expected a column of times of day "
                              "beside it). Remove one",
                              format.rate ? "rate" : "counter"));
  if (format.tick && format.rate)
    error("tick", "is given together with rate (expected one of them). Remove one");
  if (mapped && (format.rate || !format.counter.empty()))
    error(format.counter.empty() ? "rate" : "counter",
          "is given together with a column of time (expected one of them). Remove one");
}

/// Of a case it is the gyros that turn the platform, row by row: shifts are a platform's alone.
void check_instants(Section& section, RecordingKind kind, const RecordingFormat& format) {
  if (kind == RecordingKind::platform) return;
  const auto refuse = [&](std::string_view key) {
    section.report().error(
        section.take(key)->at,
        fmt::format("'{}' is of a platform's recording (expected none for "
                    "sensors fixed to a case: their accelerometers are means, "
                    "and the term accelerometer_delay is their delay). Remove it",
                    section.full(key)));
  };
  if (format.accelerometers == AccelerometerReading::momentary) refuse("accelerometers");
  if (format.accelerometers_late) refuse("accelerometers_late");
  if (format.gimbals_late) refuse("gimbals_late");
}

}  // namespace

RecordingFormat read_recording_format(Section section, RecordingKind kind,
                                      const std::vector<std::string>& positions) {
  RecordingFormat format;
  if (section.present()) {
    read_columns(section, kind, format);
    read_offsets(section, kind, format);
    format.ignore = read_names(section, "ignore", "a list of headers of the file", "Datum");
    format.missing =
        read_names(section, "missing", "a list of what stands for not measured", "-9999", true);
    read_header(section, format);
    section.read(Option{.key = "delimiter", .doc = "between cells"}, format.delimiter, delimiters);
    section.read(Option{.key = "decimal", .doc = "mark within numbers"}, format.decimal,
                 decimal_marks);
    section.read(Option{.key = "angles", .doc = "digits of angles in degrees"}, format.angles,
                 angle_digits);
    section.read_options(format);
    read_own_header(section, Option{.key = "counter", .doc = "header of a counter"},
                    format.counter);
    read_own_header(section, Option{.key = "date", .doc = "header of the dates of times of day"},
                    format.date);
    section.read(Option{.key = "kind", .doc = "what a sample is"}, format.kind, sample_kinds);
    if (format.kind != SampleKind::rates && kind == RecordingKind::platform)
      section.report().error(section.take("kind")->at,
                             fmt::format("'{}' = \"{}\" is for sensors fixed to a case "
                                         "(expected \"rates\" for a platform). Remove it",
                                         section.full("kind"), name_in(sample_kinds, format.kind)));
    section.read(Option{.key = "accelerometers", .doc = "what those of a platform's row are"},
                 format.accelerometers, accelerometer_readings);
    check_instants(section, kind, format);
    if (format.decimal == DecimalMark::comma && format.delimiter == Delimiter::comma)
      section.report().error(section.take("decimal")->at,
                             fmt::format("'{}' and '{}' are both a comma (expected two marks). "
                                         "Correct one",
                                         section.full("decimal"), section.full("delimiter")));
    check_time(section, format);
  }
  read_positions(section, positions, format);
  section.finish();
  return format;
}

}  // namespace drift
