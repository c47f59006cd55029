#include "core/recording/own/preamble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "core/base/utf8.hpp"
#include "core/recording/line_reader.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_values.hpp"
#include "core/recording/own/header.hpp"
#include "core/recording/own/text_decoding.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

constexpr std::size_t longest_preamble = 200;  // a preamble is not longer

constexpr std::string_view latitude_words[] = {
    "latitude",      "lat",     "breite",  "breitengrad", "geographische breite",
    "geogr. breite", "latitud", "breedte", "latitudine"};
constexpr std::string_view gravity_words[] = {
    "gravity",   "g",         "local gravity",      "schwere", "erdbeschleunigung",
    "pesanteur", "gravedad",  "fallbeschleunigung", "gravite", "schwerebeschleunigung",
    "gravita",   "ortsfaktor"};
constexpr std::string_view degrees[] = {"",     "deg",    "degree", "degrees", "\u00B0",
                                        "grad", "grados", "gradi",  "graden"};
constexpr std::string_view accelerations[] = {"",      "m/s^2", "m/s2", "m/s\u00B2",
                                              "m/s/s", "ms^-2", "ms-2"};

bool is_among(std::string_view word, std::span<const std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

/// One line as "word, number, unit".
struct Fact {
  std::string word;  ///< in lower case, without accents
  double number = 0.0;
  std::string unit;  ///< without blanks and brackets; of the word, or else behind the number
};

constexpr std::string_view between = ":=;,\t ";

/// Without anything of `what` at both ends.
std::string_view stripped(std::string_view text, std::string_view what) {
  const auto first = text.find_first_not_of(what);
  return first == std::string_view::npos
             ? std::string_view()
             : text.substr(first, text.find_last_not_of(what) - first + 1);
}

std::string without(std::string_view text, std::string_view what) {
  std::string out(text);
  std::erase_if(out, [&](char c) { return what.find(c) != std::string_view::npos; });
  return out;
}

std::optional<Fact> fact_in(const std::string& line) {
  const std::string plain = without(line, "\"");
  const std::string_view text = stripped(plain, "#%;!*/, \t");
  std::size_t at = text.find_first_of("+-0123456789");
  while (at != std::string_view::npos && at > 0 &&
         between.find(text[at - 1]) == std::string_view::npos)
    at = text.find_first_of("+-0123456789", at + 1);
  if (at == std::string_view::npos || at == 0) return std::nullopt;
  const std::string_view before = text.substr(0, at), word = stripped(before, between);
  const auto end = std::min(text.find_first_not_of("+-0123456789.,", at), text.size());
  const std::string_view number = stripped(text.substr(at, end - at), ".,");
  // A comma that divides cells is none within a number.
  if (before.substr(word.size()).find(',') != std::string_view::npos &&
      number.find(',') != std::string_view::npos)
    return std::nullopt;
  const ParsedCell parsed = parse_cell(number, DecimalMark::automatic);
  if (parsed.kind != ParsedCell::Kind::number || !std::isfinite(parsed.value)) return std::nullopt;
  Fact fact{lower_case(word), parsed.value,
            without(lower_case(stripped(text.substr(end), between)), " []()")};
  const auto open = fact.word.find_first_of("[(");
  if (open != std::string::npos && fact.unit.empty() &&
      (fact.word.ends_with(']') || fact.word.ends_with(')'))) {
    fact.unit = without(fact.word.substr(open), " []()");
    fact.word = std::string(trimmed(std::string_view(fact.word).substr(0, open)));
  }
  fact.word = folded(fact.word);
  return fact;
}

std::optional<std::string> latitude_of(Fact fact) {
  if (!is_among(fact.word, latitude_words)) return std::nullopt;
  if (!is_among(fact.unit, degrees)) {
    const char side = fact.unit.back();
    fact.unit.pop_back();
    if ((side != 'n' && side != 's') || !is_among(fact.unit, degrees) || fact.number < 0.0)
      return std::nullopt;
    if (side == 's') fact.number = -fact.number;
  }
  // 0 stands in forms that nobody filled in.
  if (std::abs(fact.number) > 90.0 || fact.number == 0.0) return std::nullopt;
  return fmt::format("{:.12g} deg", fact.number);
}

std::optional<std::string> gravity_of(const Fact& fact) {
  if (!is_among(fact.word, gravity_words) || !is_among(fact.unit, accelerations) ||
      fact.number < GuessLimits::gravity_low || fact.number > GuessLimits::gravity_high)
    return std::nullopt;
  return fmt::format("{:.12g} m/s^2", fact.number);
}

/// What all lines say, if they say one thing.
class TheOne {
 public:
  void add(const std::optional<std::string>& value, std::size_t line) {
    if (!value) return;
    differ_ = differ_ || (found_ && found_->value != *value);
    if (!found_) found_ = {*value, line};
  }
  std::optional<PreambleValue> get() const { return differ_ ? std::nullopt : found_; }

 private:
  std::optional<PreambleValue> found_;
  bool differ_ = false;
};

}  // namespace

PreambleSite preamble_site(const std::string& path, const CsvLayout& layout) {
  const std::size_t end = layout.header_line > 0 ? layout.header_line : longest_preamble;
  TheOne latitude, gravity;
  LineReader lines(path);
  std::string_view line;
  while (lines.number() + 1 < end && lines.next(line)) {
    const auto fact = fact_in(valid_utf8(line) ? std::string(line) : utf8_from_windows_1252(line));
    if (!fact) continue;
    latitude.add(latitude_of(*fact), lines.number());
    gravity.add(gravity_of(*fact), lines.number());
  }
  return {latitude.get(), gravity.get()};
}

}  // namespace drift
