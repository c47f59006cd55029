#include "mc/export/swept_coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/config/load.hpp"
#include "core/config/quantity.hpp"

namespace drift::mc {
namespace {

/// The number or word of a value that is neither table nor list; nothing of those.
std::optional<std::string> word_of(const config::Node& value) {
  switch (value.kind) {
    case config::Node::Kind::table:
    case config::Node::Kind::array:
      return std::nullopt;
    case config::Node::Kind::integer:
      return fmt::format("{}", value.integer);
    case config::Node::Kind::real:
      return fmt::format("{}", value.real);
    case config::Node::Kind::boolean:
      return value.boolean ? "true" : "false";
    default:
      return value.text;
  }
}

/// Values of several keys that are swept together, `{ dwell = "20 min", sample = "60 s" }`, one by
/// one; nothing of anything else.
std::vector<std::pair<std::string, std::string>> together(const std::string& key,
                                                          const std::string& value) {
  if (!value.starts_with('{')) return {};
  std::vector<std::pair<std::string, std::string>> all;
  for (const config::Member& m : config::parse_value(value, key).members) {
    const auto word = word_of(m.value);
    if (!word) return {};
    all.emplace_back(key + "." + m.key, *word);
  }
  return all;
}

/// "0.1 mg" is 100 ug, and not 100.00000000000001: a decimal stays one.
double converted(double value, const Unit& from, const Unit& to) {
  if (from.to_si == to.to_si) return value;
  const std::string text = fmt::format("{:.14g}", value * (from.to_si / to.to_si));
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

SweptCoordinate coordinate(std::string key, std::vector<std::string> words) {
  SweptCoordinate c{std::move(key), std::move(words), {}};
  for (const std::string& word : c.words) {
    const auto number = config::quantity_in(word);
    if (&word == &c.words.front() && number) c.unit = number->unit;
    if (number && number->unit.same_dimension(c.unit))
      c.numbers.push_back(converted(number->value, number->unit, c.unit));
  }
  if (c.numbers.size() != c.words.size()) c.numbers.clear();
  return c;
}

/// Those of one axis of a sweep: several where each of its values is of the same several keys.
std::vector<SweptCoordinate> coordinates(const std::vector<StudyPoint>& points, std::size_t axis) {
  const std::string& key = points.front().values[axis].first;
  std::vector<std::string> keys, whole;
  std::vector<std::vector<std::string>> words;
  bool apart = true;
  for (const StudyPoint& p : points) {
    whole.push_back(p.values[axis].second);
    const auto members = together(key, whole.back());
    if (whole.size() == 1)
      for (const auto& [k, word] : members) keys.push_back(k);
    words.resize(keys.size());
    apart = apart && !keys.empty() &&
            std::ranges::equal(members, keys, {}, &std::pair<std::string, std::string>::first);
    for (std::size_t m = 0; apart && m < keys.size(); ++m) words[m].push_back(members[m].second);
  }
  if (!apart) return {coordinate(key, std::move(whole))};
  std::vector<SweptCoordinate> all;
  for (std::size_t m = 0; m < keys.size(); ++m)
    all.push_back(coordinate(keys[m], std::move(words[m])));
  return all;
}

}  // namespace

std::string SweptCoordinate::title() const {
  if (numbers.empty() || unit.symbol.view() == unit::one.symbol.view()) return key;
  return key + " [" + std::string(unit.symbol.view()) + "]";
}

std::vector<SweptCoordinate> swept_coordinates(const std::vector<StudyPoint>& points) {
  std::vector<SweptCoordinate> all;
  if (points.empty()) return all;
  for (std::size_t axis = 0; axis < points.front().values.size(); ++axis)
    for (SweptCoordinate& c : coordinates(points, axis)) all.push_back(std::move(c));
  return all;
}

}  // namespace drift::mc
