#include "analysis/strapdown/identify.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace drift::strapdown {
namespace {

constexpr std::size_t least_dwells = 6, least_rotations = 4;

void check(const StrapdownOptions& options) {
  DRIFT_EXPECTS(options.folds >= 2 && options.repeats >= 1 && options.static_min > 0.0);
  std::vector<std::string> problems;
  if (options.equations.empty())
    problems.emplace_back("no [[filter]] (a coupling eq5 or eq6 is expected)");
  for (const Coupling c : options.equations)
    if (!facts(c).other)
      problems.emplace_back(
          "[[filter]] coupling of a strapdown plan (eq5 or eq6 is expected: gyros on the case have "
          "no "
          "servo loop). Choose one of the two");
  if (!problems.empty()) throw InputError(ExitCode::config, std::move(problems));
}

void check(const StrapdownResult& result, const Evidence& evidence) {
  std::vector<std::string> problems;
  if (evidence.dwells.size() < least_dwells)
    problems.push_back(fmt::format(
        "{}: {} dwells of {} s in which both sensors are quiet ({} or more are expected). Rest the "
        "case more often or longer, or lower plan.static_min",
        result.source, evidence.dwells.size(), result.options.static_min, least_dwells));
  else if (evidence.rotations.size() < least_rotations)
    problems.push_back(fmt::format(
        "{}: {} turns between dwells without a gap, {} with one ({} or more are expected). Record "
        "without gaps",
        result.source, evidence.rotations.size(), result.rotations_omitted, least_rotations));
  if (!problems.empty()) throw InputError(ExitCode::recording, std::move(problems));
}

std::vector<EquationContest> contest_of(const std::vector<Final>& accepted) {
  const auto of = [&](Coupling equation) {
    return std::find_if(accepted.begin(), accepted.end(),
                        [&](const auto& f) { return f.model.equation == equation; });
  };
  const auto five = of(Coupling::eq5), six = of(Coupling::eq6);
  if (five == accepted.end() || six == accepted.end()) return {};
  return {
      {five->rotation, six->rotation, paired_gain(six->rotation.errors, five->rotation.errors)}};
}

}  // namespace

preparation::NoiseCard noise_of(const Recording& recording, const DwellSearch& search) {
  std::vector<preparation::RestingRows> rests;
  for (const Dwell& d : search.dwells) rests.push_back({d.first, d.last});
  return preparation::noise_card(recording, RecordingKind::strapdown, rests);
}

StrapdownResult identify_strapdown(const Recording& recording, const StrapdownOptions& options) {
  check(options);
  StrapdownResult result;
  result.source = recording.source;
  result.options = options;
  const Signals signals = signals_of(recording);
  result.search = find_dwells(signals, {.static_min = options.static_min});
  Rotations turns = find_rotations(signals, result.search.dwells);
  const Evidence evidence{result.search.dwells, std::move(turns.all)};
  result.rotations = evidence.rotations.size();
  result.rotations_omitted = turns.omitted;
  check(result, evidence);
  result.noise = noise_of(recording, result.search);

  const int folds = std::min(options.folds, static_cast<int>(evidence.dwells.size()));
  const Scoring scoring{{folds, options.repeats, options.seed}, options.gravity};
  const auto accelerometer = climb_accelerometers(evidence, scoring, result.accelerometer_trials);
  std::vector<Coupling> seen;
  for (const Coupling equation : options.equations) {
    if (std::find(seen.begin(), seen.end(), equation) != seen.end()) continue;
    seen.push_back(equation);
    result.accepted.push_back(
        climb_gyros(equation, accelerometer, evidence, scoring, result.gyro_trials));
  }
  result.parameters = parameters_of(result.accepted.front());
  result.unobservable = unobservable_of(result.accepted.front());
  result.contest = contest_of(result.accepted);
  return result;
}

}  // namespace drift::strapdown
