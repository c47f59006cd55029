#include "analysis/strapdown/ladder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace drift::strapdown {
namespace {

constexpr double tolerated = 1.0;  // standard errors by which it may seem worse on the other data

std::vector<std::size_t> joined(std::vector<std::size_t> a, const std::vector<std::size_t>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::size_t training(std::size_t count, int folds) {
  const auto n = static_cast<std::size_t>(folds);
  return count - (count + n - 1) / n;
}

/// The parts of a gyro model that can be left out.
struct Parts {
  bool scale = false, misalignment = false;
  DriftOrder drift = DriftOrder::fixed;

  std::string name() const {
    std::string text = "bias";
    if (scale) text += " + scale";
    if (misalignment) text += " + misalignment";
    if (drift == DriftOrder::input_axis) text += " + input-axis g-drift";
    if (drift >= DriftOrder::g_sensitive) text += " + g-drift";
    if (drift >= DriftOrder::g2_sensitive) text += " + g^2-drift";
    return text;
  }
  bool operator==(const Parts&) const = default;
};

class GyroLadder {
 public:
  GyroLadder(Coupling equation, AccelerometerModel accelerometer, const Evidence& evidence,
             const Scoring& scoring, std::vector<Trial>& trials)
      : equation_(equation),
        accelerometer_(accelerometer),
        evidence_(evidence),
        scoring_(scoring),
        trials_(trials) {
    best_ = {parts_, tried(parts_)};
    record(best_.trial);
  }

  /// Compares with the best so far and takes its place if it is better.
  bool climb(const Parts& parts) {
    Trial trial = tried(parts);
    judge(trial, best_.trial);
    if (trial.verdict == Verdict::accepted && parts.drift > best_.parts.drift &&
        may_be_earth_rate(parts)) {
      trial.verdict = Verdict::rejected;
      trial.reason = "no larger than Earth rate, which this model leaves out";
    }
    record(trial);
    if (trial.verdict == Verdict::accepted) best_ = {parts, trial};
    return trial.verdict == Verdict::accepted;
  }

  /// Leaves a part out of the best so far, for good unless that is a loss.
  void leave_out(const Parts& without) {
    if (without == best_.parts || known(without)) return;
    const Trial shorter = tried(without);
    Trial whole = best_.trial;
    judge(whole, shorter);
    if (whole.verdict == Verdict::accepted) {
      Trial shown = shorter;
      judge(shown, best_.trial);
      shown.verdict = Verdict::rejected;
      shown.reason = "what is left out is needed";
      record(shown);
      return;
    }
    Trial shown = shorter;
    judge(shown, best_.trial);
    shown.verdict = Verdict::accepted;
    shown.reason = "what is left out is not missed";
    record(shown);
    best_ = {without, shown};
  }

  const Parts& parts() const { return best_.parts; }
  Final final_model() const {
    const Model model = model_of(best_.parts);
    return {best_.parts.name(), model, *best_.trial.rotation, fit(model, evidence_, Asked::all)};
  }

 private:
  struct Best {
    Parts parts;
    Trial trial;
  };

  /// Whether what drift hangs on the specific force may be Earth rate: that turns with the
  /// attitude, too, and makes coefficients of up to its own size.
  bool may_be_earth_rate(const Parts& parts) const {
    const Estimate drift = fit(model_of(parts), evidence_, Asked::all).drift;
    return std::ranges::all_of(drift.params, [&](std::size_t p) {
      return TermLibrary::specs[p].group.view() == "D_F" ||
             std::abs(drift.theta[p]) <= detail::earth_rate;
    });
  }

  Model model_of(const Parts& parts) const {
    Model model{equation_, accelerometer_, parts.drift, {}};
    if (parts.scale) model.turning = group<"s">();
    if (parts.misalignment)
      model.turning = joined(joined(model.turning, group<"eta">()), group<"xi">());
    return model;
  }

  std::string equation_of(const Parts& parts) const {
    return parts.misalignment ? std::string(key_of(equation_)) : "any";
  }

  const Trial* known(const Parts& parts) const {
    for (const Trial& trial : trials_)
      if (trial.name == parts.name() && trial.equation == equation_of(parts)) return &trial;
    return nullptr;
  }

  Trial tried(const Parts& parts) const {
    const Model model = model_of(parts);
    Trial trial;
    trial.name = parts.name();
    trial.equation = equation_of(parts);
    // What was scored for another equation need not be scored again.
    if (const Trial* earlier = known(parts); earlier != nullptr && earlier->rotation) {
      trial.parameters = earlier->parameters;
      trial.dwell = earlier->dwell;
      trial.rotation = earlier->rotation;
      return trial;
    }
    const std::size_t drifting = parameters_of(model.drift).size();
    trial.parameters = drifting + model.turning.size();
    const std::size_t dwells = training(evidence_.dwells.size(), scoring_.division.folds);
    const std::size_t turns = training(evidence_.rotations.size(), scoring_.division.folds);
    if (3 * dwells < drifting + 3 || 2 * turns < model.turning.size() + 2) {
      trial.verdict = Verdict::skipped;
      trial.reason = "too few dwells or rotations for its parameters";
      return trial;
    }
    const Errors inside = in_sample_errors(model, evidence_, Asked::all);
    const Errors outside = held_out_errors(model, evidence_, Asked::all, scoring_.division);
    trial.dwell =
        score_of(inside.dwell, outside.dwell, unit::deg_per_s.to_si, scoring_.division.seed);
    trial.rotation =
        score_of(inside.rotation, outside.rotation, unit::deg.to_si, scoring_.division.seed);
    return trial;
  }

  static void judge(Trial& trial, const Trial& against) {
    trial.against = against.name;
    if (trial.verdict == Verdict::skipped) return;
    trial.verdict = Verdict::rejected;
    trial.z_dwell = paired_gain(against.dwell->errors, trial.dwell->errors);
    trial.z_rotation = paired_gain(against.rotation->errors, trial.rotation->errors);
    const bool better = trial.z_dwell > surely_better || trial.z_rotation > surely_better;
    const bool no_worse = trial.z_dwell > -tolerated && trial.z_rotation > -tolerated;
    if (better && no_worse) {
      trial.verdict = Verdict::accepted;
      trial.reason = trial.z_rotation > surely_better ? "held-out rotations are predicted better"
                                                      : "held-out dwells are predicted better";
    } else if (!no_worse) {
      trial.reason = trial.z_rotation > -tolerated ? "held-out dwells get worse"
                                                   : "held-out rotations get worse";
    } else if (trial.z_dwell == 0.0 && trial.z_rotation == 0.0) {
      trial.reason = "changes no prediction";
    } else {
      trial.reason = "no sure gain on held-out data";
    }
    if (trial.equation == "eq6")
      trial.reason += "; eq. (6) gives misalignment no part in case motion";
  }

  void record(const Trial& trial) {
    for (const Trial& earlier : trials_)
      if (earlier.name == trial.name && earlier.equation == trial.equation &&
          earlier.against == trial.against)
        return;
    trials_.push_back(trial);
  }

  Coupling equation_;
  AccelerometerModel accelerometer_;
  const Evidence& evidence_;
  const Scoring& scoring_;
  std::vector<Trial>& trials_;
  Parts parts_;
  Best best_;
};

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reference:
      return "reference";
    case Verdict::accepted:
      return "accepted";
    case Verdict::rejected:
      return "rejected";
    case Verdict::skipped:
      break;
  }
  return "skipped";
}

AccelerometerModel climb_accelerometers(const Evidence& evidence, const Scoring& scoring,
                                        std::vector<Trial>& trials) {
  constexpr std::array<std::pair<AccelerometerModel, const char*>, 4> rungs{
      {{AccelerometerModel::nominal, "nominal"},
       {AccelerometerModel::bias_scale, "bias + scale"},
       {AccelerometerModel::misaligned, "bias + scale + misalignment"},
       {AccelerometerModel::quadratic, "bias + scale + misalignment + quadratic"}}};
  AccelerometerModel best = AccelerometerModel::nominal;
  Trial best_trial;
  for (const auto& [which, name] : rungs) {
    Trial trial;
    trial.name = name;
    trial.equation = "any";
    trial.parameters = parameters_of(which).size();
    trial.against = best_trial.name;
    if (training(evidence.dwells.size(), scoring.division.folds) < trial.parameters + 1) {
      trial.verdict = Verdict::skipped;
      trial.reason = "too few dwells for its parameters";
      trials.push_back(trial);
      continue;
    }
    const Model model{Coupling::eq5, which, DriftOrder::fixed, {}};
    trial.gravity =
        score_of(in_sample_errors(model, evidence, Asked::gravity).gravity,
                 held_out_errors(model, evidence, Asked::gravity, scoring.division).gravity,
                 1.0 / scoring.gravity, scoring.division.seed);
    if (best_trial.gravity) {
      trial.z_dwell = paired_gain(best_trial.gravity->errors, trial.gravity->errors);
      const bool better = trial.z_dwell > surely_better;
      trial.verdict = better ? Verdict::accepted : Verdict::rejected;
      trial.reason =
          better ? "held-out dwells are closer to 1 g" : "no sure gain on held-out dwells";
    }
    trials.push_back(trial);
    if (trial.verdict == Verdict::rejected) continue;
    best = which;
    best_trial = trial;
  }
  return best;
}

Final climb_gyros(Coupling equation, AccelerometerModel accelerometer, const Evidence& evidence,
                  const Scoring& scoring, std::vector<Trial>& trials) {
  GyroLadder ladder(equation, accelerometer, evidence, scoring, trials);
  const auto with = [&](auto&& change) {
    Parts parts = ladder.parts();
    change(parts);
    return parts;
  };
  ladder.climb(with([](Parts& p) { p.scale = true; }));
  ladder.climb(with([](Parts& p) { p.scale = p.misalignment = true; }));
  ladder.climb(with([](Parts& p) { p.drift = DriftOrder::input_axis; }));
  ladder.climb(with([](Parts& p) { p.drift = DriftOrder::g_sensitive; }));
  ladder.climb(with([](Parts& p) { p.drift = DriftOrder::g2_sensitive; }));
  ladder.leave_out(with([](Parts& p) { p.scale = false; }));
  ladder.leave_out(with([](Parts& p) { p.misalignment = false; }));
  return ladder.final_model();
}

}  // namespace drift::strapdown
