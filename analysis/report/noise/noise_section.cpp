#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/noise/limits.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/noise/noise_units.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {
namespace {

using preparation::ChannelNoise, preparation::NoiseCard, preparation::NoNoise;
using stats::AllanCoefficient, stats::AllanFit, stats::AllanNoise;

bool fitted(const NoiseCard& card, int noise) {
  return card.kind == RecordingKind::strapdown || noise <= static_cast<int>(AllanNoise::white);
}

/// "0.1021±0.0012", "0.5±0.1 or K", "<0.3"; "-" where nothing bounds it.
std::string coefficient_text(const AllanFit& fit, AllanNoise noise, double size) {
  const AllanCoefficient& c = fit[noise];
  if (!c.found && c.upper > 0.0) {
    const double limit = limit_of(fit, noise);
    return limit > 0.0 ? fmt::format("<{}", number_text(limit / size)) : "-";
  }
  if (!c.found) return "";
  constexpr double long_number = 1e4;
  std::string text =
      c.value < long_number * size
          ? with_sigma(c.value / size, c.sigma / size)
          : fmt::format("{}±{}", number_text(c.value / size), number_text(c.sigma / size, 2));
  for (const AllanNoise rival : c.rivals)
    text += fmt::format(" or {}", "QNBKR"[static_cast<int>(rival)]);
  return text;
}

/// White noise of accelerometers is quoted in two units.
std::string velocity_walk(const AllanCoefficient& c, double gravity) {
  if (!c.found) return "";
  const double size = 1.0 / (gravity * std::sqrt(3600.0));  // m/s/sqrt(h) in g sqrt(s)
  return with_sigma(c.value / size, c.sigma / size);
}

/// Whether dwells agree, and whether five slopes are enough.
std::string remark(const ChannelNoise& c) {
  std::string text = c.fit.fits ? "" : fmt::format("misfit {}", number_text(c.fit.misfit, 2));
  if (c.noisiest > 2.0 * c.quietest && c.quietest > 0.0)
    text += fmt::format("{}dwells differ {} times", text.empty() ? "" : ", ",
                        number_text(c.noisiest / c.quietest, 2));
  if (c.isolated > 0)
    text += fmt::format("{}without {} isolated sample{}", text.empty() ? "" : ", ", c.isolated,
                        plural(c.isolated));
  return text;
}

Table coefficients(const NoiseCard& card, Sensor sensor, double gravity) {
  const auto units = noise_units(sensor, gravity);
  std::string columns = "<channel";
  for (int a = 0; a < stats::allan_noises; ++a)
    if (fitted(card, a)) {
      columns += fmt::format(" | {} [{}]", units[a].key, units[a].symbol);
      if (sensor == Sensor::accelerometer && a == static_cast<int>(AllanNoise::white))
        columns += " | N [m/s/sqrt(h)]";
    }
  Table table(
      sensor == Sensor::gyro ? "Noise of the gyros at rest" : "Noise of the accelerometers at rest",
      columns + " | <");
  for (const ChannelNoise& c : card.channels) {
    if (sensor_of(c.channel) != sensor) continue;
    std::vector<Cell> row{c.channel};
    for (int a = 0; a < stats::allan_noises; ++a) {
      if (!fitted(card, a)) continue;
      const AllanCoefficient& k = c.fit.coefficients[a];
      row.emplace_back(coefficient_text(c.fit, static_cast<AllanNoise>(a), units[a].size));
      if (sensor == Sensor::accelerometer && a == static_cast<int>(AllanNoise::white))
        row.emplace_back(velocity_walk(k, gravity));
    }
    row.emplace_back(remark(c), c.fit.fits ? Tone::plain : Tone::doubtful);
    table.add(std::move(row));
  }
  return table;
}

std::string_view why_not(NoNoise missing) {
  return missing == NoNoise::unequal_rows
             ? "No Allan card: the rows at rest lie at unequal distances (they scatter by more "
               "than "
               "a fifth), so that averages are not over equal times. Log at a steady rate."
             : "No Allan card: no rest is long enough (16 samples on a case, 20 on a platform), or "
               "no sensor shows noise.";
}

Sentences reading(const NoiseCard& card) {
  const bool any_misfit = std::ranges::any_of(card.channels, [](auto& c) { return !c.fit.fits; });
  const bool any_rival = std::ranges::any_of(card.channels, [](const ChannelNoise& c) {
    return std::ranges::any_of(c.fit.coefficients, [](auto& k) { return !k.rivals.empty(); });
  });
  Sentences said{{}, ""};
  said.items.push_back(fmt::format(
      "Overlapping Allan variance of {} rest{} with {} s together, the longest {} s, sampled every "
      "{} s{}; fitted with the covariance of its points.",
      card.stretches, plural(card.stretches), number_text(card.total, 4),
      number_text(card.longest, 4), number_text(card.interval, 4),
      card.kind == RecordingKind::platform ? ", the course of each dwell (fourth degree) taken off"
                                           : ""));
  if (card.other_spacing > 0)
    said.items.push_back(fmt::format(
        "{} row{} at rest with another interval {} left out: averages over them are over other "
        "times.",
        card.other_spacing, plural(card.other_spacing), card.other_spacing == 1 ? "is" : "are"));
  said.items.push_back(
      "± is 1 sigma; < is an upper limit (95 %) of what is not distinguished from zero: without it "
      "chance shows as much in more than 1 of 100 recordings.");
  const bool any_by_sum = std::ranges::any_of(card.channels, [](const ChannelNoise& c) {
    return std::ranges::any_of(stats::AllanFitter::all_noises, [&](AllanNoise noise) {
      return !c.fit[noise].found && limit_of(c.fit, noise) < c.fit[noise].upper;
    });
  });
  if (any_by_sum)
    said.items.push_back(
        "A limit is no higher than what all noises together show at some averaging time: beyond "
        "that the rests are too short to say anything of a slow noise.");
  if (any_rival)
    said.items.push_back("'or K': the rests are too short to tell which of these noises it is.");
  if (any_misfit)
    said.items.push_back(
        "misfit: chi-square per degree of freedom where the five slopes do not describe the noise "
        "(filters, vibration, coarse steps); sigmas are wider by its root.");
  return said;
}

}  // namespace

Section noise_section(const NoiseCard& card, double gravity) {
  Section section{"Noise at rest", {}, On::both, Part::details};
  if (card.missing != NoNoise::there_is_one) {
    section.add({Paragraph{std::string(why_not(card.missing))}});
    return section;
  }
  section.add({Figure{allan_picture(card),
                      "Dots with their 95 % intervals; lines: the fitted noise, dotted: its parts.",
                      "allan.svg"}});
  for (const Sensor sensor : sensors) {
    Table table = coefficients(card, sensor, gravity);
    if (!table.rows.empty()) section.add({std::move(table)});
  }
  section.add({reading(card)});
  return section;
}

nlohmann::json to_json(const NoiseCard& card, double gravity) {
  using nlohmann::json;
  if (card.missing != NoNoise::there_is_one) return nullptr;
  json channels = json::array();
  for (const ChannelNoise& c : card.channels) {
    const auto units = noise_units(sensor_of(c.channel), gravity);
    const NoiseUnit& rate = units[2];
    json one{{"channel", c.channel},   {"misfit", c.fit.misfit},
             {"fits", c.fit.fits},     {"unit", std::string(rate.symbol)},
             {"allan", json::array()}, {"coefficients", json::array()}};
    for (const auto& p : c.fit.points)
      one["allan"].push_back({{"tau_s", p.tau},
                              {"deviation", p.deviation / rate.size},
                              {"interval_95", {p.low / rate.size, p.high / rate.size}},
                              {"dof", p.dof},
                              {"fitted", p.fitted / rate.size}});
    for (int a = 0; a < stats::allan_noises; ++a) {
      if (!fitted(card, a)) continue;
      const AllanCoefficient& k = c.fit.coefficients[a];
      json term{{"key", std::string(units[a].key)},
                {"what", std::string(units[a].words)},
                {"unit", units[a].symbol},
                {"found", k.found},
                {"p_value", k.p}};
      term["value"] = k.found ? json(k.value / units[a].size) : json(nullptr);
      term["sigma"] = k.found ? json(k.sigma / units[a].size) : json(nullptr);
      const double limit = limit_of(c.fit, static_cast<AllanNoise>(a));
      term["upper_95"] = k.found || !(limit > 0.0) ? json(nullptr) : json(limit / units[a].size);
      term["or"] = json::array();
      for (const AllanNoise rival : k.rivals)
        term["or"].push_back(std::string(units[static_cast<std::size_t>(rival)].key));
      one["coefficients"].push_back(std::move(term));
    }
    channels.push_back(std::move(one));
  }
  return {{"interval_s", card.interval},    {"rests", card.stretches},
          {"longest_s", card.longest},      {"total_s", card.total},
          {"rows_left_out", card.left_out}, {"rows_of_other_intervals", card.other_spacing},
          {"channels", std::move(channels)}};
}

}  // namespace drift::report
