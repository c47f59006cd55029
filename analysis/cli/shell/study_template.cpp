#include "analysis/cli/shell/study_template.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/recording/rows/quality_card.hpp"

namespace drift::cli {
namespace {

/// A right-handed frame with the axis up (or down) that the accelerometers show. Headings leave no
/// trace in them.
std::string axes_of(const std::array<double, 3>& force) {
  constexpr std::string_view up[] = {"x=U y=N z=W", "x=W y=U z=N", "x=N y=W z=U"};
  constexpr std::string_view down[] = {"x=D y=W z=N", "x=N y=D z=W", "x=W y=N z=D"};
  std::size_t vertical = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(force[i]) > std::abs(force[vertical])) vertical = i;
  return std::string(force[vertical] < 0.0 ? down[vertical] : up[vertical]);
}

double mean_of(const Channel* channel, std::size_t first, std::size_t end) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = first; channel != nullptr && i < end; ++i)
    if (std::isfinite(channel->values[i])) {
      sum += channel->values[i];
      ++count;
    }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
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

std::string plan_text(const std::optional<RecordedPlan>& plan, Dwells dwells) {
  const std::string heading =
      "\n[plan]\nmode   = \"free\"        # between entries: \"free\", or \"level\" with Earth "
      "rate "
      "commanded\nentry  = \"caged\"       # how a position is entered: \"caged\", or "
      "\"torqued\"\n";
  if (!plan)
    return heading +
           "preset = \"six\"         # or [[plan.position]] one by one, with name and axes\n"
           "dwell  = \"60 min\"\nsample = \"60 s\"\n";
  std::string text =
      heading + fmt::format("sample = \"{:.9g} s\"      # of the recording\n", plan->sample);
  if (dwells == Dwells::alike)
    text += fmt::format("dwell  = \"{:.9g} s\"\n", plan->positions.front().length);
  text +=
      "# What is up is of the recording. Which axis points North no accelerometer shows: correct "
      "N, S, E, W.\n";
  for (std::size_t i = 0; i < plan->positions.size(); ++i) {
    text += fmt::format("[[plan.position]]\nname  = \"position {}\"\naxes  = \"{}\"\n", i + 1,
                        plan->positions[i].axes);
    if (dwells == Dwells::as_recorded)
      text += fmt::format("dwell = \"{:.9g} s\"\n", plan->positions[i].length);
  }
  return text;
}

/// Multiples of a dwell are whole numbers of samples as it is.
std::string sweep_text(const std::optional<RecordedPlan>& plan) {
  const double dwell = plan ? plan->positions.front().length : 1200.0;  // [s]
  return fmt::format(
      "\n# Every combination of these values is a study point.\n[sweep]\n\"plan.dwell\" = "
      "[\"{:.9g} s\", \"{:.9g} s\", \"{:.9g} s\"]\n",
      dwell, 2.0 * dwell, 4.0 * dwell);
}

constexpr std::string_view terms =
    "terms    = [\"fixed_drift\", \"g_drift\", \"gyro_misalignment\"]  # `driftscope terms` lists "
    "all\n";

std::string filter_text(std::string_view name, std::string_view coupling) {
  return fmt::format(
      "\n[[filter]]\nname     = \"{}\"\ncoupling = \"{}\"            # the drift "
      "equation: \"eq5\", \"eq6\" or \"lambda\"\n{}",
      name, coupling, terms);
}

std::string simulated_text() {
  return fmt::format(
      "\n# What is simulated; parameters without a value are drawn from their "
      "priors.\n[truth]\ncoupling = \"eq5\"\n{}[truth.parameters]\neta_x = \"100 "
      "arcsec\"\n",
      terms);
}

}  // namespace

RecordedPlan recorded_plan(const Recording& r) {
  RecordedPlan plan;
  plan.sample = quality_card(r, RecordingKind::platform).interval;
  const Channel *position = r.find("position"), *time = r.find("time");
  for (std::size_t first = 0, end = 0; first < r.rows(); first = end) {
    end = first + 1;
    while (end < r.rows() && (!position || position->values[end] == position->values[first])) ++end;
    const double span = time->values[end - 1] - time->values[first] + plan.sample;
    std::array<double, 3> force{};
    for (std::size_t i = 0; i < 3; ++i)
      force[i] = mean_of(r.find(fmt::format("acc_{}", "xyz"[i])), first, end);
    plan.positions.push_back({std::round(span / plan.sample) * plan.sample, axes_of(force)});
  }
  return plan;
}

std::string study_template(StudyKind kind, const std::optional<RecordedPlan>& plan,
                           const std::string& mapping) {
  std::string text = fmt::format(
      "# `driftscope check` says where a value is wrong, `driftscope schema` what may stand here.\n"
      "schema = 1\ntitle  = \"{}\"\n\n[site]\nlatitude = \"45 deg\"        # of the laboratory: "
      "correct it\n",
      title_of(kind));
  if (kind == StudyKind::strapdown)
    text +=
        "gravity  = \"9.80665 m/s^2\" # there\n\n[plan]\nkind       = \"strapdown\"\nstatic_min "
        "= \"2 s\"        # the shortest rest that counts\n";
  else
    text += plan_text(plan, kind == StudyKind::sweep ? Dwells::alike : Dwells::as_recorded) +
            "\n[readout]\naccelerometer_noise = \"5 ug\"      # 1 sigma of a sample: of the data "
            "sheet, or of a rest\ngimbal_noise        = \"5 arcsec\"\n";
  if (!mapping.empty()) text += "\n" + mapping;
  if (kind == StudyKind::study || kind == StudyKind::sweep) text += simulated_text();
  text += filter_text(kind == StudyKind::diagnose ? "nominal" : "eq5", "eq5");
  if (kind != StudyKind::diagnose) text += filter_text("eq6", "eq6");
  if (kind == StudyKind::study || kind == StudyKind::sweep)
    text +=
        "\n[monte_carlo]\nruns = 200               # each draws parameters and noise anew\nseed "
        "= 1\n";
  if (kind == StudyKind::sweep) text += sweep_text(plan);
  return text;
}

}  // namespace drift::cli
