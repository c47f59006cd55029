#include "core/recording/own/guess_names.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/header.hpp"

namespace drift {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::pair<std::string_view, std::string_view> unit_endings[] = {
    {"ms", "ms"},
    {"us", "us"},
    {"s", "s"},
    {"sec", "s"},
    {"min", "min"},
    {"h", "h"},
    {"deg", "deg"},
    {"rad", "rad"},
    {"arcsec", "arcsec"},
    {"g", "g"},
    {"mg", "mg"},
    {"ug", "ug"},
    {"mss", "m/s^2"},
    {"ms2", "m/s^2"},
    {"mps2", "m/s^2"},
    {"dps", "deg/s"},
    {"degs", "deg/s"},
    {"degps", "deg/s"},
    {"rads", "rad/s"},
    {"radps", "rad/s"},
    {"degh", "deg/h"},
    {"dph", "deg/h"},
    {"degc", "degC"},
    {"c", "degC"},
    {"k", "K"},
    {"degk", "K"},
    {"kelvin", "K"},
    {"degf", "degF"},
    // Of a size that no unit says.
    {"counts", "counts"},
    {"lsb", "counts"}};

constexpr std::string_view time_words[] = {
    "time",       "t",        "zeit",      "timestamp",  "elapsed",  "elapsedtime",   "zeitstempel",
    "sekunde",    "sekunden", "uhrzeit",   "sampletime", "seconds",  "timestartup",   "timegps",
    "horodatage", "temps",    "hora",      "tiempo",     "heure",    "ora",           "tempo",
    "tijd",       "epoch",    "epochtime", "unix",       "unixtime", "unixtimestamp", "utc",
    "utctime",    "timeutc",  "datetime"};
constexpr std::string_view position_words[] = {"position",   "pos",      "lage",
                                               "stellung",   "lagenr",   "posnr",
                                               "positionno", "posicion", "posizione"};
constexpr std::string_view temperature_words[] = {"temperature", "temp", "temperatur", "tc"};
constexpr std::string_view heading_words[] = {
    "heading",        "caseheading",  "headingcase", "tableheading", "turntableheading",
    "turntableangle", "tableangle",   "turntable",   "tischwinkel",  "drehtischwinkel",
    "drehtisch",      "sockelwinkel", "caseazimuth", "tableazimuth"};
constexpr std::string_view acc_words[] = {"a",
                                          "acc",
                                          "accel",
                                          "acceleration",
                                          "accelerometer",
                                          "beschl",
                                          "f",
                                          "beschleunigung",
                                          "specificforce",
                                          "sf",
                                          "fieldlinearacceleration",
                                          "ac",
                                          "acel",
                                          "aceleracion",
                                          "accelerazione",
                                          "accelerometro",
                                          "acelerometro",
                                          "versnelling"};
constexpr std::string_view gyro_words[] = {"g",           "gyr",
                                           "gyro",        "gyroscope",
                                           "w",           "omega",
                                           "rate",        "drehrate",
                                           "angularrate", "angrate",
                                           "angvel",      "angularvelocity",
                                           "gyrorate",    "fieldangularvelocity"};
constexpr std::string_view cmd_words[] = {
    "cmd",   "command", "commanded", "soll",     "befehl",   "wcmd",    "kommando",
    "orden", "comando", "consigna",  "consigne", "commande", "opdracht"};
constexpr std::string_view gimbal_words[] = {
    "gimbal", "phi",    "resolver", "winkel", "rahmen", "angle",  "cardan", "kardan", "angulo",
    "angolo", "giunto", "cardano",  "marco",  "cuadro", "telaio", "cadre",  "raam"};
constexpr std::string_view outer_words[] = {
    "outer", "aussen", "ext", "exterieur", "externe", "exterior", "est", "esterno", "a", "o", "1"};
constexpr std::string_view middle_words[] = {"middle", "mitte", "mittel", "med", "median",
                                             "milieu", "medio", "mezzo",  "m",   "2"};
constexpr std::string_view inner_words[] = {"inner",    "innen",   "int", "interieur", "interne",
                                            "interior", "interno", "i",   "3"};

constexpr std::array<std::pair<Words, std::string_view>, 3> gimbal_places{
    {{outer_words, "gimbal_outer"},
     {middle_words, "gimbal_middle"},
     {inner_words, "gimbal_inner"}}};

bool is_one(std::string_view word, Words words) {
  return std::ranges::find(words, word) != words.end();
}

/// The last part of a header that underscores, blanks or dots divide; empty if it has one part.
std::string_view last_part(std::string_view name) {
  const auto at = name.find_last_of("_ .-");
  return at == std::string_view::npos ? std::string_view() : name.substr(at + 1);
}

std::string letters(std::string_view text) {
  std::string out = lower_case(plain_channel_name(text));
  std::erase(out, '_');
  return out;
}

}  // namespace

std::string guessed_unit(std::string_view header) {
  const std::string last = lower_case(last_part(header));
  for (const auto& [ending, unit] : unit_endings)
    if (ending == last) return std::string(unit);
  return {};
}

std::string unit_of_symbol(std::string_view header) {
  return header.size() == last_part(header).size() + 2 ? guessed_unit(header) : std::string();
}

std::string guessed_channel(std::string_view header) {
  std::string_view name = header;
  if (!guessed_unit(header).empty())
    name = header.substr(0, header.size() - last_part(header).size());
  const std::string word = letters(name);
  if (word.empty()) return {};
  if (is_one(word, time_words)) return "time";
  if (is_one(word, position_words)) return "position";
  if (is_one(word, temperature_words)) return "temperature";
  if (is_one(word, heading_words)) return "case_heading";
  if (word == "phase") return "phase";
  for (const auto& [places, channel] : gimbal_places)
    for (const auto place : places) {
      if (place.size() > 3 && word == place) return std::string(channel);
      const std::string_view whole = word;
      const bool behind = whole.ends_with(place),
                 before = place.size() > 1 && whole.starts_with(place);
      if ((behind && is_one(whole.substr(0, whole.size() - place.size()), gimbal_words)) ||
          (before && is_one(whole.substr(place.size()), gimbal_words)))
        return std::string(channel);
    }
  const char axis = word.back();
  if (word.size() < 2 || axis < 'x' || axis > 'z') return {};
  const std::string_view stem = std::string_view(word).substr(0, word.size() - 1);
  constexpr std::array<std::pair<Words, std::string_view>, 3> triples{
      {{acc_words, "acc_"}, {gyro_words, "gyro_"}, {cmd_words, "cmd_"}}};
  for (const auto& [words, start] : triples)
    if (is_one(stem, words)) return std::string(start) + axis;
  return {};
}

bool may_be_gimbal(std::string_view header, std::string_view channel) {
  constexpr std::size_t shortest = 2;
  const auto unit = guessed_unit(header).empty() ? 0 : last_part(header).size();
  const std::string word = letters(header.substr(0, header.size() - unit));
  if (word.size() < shortest) return false;
  return std::ranges::any_of(gimbal_places, [&](const auto& gimbal) {
    return gimbal.second == channel &&
           std::ranges::any_of(gimbal.first, [&](auto place) { return place.starts_with(word); });
  });
}

}  // namespace drift
