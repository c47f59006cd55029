#include "analysis/cli/shell/study_template.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/cli/still_to_check.hpp"
#include "core/config/node.hpp"
#include "core/physics/coupling_names.hpp"

namespace drift::cli {
namespace {

std::string_view title_of(StudyKind kind) {
  switch (kind) {
    case StudyKind::platform:
      return "parameters of a gimballed platform, from its recordings";
    case StudyKind::strapdown:
      return "sensors on a case that is turned between rests";
    case StudyKind::study:
      return "how well eqs. (5) and (6) estimate what is simulated with eq. (5)";
    case StudyKind::sweep:
      return "how the estimates change with the length of a dwell";
    case StudyKind::diagnose:
      break;
  }
  return "what a nominal model leaves out, from recordings of a platform";
}

/// Whether each position keeps the dwell and sample it was recorded with, or all have those of
/// [plan].
enum class Dwells { as_recorded, alike };

std::string mode_text(bool level) {
  return level ? "level" : "free";
}

std::string position_text(const RecordedPlan& plan, std::size_t number, Dwells dwells) {
  const RecordedPlan::Position& p = plan.positions[number - 1];
  std::string text = fmt::format("[[plan.position]]\nname  = \"position {}\"\n{}\n", number,
                                 planning::attitude_keys(p.attitude, "  ", "\n"));
  if (p.torqued) text += "entry = \"torqued\"\n";
  if (p.level != plan.level) text += fmt::format("mode  = \"{}\"\n", mode_text(p.level));
  if (p.heading)
    text += fmt::format("case_heading = \"{:.0f} deg\"\n", std::round(*p.heading / detail::deg));
  if (!p.turned.axes.empty())
    text +=
        fmt::format("# or, of a case at {0:.0f} deg: {1} and case_heading = \"{0:.0f} deg\"\n",
                    45.0 + plan.faces / detail::deg, planning::attitude_keys(p.turned, " ", ", "));
  if (dwells == Dwells::alike) return text;
  text += fmt::format("dwell = \"{:.12g} s\"\n", p.length);
  if (p.sample) text += fmt::format("sample = \"{:.9g} s\"\n", *p.sample);
  return text;
}

std::string plan_text(const std::optional<RecordedPlan>& plan, Dwells dwells) {
  std::string text = fmt::format(
      "\n[plan]\nmode   = \"{}\"        # in the dwells: \"free\", or \"level\" with Earth rate "
      "commanded\nentry  = \"caged\"       # how a position is entered: \"caged\", or "
      "\"torqued\"\n",
      mode_text(plan && plan->level));
  if (!plan)
    return text +
           "preset = \"six\"         # or [[plan.position]] one by one, with name, axes and turn\n"
           "dwell  = \"60 min\"\nsample = \"60 s\"\n";
  text += fmt::format("sample = \"{:.9g} s\"{}\n", plan->sample,
                      plan->to_come ? "" : "      # of the recording");
  if (dwells == Dwells::alike)
    text += fmt::format("dwell  = \"{:.12g} s\"\n", plan->common_dwell());
  text += plan->to_come
              ? "# As many positions as the recording names; it is to say what they are.\n"
          : plan->north
              ? (plan->headings
                     ? std::string("# The axes are those that the gimbal angles show, with the "
                                   "recorded headings of the case.\n")
                 : plan->faces != 0.0
                     ? fmt::format("# The axes are those that the gimbal angles show of a case at "
                                   "{:.0f} deg, by which all of them\n# stand away from plain axes "
                                   "at a case that faces North; no instrument shows it.\n",
                                   plan->faces / detail::deg)
                     : "# The axes are those that the gimbal angles show of a case that faces "
                       "North.\n")
              : "# What is up is of the recording.\n# N, S, E, W of the axes below, which no "
                "accelerometer shows: check\n";
  for (std::size_t i = 0; i < plan->positions.size(); ++i)
    text += position_text(*plan, i + 1, dwells);
  return text;
}

/// Multiples of a dwell are whole numbers of samples as it is.
std::string sweep_text(const std::optional<RecordedPlan>& plan) {
  const double dwell = plan ? plan->common_dwell() : 1200.0;  // [s]
  return fmt::format(
      "\n# Every combination of these values is a study point.\n[sweep]\n\"plan.dwell\" = "
      "[\"{:.12g} s\", \"{:.12g} s\", \"{:.12g} s\"]\n",
      dwell, 2.0 * dwell, 4.0 * dwell);
}

/// `more`: further terms, ", \"accelerometer\"".
std::string terms_text(std::string_view more = "") {
  return fmt::format(
      "terms    = [\"fixed_drift\", \"g_drift\", \"gyro_misalignment\"{}]  # `driftscope terms` "
      "lists all\n",
      more);
}

/// said: further words on the equation, "; ...".
std::string filter_text(std::string_view name, std::string_view coupling, std::string_view more,
                        std::string_view said = "") {
  return fmt::format(
      "\n[[filter]]\nname     = \"{}\"\ncoupling = \"{}\"            # the drift "
      "equation: {}{}\n{}",
      name, coupling, names_of_equations(), said, terms_text(more));
}

/// How an effect that the library does not have may be tried.
constexpr std::string_view own_term_text =
    "\n# An effect of your own, a candidate like the library's: remove the # signs, write its "
    "equation.\n"
    "# [[term]]\n"
    "# key        = \"rumble\"\n"
    "# acts_on    = \"drift.y\"       # rate.x, drift.x, accelerometer.x (y, z) or gimbal.outer "
    "(middle, inner)\n"
    "# equation   = \"A * sin(2*pi*t/P)\"\n"
    "# parameters = { A = { unit = \"deg/h\", prior = 0.01 }, P = { unit = \"min\", value = 37 } }"
    "\n";

std::string simulated_text() {
  return fmt::format(
      "\n# What is simulated; parameters without a value are drawn from their "
      "priors.\n[truth]\ncoupling = \"eq5\"\n{}[truth.parameters]\neta_x = \"100 "
      "arcsec\"\n",
      terms_text());
}

}  // namespace

std::string study_template(StudyKind kind, const std::optional<RecordedPlan>& plan,
                           const std::string& mapping, const RecordedSite& site) {
  const auto quoted = [](const std::string& value) {
    return config::to_toml(config::text_node(value));
  };
  const auto from = [](const std::string& place) {
    return ", as the recording has it" + (place.empty() ? "" : fmt::format(" ({})", place));
  };
  std::string text = fmt::format(
      "# `driftscope check` says where a value is wrong, `driftscope schema` what may stand here.\n"
      "schema = 1\ntitle  = \"{}\"\n\n[site]\nlatitude = {:<15} # of the laboratory{}\n"
      "gravity  = {:<15} # there{}",
      title_of(kind), quoted(site.latitude.value_or(std::string(guessed_latitude))),
      site.latitude ? from(site.latitude_place) : ": check",
      quoted(site.gravity.value_or("9.80665 m/s^2")), site.gravity ? from(site.gravity_place) : "");
  const bool divides = site.divides || mapping.find("m/s^2") != std::string::npos;
  text += (site.gravity || !divides ? ": " : ": check; ") +
          std::string("a recording in m/s^2 is divided by it, and K1 is off by as many ppm\n");
  if (kind == StudyKind::strapdown)
    text +=
        "\n[plan]\nkind       = \"strapdown\"\nstatic_min = \"2 s\"        # the shortest rest "
        "that counts\n"
        "# On a table with fixed axes (not moved by hand), gyros that see the Earth: "
        "accelerometers\n"
        "# are read in turns, too, and show their lever arms and their delay.\n"
        "# accelerometers_in_turns = true\n";
  else
    text +=
        plan_text(plan, kind == StudyKind::sweep ? Dwells::alike : Dwells::as_recorded) +
        "\n[readout]\n" +
        (plan && !plan->noise.empty()
             ? plan->noise
             : fmt::format("accelerometer_noise = \"5 ug\"      # 1 sigma of a sample: of the "
                           "data sheet, or of a rest{}\n",
                           plan ? ": check" : "")) +
        (plan && !plan->gimbal_noise.empty() ? plan->gimbal_noise
                                             : fmt::format("gimbal_noise        = \"5 arcsec\"{}\n",
                                                           plan ? "  # likewise: check" : ""));
  if (!mapping.empty()) text += "\n" + mapping;
  if (kind == StudyKind::study || kind == StudyKind::sweep) text += simulated_text();
  // Accelerometers of a real unit have errors of their own, beside which any other hides; so have
  // the scale factors of gyros on a case that turns.
  const bool real = kind == StudyKind::platform || kind == StudyKind::diagnose;
  const std::string_view more =
      real ? ", \"accelerometer\""
      : kind == StudyKind::strapdown
          ? ", \"torquer_scale\",\n            \"K0\", \"K1\", \"dP\", \"dO\""
          : "";
  if (kind == StudyKind::diagnose) {
    // A filter on the wrong one may fit, with wrong values.
    text += filter_text("nominal", "eq5", more,
                        "; another may fit as well: `driftscope diagnose` tells");
    text += own_term_text;
  } else {
    text += filter_text("eq5", "eq5", more) + filter_text("eq6", "eq6", more);
  }
  if (kind == StudyKind::study || kind == StudyKind::sweep)
    text +=
        "\n[monte_carlo]\nruns = 200               # each draws parameters and noise anew\nseed "
        "= 1\n";
  if (kind == StudyKind::sweep) text += sweep_text(plan);
  return text;
}

}  // namespace drift::cli
