#include "core/recording/own/header.hpp"

#include <algorithm>
#include <array>

#include "core/config/nearest.hpp"
#include "core/params/covariates.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

/// Letters and digits alone, in lower case: "Acc-X" and "acc_x" are the same word.
std::string bare(std::string_view name) {
  std::string out = lower_case(name);
  std::erase_if(out, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
  return out;
}

/// Whether a slash stands within a unit ("deg/h", "omega deg/h", "v_m/s") and not between a
/// quantity and its unit: "T/K" is the symbol of a quantity in K, and no column is called by a unit
/// alone.
bool is_in_unit(std::string_view name, std::string_view unit) {
  const auto before = name.find_last_of(" _.-");
  const std::string_view word = before == std::string_view::npos ? name : name.substr(before + 1);
  if (name.size() == 1 || !parse_recording_unit(std::string(word) + "/" + std::string(unit)))
    return false;
  // Of one letter behind a name ("phi_m/deg") it is one where something is measured by time.
  const Dimension by = parse_recording_unit(unit)->dim;
  return word.size() > 1 || by == "s"_unit.dim || by == "s^2"_unit.dim;
}

/// "Zeit / s", "Zeit in s", "Zeit, s" and "t/s" are the name and its unit.
void split_off_unit(HeaderCell& cell) {
  const auto split_at = [&](std::size_t end, std::size_t between) {
    const std::string_view name = trimmed(std::string_view(cell.name).substr(0, end)),
                           unit = trimmed(std::string_view(cell.name).substr(end + between));
    if (name.empty() || !parse_recording_unit(unit)) return false;
    if (between == 1 && is_in_unit(name, unit)) return false;
    cell.unit = std::string(unit);
    cell.name = std::string(name);
    return true;
  };
  for (const std::string_view between : {" / ", " in ", ", "})
    if (const auto end = cell.name.rfind(between);
        end != std::string::npos && split_at(end, between.size()))
      return;
  for (auto end = cell.name.find('/'); end != std::string::npos; end = cell.name.find('/', end + 1))
    if (split_at(end, 1)) return;
}

/// Without the slash before a unit in brackets: "omega/(deg/h)".
std::string_view without_slash(std::string_view name) {
  return name.size() > 1 && name.ends_with('/') ? trimmed(name.substr(0, name.size() - 1)) : name;
}

}  // namespace

HeaderCell header_cell(std::string_view text) {
  HeaderCell cell;
  text = trimmed(text);
  cell.whole = text;
  // The last one: "T [K] [degC]" is the column "T [K]" with another unit.
  const auto bracket = text.ends_with(']') ? text.rfind('[') : text.find('[');
  const bool round = bracket == std::string_view::npos && text.ends_with(')');
  const auto at = round ? text.rfind('(') : bracket;
  cell.name = trimmed(text.substr(0, at));
  if (at == std::string_view::npos) {
    split_off_unit(cell);
    return cell;
  }
  if (text.back() == (round ? ')' : ']')) {
    cell.unit = trimmed(text.substr(at + 1, text.size() - at - 2));
    cell.name = std::string(without_slash(cell.name));
  } else {
    cell.open = true;
  }
  return cell;
}

bool is_called(const HeaderCell& cell, std::string_view own) {
  return !own.empty() && (cell.whole == own || cell.name == own || names_unit_too(cell, own));
}

bool names_unit_too(const HeaderCell& cell, std::string_view own) {
  if (!cell.unit || own == cell.name) return false;
  const HeaderCell said = header_cell(own);
  return said.name == cell.name && said.unit == cell.unit;
}

std::vector<std::string_view> canonical_channels(RecordingKind kind) {
  std::vector<std::string_view> all{"time"};
  const auto add = [&](const ChannelTriple& t) {
    all.insert(all.end(), t.names.begin(), t.names.end());
  };
  if (kind == RecordingKind::platform) {
    all.insert(all.end(), {"position", "phase"});
    add(channel_triples[0]);
    add(channel_triples[1]);
    add(channel_triples[2]);
    all.emplace_back("case_heading");
  } else {
    add(channel_triples[3]);
    add(channel_triples[0]);
  }
  all.insert(all.end(), covariate_columns.begin(), covariate_columns.end());
  return all;
}

bool is_known(const HeaderCell& cell, const RecordingFormat& format, RecordingKind kind) {
  const auto all = canonical_channels(kind);
  if (std::ranges::find(all, cell.name) != all.end() || is_called(cell, format.counter) ||
      is_called(cell, format.date))
    return true;
  const auto called = [&](const std::string& own) { return is_called(cell, own); };
  return std::ranges::any_of(format.columns, called, &MappedColumn::own) ||
         std::ranges::any_of(format.ignore, called);
}

std::vector<std::string_view> meant_channels(std::string_view name,
                                             const std::vector<std::string_view>& absent) {
  const std::string word = bare(name);
  std::vector<std::string_view> meant;
  for (const auto channel : absent)
    if (word == bare(channel)) meant.push_back(channel);
  if (!meant.empty()) return meant;
  double best = 0.0;
  for (const auto channel : absent) {
    // One slip, two in a long word; a name with a number of its own is another thing.
    const double enough = channel.size() >= 9 ? 2.0 : channel.size() >= 5 ? 1.0 : 0.9;
    const double cost = config::typing_distance(name, channel);
    if (cost > enough || (!meant.empty() && cost > best + 1e-9)) continue;
    if (meant.empty() || cost < best - 1e-9) meant.clear();
    best = cost;
    meant.push_back(channel);
  }
  return meant;
}

std::string folded(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 13> letters{
      {{"\u00E4", "ae"},
       {"\u00F6", "oe"},
       {"\u00FC", "ue"},
       {"\u00C4", "Ae"},
       {"\u00D6", "Oe"},
       {"\u00DC", "Ue"},
       {"\u00DF", "ss"},
       {"\u00E6", "ae"},
       {"\u0153", "oe"},
       {"\u00B5", "u"},
       {"\u00B0", "deg"},
       {"\u00BA", "deg"},
       {"\u00D7", "x"}}};
  std::string out(text);
  for (const auto& [from, to] : letters)
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
  // U+00C0 to U+00FF are C3 80 to C3 BF.
  constexpr std::string_view bases =
      "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYTsaaaaaaaceeeeiiiidnooooo_ouuuuyty";
  for (std::size_t at = 0; (at = out.find('\xC3', at)) != std::string::npos; ++at)
    if (at + 1 < out.size() && (out[at + 1] & '\xC0') == '\x80')
      out.replace(at, 2, 1, bases[static_cast<unsigned char>(out[at + 1]) - 0x80u]);
  // Accents that follow their letter, U+0300 to U+036F, as some systems write them.
  for (std::size_t at = 0; (at = out.find_first_of("\xCC\xCD", at)) != std::string::npos;)
    out.erase(at, 2);
  return out;
}

std::string plain_channel_name(std::string_view header) {
  const std::string text = folded(header);
  std::string out;
  for (const char c : text) {
    const bool fit = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (fit)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (out.ends_with('_')) out.pop_back();
  if (out.empty() || !((out[0] >= 'a' && out[0] <= 'z') || (out[0] >= 'A' && out[0] <= 'Z')))
    out.insert(0, "column_");
  out = out.substr(0, 50);
  if (!valid_channel_name(out)) out += "_column";
  return out;
}

}  // namespace drift
