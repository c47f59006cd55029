#include "analysis/cli/shell/study_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/cli/shell/two_ups.hpp"
#include "core/config/node.hpp"
#include "core/physics/earth.hpp"
#include "core/physics/gimbals.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/quality_card.hpp"

namespace drift::cli {
namespace {

/// A right-handed frame with the axis up (or down) that the accelerometers show. Headings leave no
/// trace in them.
std::string axes_of(const Vec3& force) {
  constexpr std::string_view up[] = {"x=U y=N z=W", "x=W y=U z=N", "x=N y=W z=U"};
  constexpr std::string_view down[] = {"x=D y=W z=N", "x=N y=D z=W", "x=W y=N z=D"};
  int vertical = 0;
  force.cwiseAbs().maxCoeff(&vertical);
  return std::string(force[vertical] < 0.0 ? down[vertical] : up[vertical]);
}

Vec3 mean_force(const Recording& r, std::size_t first, std::size_t end) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t row = first; row < end; ++row)
    if (const auto force = measured(r, accelerometer_channels, row)) sum += *force;
  return sum;
}

/// The directions N, S, W, E, U, D, or half way between two of them, nearest to the axes that the
/// gimbals show; empty without gimbal angles, and where an axis lies between three.
std::optional<std::string> cardinal_axes(const Recording& r, std::size_t row, double heading) {
  const double shares = std::sin(22.5 * detail::deg);  // nearer to half way than to the other one
  const auto angles = measured(r, gimbal_channels, row);
  if (!angles) return std::nullopt;
  const Mat3 R_lp = case_attitude(heading) * gimbal_chain(*angles);
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    std::string letters;
    for (int l = 0; l < 3; ++l)
      if (std::abs(R_lp(l, axis)) > shares) letters += (R_lp(l, axis) > 0.0 ? "NWU" : "SED")[l];
    if (letters.size() > 2) return std::nullopt;
    text += fmt::format("{}{}={}", axis == 0 ? "" : " ", "xyz"[axis], letters);
  }
  return text;
}

/// To six digits, so that whole numbers of samples are whole as they are written, too.
double as_written(double sample) {
  if (!(sample > 0.0) || !std::isfinite(sample)) return sample;
  const double unit = std::pow(10.0, std::floor(std::log10(sample)) - 5.0);
  return unit < 1.0 ? std::round(sample / unit) / std::round(1.0 / unit)
                    : std::round(sample / unit) * unit;
}

std::string_view title_of(StudyKind kind) {
  switch (kind) {
    case StudyKind::platform:
      return "parameters of a gimballed platform, from its recordings";
    case StudyKind::strapdown:
      return "sensors on a case that is turned by hand between rests";
    case StudyKind::study:
      return "how well eqs. (5) and (6) estimate what is simulated with eq. (5)";
    case StudyKind::sweep:
      return "how the estimates change with the length of a dwell";
    case StudyKind::diagnose:
      break;
  }
  return "what a nominal model leaves out, from recordings of a platform";
}

/// Whether each position keeps the dwell it was recorded with, or all have that of [plan].
enum class Dwells { as_recorded, alike };

std::string position_text(const RecordedPlan::Position& p, std::size_t number, Dwells dwells) {
  std::string text =
      fmt::format("[[plan.position]]\nname  = \"position {}\"\naxes  = \"{}\"\n", number, p.axes);
  if (p.torqued) text += "entry = \"torqued\"\n";
  if (p.heading)
    text += fmt::format("case_heading = \"{:.0f} deg\"\n", std::round(*p.heading / detail::deg));
  if (!p.turned.empty())
    text += fmt::format("# or, of a case at 45 deg: axes = \"{}\" and case_heading = \"45 deg\"\n",
                        p.turned);
  if (dwells == Dwells::as_recorded) text += fmt::format("dwell = \"{:.12g} s\"\n", p.length);
  return text;
}

std::string plan_text(const std::optional<RecordedPlan>& plan, Dwells dwells) {
  std::string text = fmt::format(
      "\n[plan]\nmode   = \"{}\"        # in the dwells: \"free\", or \"level\" with Earth rate "
      "commanded\nentry  = \"caged\"       # how a position is entered: \"caged\", or "
      "\"torqued\"\n",
      plan && plan->level ? "level" : "free");
  if (!plan)
    return text +
           "preset = \"six\"         # or [[plan.position]] one by one, with name and axes\n"
           "dwell  = \"60 min\"\nsample = \"60 s\"\n";
  text += fmt::format("sample = \"{:.9g} s\"{}\n", plan->sample,
                      plan->to_come ? "" : "      # of the recording");
  if (dwells == Dwells::alike)
    text += fmt::format("dwell  = \"{:.12g} s\"\n", plan->positions.front().length);
  text += plan->to_come
              ? "# As many positions as the recording names; it is to say what they are.\n"
          : plan->north
              ? (plan->headings
                     ? "# The axes are those that the gimbal angles show, with the recorded "
                       "headings of the case.\n"
                     : "# The axes are those that the gimbal angles show of a case that faces "
                       "North.\n")
              : "# What is up is of the recording. Which axis points North no accelerometer "
                "shows: correct N, S, E, W.\n";
  for (std::size_t i = 0; i < plan->positions.size(); ++i)
    text += position_text(plan->positions[i], i + 1, dwells);
  return text;
}

/// Multiples of a dwell are whole numbers of samples as it is.
std::string sweep_text(const std::optional<RecordedPlan>& plan) {
  const double dwell = plan ? plan->positions.front().length : 1200.0;  // [s]
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

std::string filter_text(std::string_view name, std::string_view coupling, std::string_view more) {
  return fmt::format(
      "\n[[filter]]\nname     = \"{}\"\ncoupling = \"{}\"            # the drift "
      "equation: \"eq5\", \"eq6\" or \"lambda\"\n{}",
      name, coupling, terms_text(more));
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

RecordedPlan recorded_plan(const Recording& r) {
  RecordedPlan plan;
  plan.sample = as_written(quality_card(r, RecordingKind::platform).interval);
  plan.north = true;
  const Channel *position = r.find("position"), *time = r.find("time"), *phase = r.find("phase"),
                *heading = r.find("case_heading");
  plan.headings = heading != nullptr;
  std::vector<TwoUps> seen;
  std::vector<std::string> ups;
  for (std::size_t first = 0, end = 0; first < r.rows(); first = end) {
    end = first + 1;
    while (end < r.rows() && (!position || position->values[end] == position->values[first])) ++end;
    std::size_t dwell = first;
    while (phase && dwell + 1 < end && phase->values[dwell] == 1.0) ++dwell;
    const double span = time->values[end - 1] - time->values[dwell] + plan.sample;
    RecordedPlan::Position p{std::round(span / plan.sample) * plan.sample, "", dwell > first, {}};
    if (heading) p.heading = heading->values[end - 1];
    const auto shown = cardinal_axes(r, dwell, p.heading.value_or(0.0));
    if (!shown) p.heading.reset();  // axes that are guessed may not be reached from it
    plan.north = plan.north && shown;
    const auto turned = cardinal_axes(r, dwell, p.heading.value_or(0.0) + 45.0 * detail::deg);
    if (!heading && shown && turned && shown->size() > turned->size()) p.turned = *turned;
    p.axes = shown ? *shown : axes_of(mean_force(r, dwell, end));
    const std::size_t row = std::min(dwell + 2, end - 1);  // the first may be of the turn
    const auto force = measured(r, accelerometer_channels, row),
               angles = measured(r, gimbal_channels, row);
    if (force && angles) {
      seen.push_back({plan.positions.size() + 1, *force, *angles});
      ups.push_back(axes_of(*force));
    }
    const auto command = measured(r, command_channels, dwell);
    plan.level = plan.level || (command && command->norm() > 0.5 * detail::earth_rate);
    plan.positions.push_back(std::move(p));
  }
  const Channel* const outer = r.find("gimbal_outer");
  if (outer) plan.contradiction = two_ups_text(seen, outer->unit);
  if (plan.contradiction.empty()) return plan;
  // Axes of a misread gimbal would have the accelerometers seem wrong.
  plan.north = false;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    RecordedPlan::Position& p = plan.positions[seen[k].position - 1];
    p.axes = ups[k];
    p.heading.reset();
    p.turned.clear();
  }
  return plan;
}

RecordedPlan plan_to_come(std::size_t positions) {
  constexpr double sample = 60.0, dwell = 3600.0;  // [s]
  RecordedPlan plan{.sample = sample, .to_come = true};
  plan.positions.assign(positions, {.length = dwell, .axes = "x=N y=W z=U"});
  return plan;
}

RecordedSite recorded_site(const Recording& recording) {
  RecordedSite site;
  for (const auto& [key, value] : recording.facts) {
    if (key == "latitude") site.latitude = value;
    if (key == "gravity") site.gravity = value;
  }
  return site;
}

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
      title_of(kind), quoted(site.latitude.value_or("45 deg")),
      site.latitude ? from(site.latitude_place) : ": correct it",
      quoted(site.gravity.value_or("9.80665 m/s^2")), site.gravity ? from(site.gravity_place) : "");
  if (kind == StudyKind::strapdown)
    text +=
        "\n\n[plan]\nkind       = \"strapdown\"\nstatic_min = \"2 s\"        # the shortest rest "
        "that counts\n"
        "# On a table with fixed axes (not moved by hand), gyros that see the Earth: "
        "accelerometers\n"
        "# are read in turns, too, and show their lever arms and their delay.\n"
        "# accelerometers_in_turns = true\n";
  else
    text += ": a recording in m/s^2 is divided by it, and K1 is off by as many ppm\n" +
            plan_text(plan, kind == StudyKind::sweep ? Dwells::alike : Dwells::as_recorded) +
            "\n[readout]\n" +
            (plan && !plan->noise.empty()
                 ? plan->noise
                 : "accelerometer_noise = \"5 ug\"      # 1 sigma of a sample: of the data sheet, "
                   "or of a rest\n") +
            "gimbal_noise        = \"5 arcsec\"\n";
  if (!mapping.empty()) text += "\n" + mapping;
  if (kind == StudyKind::study || kind == StudyKind::sweep) text += simulated_text();
  // Accelerometers of a real platform have errors of their own, beside which any other hides.
  const bool real = kind == StudyKind::platform || kind == StudyKind::diagnose;
  const std::string_view more = real ? ", \"accelerometer\"" : "";
  text += filter_text(kind == StudyKind::diagnose ? "nominal" : "eq5", "eq5", more);
  if (kind != StudyKind::diagnose) text += filter_text("eq6", "eq6", more);
  if (kind == StudyKind::diagnose) text += own_term_text;
  if (kind == StudyKind::study || kind == StudyKind::sweep)
    text +=
        "\n[monte_carlo]\nruns = 200               # each draws parameters and noise anew\nseed "
        "= 1\n";
  if (kind == StudyKind::sweep) text += sweep_text(plan);
  return text;
}

}  // namespace drift::cli
