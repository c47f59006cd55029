#include "core/recording/own/recording_unit.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

/// Another spelling of a factor, and what it stands for.
struct Alias {
  std::string_view written, known;
  double scale = 1.0;
};

/// Characters and words that stand for others, longest first where one begins another.
constexpr std::pair<std::string_view, std::string_view> spellings[] = {
    {"\u00B0C", "degC"},  {"\u00B0", "deg"},    {"\u00B5", "u"}, {"\u03BC", "u"},
    {"\u00B2", "^2"},     {"\u00B3", "^3"},     {"\u00B7", "*"}, {"\u22C5", "*"},
    {"\u2033", "arcsec"}, {"\u2032", "arcmin"}, {"**", "^"}};
constexpr std::pair<std::string_view, std::string_view> wholes[] = {
    {"m s^-2", "m/s^2"},   {"m s-2", "m/s^2"},    {"m*s^-2", "m/s^2"},  {"m.s-2", "m/s^2"},
    {"rad s^-1", "rad/s"}, {"rad*s^-1", "rad/s"}, {"rad s-1", "rad/s"}, {"deg s^-1", "deg/s"},
    {"deg*s^-1", "deg/s"}, {"deg s-1", "deg/s"},  {"dps", "deg/s"},     {"dph", "deg/h"}};
constexpr Alias aliases[] = {{"sec", "s"},
                             {"second", "s"},
                             {"seconds", "s"},
                             {"msec", "ms"},
                             {"us", "s", 1e-6},
                             {"usec", "s", 1e-6},
                             {"ns", "s", 1e-9},
                             {"hr", "h"},
                             {"hour", "h"},
                             {"hours", "h"},
                             {"minute", "min"},
                             {"minutes", "min"},
                             {"degree", "deg"},
                             {"degrees", "deg"},
                             {"mdeg", "deg", 1e-3},
                             {"radian", "rad"},
                             {"radians", "rad"},
                             {"C", "degC"},
                             {"Celsius", "degC"},
                             {"Kelvin", "K"},
                             {"kelvin", "K"},
                             {"degK", "K"},
                             {"degF", "K", 1.0 / 1.8},
                             {"F", "K", 1.0 / 1.8},
                             {"Fahrenheit", "K", 1.0 / 1.8},
                             {"gon", "deg", 0.9},
                             {"Gauss", "gauss"},
                             {"mgauss", "gauss", 1e-3},
                             {"nT", "T", 1e-9},
                             {"ft", "m", 0.3048},
                             {"asec", "arcsec"},
                             {"mas", "arcsec", 1e-3},
                             {"rev", "turn"},
                             {"revs", "turn"},
                             {"days", "h", 24.0},
                             {"Gal", "m/s^2", 1e-2},
                             {"gal", "m/s^2", 1e-2},
                             {"mGal", "m/s^2", 1e-5},
                             // As laboratories of other languages write them.
                             {"Sek", "s"},
                             {"Sekunden", "s"},
                             {"secondi", "s"},
                             {"segundos", "s"},
                             {"secondes", "s"},
                             {"Minuten", "min"},
                             {"minuti", "min"},
                             {"minutos", "min"},
                             {"Std", "h"},
                             {"Stunden", "h"},
                             {"ore", "h"},
                             {"horas", "h"},
                             {"heures", "h"},
                             {"Tage", "h", 24.0},
                             {"giorni", "h", 24.0},
                             {"dias", "h", 24.0},
                             {"jours", "h", 24.0},
                             {"gradi", "deg"},
                             {"grados", "deg"},
                             {"giri", "turn"},
                             {"Umdrehungen", "turn"}};

std::string respelt(std::string_view text) {
  std::string out(text);
  for (const auto& [from, to] : spellings)
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
  for (const auto& [from, to] : wholes)
    if (out == from) return std::string(to);
  std::erase(out, ' ');
  return out;
}

bool is_base(std::string_view symbol) {
  return symbol != "1" && parse_unit(symbol) && symbol.find_first_of("*/^(") == std::string::npos;
}

/// One factor in the program's spelling, and how many of those it is; the power is kept.
std::pair<std::string, double> known_factor(std::string_view factor) {
  std::string_view symbol = factor.substr(0, factor.find('^')),
                   power = factor.substr(symbol.size());
  std::string kept(power);
  if (power.empty() && symbol.size() > 1 && symbol.back() >= '2' && symbol.back() <= '3') {
    kept = std::string("^") + symbol.back();
    symbol.remove_suffix(1);
  }
  const int times = kept.empty() ? 1 : kept.back() - '0';
  if (is_base(symbol)) return {std::string(symbol) + kept, 1.0};
  for (const Alias& a : aliases)
    if (a.written == symbol) return {std::string(a.known) + kept, std::pow(a.scale, times)};
  return {std::string(factor), 1.0};
}

/// A unit in any spelling, without a number before it.
std::optional<Unit> parse_spelling(std::string_view text) {
  if (const auto known = parse_unit(text)) return known;
  const std::string plain = respelt(text);
  std::string symbol;
  double scale = 1.0;
  int sign = 1;
  for (std::size_t begin = 0; begin <= plain.size();) {
    const auto end = std::min(plain.find_first_of("*/", begin), plain.size());
    const auto [factor, size] = known_factor(std::string_view(plain).substr(begin, end - begin));
    symbol += factor;
    scale *= sign > 0 ? size : 1.0 / size;
    if (end == plain.size()) break;
    sign = plain[end] == '/' ? -1 : 1;
    symbol += plain[end];
    begin = end + 1;
  }
  auto unit = parse_unit(symbol);
  if (!unit || scale == 1.0) return unit;
  if (text.size() > Name::capacity) return std::nullopt;
  return Unit{Name(text), unit->to_si * scale, unit->dim};
}

}  // namespace

std::optional<Unit> parse_recording_unit(std::string_view whole) {
  const std::string_view text = trimmed(whole);
  if (const auto unit = parse_spelling(text)) return unit;
  std::string number(text);
  if (const auto comma = number.find(','); comma != std::string::npos) number[comma] = '.';
  double size = 0.0;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, size);
  if (error != std::errc() || stop == end || !(size > 0.0) || !std::isfinite(size)) return {};
  std::string_view rest = trimmed(text.substr(static_cast<std::size_t>(stop - number.data())));
  if (rest.starts_with('*')) rest = trimmed(rest.substr(1));
  const auto unit = parse_spelling(rest);
  if (!unit || text.size() > Name::capacity) return std::nullopt;
  return Unit{Name(text), size * unit->to_si, unit->dim};
}

bool same_unit(const Unit& a, const Unit& b) {
  return a.dim == b.dim && a.to_si == b.to_si && celsius_offset(a) == celsius_offset(b);
}

}  // namespace drift
