#include "analysis/preparation/commands/command_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "analysis/preparation/commands/commanded.hpp"
#include "analysis/preparation/own_names.hpp"
#include "core/base/words.hpp"
#include "core/physics/term_library.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

constexpr std::string_view scale_keys[] = {"s_x", "s_y", "s_z"};

/// Of the first filter: what is believed of the scale of the torquer of a column.
Prior torquer_scale_prior(const mc::Study& study, int column) {
  const std::size_t param = TermLibrary::find(scale_keys[column]).value();
  const FilterSpec* filter = study.filters.empty() ? nullptr : &study.filters.front();
  return filter != nullptr && filter->active[param] ? filter->believed(param)
                                                    : TermLibrary::specs[param].prior_si();
}

/// Whether a torquer that stands against the Earth with so many times the command has a scale that
/// its prior does not hold.
bool beyond_its_prior(double factor, const Prior& prior) {
  const double scale = 1.0 / factor - 1.0;
  return !(std::abs(scale - prior.mean()) <= PlanLimits::scale_sigmas * prior.sigma());
}

/// Columns that are one factor times the plan's commands.
struct Multiplied {
  double factor = 1.0;
  std::vector<int> columns{};
  double most = 0.0;  ///< by which it takes a command from the plan's [rad/s]
};

std::vector<Multiplied> multiplied(const mc::Study& study, const std::vector<Commanded>& all) {
  std::vector<Multiplied> groups;
  for (int i = 0; i < 3; ++i) {
    const auto factor = factor_of_commands(all, i);
    if (!factor || !beyond_its_prior(*factor, torquer_scale_prior(study, i))) continue;
    auto group = std::ranges::find_if(groups, [&](const Multiplied& m) {
      return std::abs(m.factor - *factor) <=
             PlanLimits::factor_left * std::min(m.factor, std::abs(m.factor - 1.0));
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {.factor = *factor});
    group->columns.push_back(i);
    for (const Commanded& c : all)
      if (c.law == CommandLaw::level)
        group->most = std::max(group->most, std::abs(c.recorded[i] - c.planned[i]));
  }
  return groups;
}

/// where: in which dwells, and how the platform stands in them.
std::string factor_text(const Multiplied& m, const Unit& said, const std::string& where) {
  std::vector<std::string> names;
  std::vector<std::string_view> scales;
  for (const int i : m.columns) {
    names.emplace_back(command_channels.names[static_cast<std::size_t>(i)]);
    scales.push_back(scale_keys[i]);
  }
  const std::string columns =
      fmt::format("{} {}", listed(names, "and"), names.size() == 1 ? "is" : "are");
  if (m.factor == 0.0)
    return fmt::format(
        "{} zero {}, which zero commands do not make it do. Record what was commanded, or leave "
        "cmd_x, cmd_y, cmd_z out: those of the plan are taken then",
        columns, where);
  const std::string held =
      fmt::format("{} {:.4g} times the plan's commands {}", columns, m.factor, where);
  const auto* meant = std::ranges::find_if(rate_units, [&](const Unit& u) {
    return std::abs(m.factor * u.to_si / said.to_si - 1.0) < PlanLimits::unit_room;
  });
  if (meant != std::end(rate_units) && meant->to_si != said.to_si)
    return fmt::format("{}: the numbers look like [{}], not [{}]. Correct the unit", held,
                       meant->symbol.view(), said.symbol.view());
  return fmt::format(
      "{} (expected once, within {:.0f} prior sigmas of {}). Correct the unit or the pulse weight, "
      "or the prior",
      held, PlanLimits::scale_sigmas, fmt::join(scales, ", "));
}

std::string latitude_text(double sine, const std::vector<Commanded>& all, const Site& site) {
  std::vector<int> positions;
  for (const Commanded& c : all)
    if (c.law == CommandLaw::level) positions.push_back(c.position);
  return fmt::format(
      "the commands in {} are the Earth rate at latitude {:.3f} deg, [site] says {:.3f} deg. Check "
      "[site] latitude",
      positions_text(positions), std::asin(sine) / detail::deg, site.latitude / detail::deg);
}

/// Commands that are those of the other law, or of neither.
std::vector<std::string> other_law_texts(const std::vector<Commanded>& all) {
  std::vector<std::string> texts;
  std::array<std::vector<int>, 2> as_other;  // by the plan's law
  std::vector<int> neither;
  double farthest = 0.0;
  for (const Commanded& c : all) {
    if (c.off() < command_room) continue;
    if ((c.recorded - c.by_other_law).norm() < command_room) {
      as_other[c.law == CommandLaw::level ? 1 : 0].push_back(c.position);
    } else {
      neither.push_back(c.position);
      farthest = std::max(farthest, c.off());
    }
  }
  for (const CommandLaw law : {CommandLaw::free, CommandLaw::level}) {
    const bool level = law == CommandLaw::level;
    if (as_other[level ? 1 : 0].empty()) continue;
    texts.push_back(fmt::format(
        "the commands in {} are those of a {} dwell, the plan says mode = \"{}\". The recorded "
        "commands are used; correct plan.mode if that is not what was meant",
        positions_text(as_other[level ? 1 : 0]),
        key_of(level ? CommandLaw::free : CommandLaw::level), key_of(law)));
  }
  if (!neither.empty())
    texts.push_back(
        fmt::format("the commands in {} are up to {:.3g} deg/h from those of the plan, and of "
                    "neither law. The recorded commands are used",
                    positions_text(neither), farthest / unit::deg_per_h.to_si));
  return texts;
}

}  // namespace

void check_commands(const mc::Study& study, const Recording& recording, const Timeline& timeline,
                    const Measurements& measured, const std::vector<Dwell>& dwells,
                    std::vector<std::string>& remarks, std::vector<std::string>& wrong) {
  const std::string source = recording.source.empty() ? "recording" : recording.source;
  const auto say = [&](std::vector<std::string>& where, const std::string& text) {
    where.push_back(in_own_names(fmt::format("{}: {}", source, text), study.recording));
  };
  std::vector<Commanded> all = commanded_in(study, timeline, measured, dwells);
  const bool ignored = std::abs(part_obeyed(all)) < PlanLimits::other_law;
  const auto mixup = ignored ? exchanged_commands(all) : std::nullopt;
  const std::string columns =
      mixup ? mixup_text(*mixup, command_channels,
                         fmt::format("all {} dwells have the commands of the plan, with which the "
                                     "platform stands",
                                     all.size()))
            : "";
  if (const auto sine = sine_of_another_latitude(all, study.site)) {
    const std::string text = latitude_text(*sine, all, study.site);
    say(remarks, mixup ? fmt::format("{}. Or {}", text, columns) : text);
    std::erase_if(all, [](const Commanded& c) { return c.law == CommandLaw::level; });
  } else if (mixup) {
    return say(wrong, columns);
  }
  bool told = false;
  const double turns = rms_turn(all);
  const bool stands = stands_level(all, study.site);
  for (const Multiplied& m : stands ? multiplied(study, all) : std::vector<Multiplied>{}) {
    // Drift may turn the platform as a small part of a command does: that is no more than remarked.
    const bool large = m.most >= command_room, refused = large && ignored;
    const std::string where = fmt::format(
        "in all {} level dwells, in which the platform {}",
        std::ranges::count(all, CommandLaw::level, &Commanded::law),
        refused ? "stands"
                : fmt::format("turns by {:.2g} deg/h (rms)", turns / unit::deg_per_h.to_si));
    const std::string_view first =
        command_channels.names[static_cast<std::size_t>(m.columns.front())];
    const std::string text = factor_text(m, recording.find(first)->unit, where);
    say(refused ? wrong : remarks, refused ? text : text + ". The recorded commands are used");
    told = told || large;
  }
  if (told) return;
  for (const std::string& text : other_law_texts(all)) say(remarks, text);
}

}  // namespace drift::preparation
