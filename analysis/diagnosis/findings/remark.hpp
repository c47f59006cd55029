#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/identification/clock_doubt.hpp"
#include "analysis/identification/common_scale.hpp"
#include "analysis/identification/delay_doubt.hpp"
#include "analysis/identification/memory_doubt.hpp"
#include "analysis/identification/spikes.hpp"
#include "analysis/identification/stated_loop.hpp"
#include "core/estimate/estimate_result.hpp"
#include "core/physics/drift_model.hpp"

namespace drift::diagnosis {

/// A term or one axis of it, and how a candidate's line calls it.
struct NamedEffect {
  std::string term, axis, label;
};

/// What a reader must know beside the verdict, as facts; the words are the report's.
namespace remark {

/// What was done to the input, or what is the matter with it, said where it was read.
struct Input {
  std::string text;
};
/// A gimbal that reads a constant too much, said where it was read.
struct GimbalOffZero {
  std::string text;
};
/// A gyro on a case at the end of its range, said where it was read.
struct SaturatedGyro {
  std::string text;
};
/// Recordings state a loop that removed misalignments, and the nominal model has another coupling.
struct LoopLeftOut {
  identification::StatedLoop loop;
  std::string filter;  ///< name of the nominal one
};
/// With the explanation in the model something is left that is just significant.
struct JustSignificantLeft {};
/// Another drift equation explains it, but lambda is within 3 sigma of the nominal one.
struct LambdaNotSettled {};
/// Of causes that fit together, one does nothing for held-out positions.
struct MemberNotConfirmed {};
/// The cause fits, and held-out positions are predicted no better with it; or they are, and whole
/// recordings are not (HeldOut::recordings_disagree).
struct NotPredicted {
  bool of_recordings = false;
};
/// Nothing is missing, noise as declared or not, with so much probability.
struct OrNoise {
  double probability;
};
/// Nothing is significant, and still that something is missing is more probable than that nothing
/// is, noise as declared or not.
struct LikelierMissing {
  double nothing = 0.0;  ///< probability that nothing is missing
};
/// With the cause in the model the innovations are not white; p by chance, without it and with it.
struct LeftNotWhite {
  double before = 1.0, after = 1.0;
};
/// Isolated samples left out, and samples given less weight.
struct SamplesLeftOut {
  std::vector<identification::Spike> removed;
  std::size_t lowered = 0;
};
/// No candidate fits; an unknown input of free form in one equation would.
struct FreeInputExplains {
  std::string equation;
  double gain = 0.0;      ///< of twice the log likelihood
  bool constant = false;  ///< in each recording
};
/// No candidate fits; a sinusoid in one equation would. Or beside a cause that fits there is one.
struct PeriodExplains {
  std::string equation;
  double period_s = 0.0;
  double amplitude = 0.0;
  std::string unit;      ///< of the amplitude
  double p_value = 1.0;  ///< over all periods and equations
  bool beside_cause = false;
};
/// Torquer cross-talk moves lambda as misalignment does.
struct CrosstalkMovesLambda {};
/// What looks like noise of all gyros acts on one.
struct DrivesOneGyro {
  int axis = 0;
  double gain = 0.0;  ///< of twice the log likelihood
};
/// White noise so far above what is declared that no study declares it so wrong.
struct IncredibleNoise {
  std::string component;  ///< accelerometer_white, gimbal_white
  double factor = 1.0;    ///< estimated over declared
  double chance = 1.0;    ///< of so much or more, or as far below, by NoisePrior
};
/// With these in the model, what is the strongest of what is left.
struct StrongestLeft {
  std::vector<std::string> labels;
  std::string strongest;
};
/// Nominal parameters that the fit takes so far from their priors that these are seldom right.
struct BeyondPrior {
  struct Parameter {
    ParameterEstimate estimate;
    double sigmas = 0.0;  ///< of the prior, from its mean
    double chance = 1.0;  ///< that any of all lies so far where every prior is right, at most
  };
  std::vector<Parameter> parameters;  ///< in the order of the fit
  std::size_t of = 0;                 ///< parameters with a prior
  /// What the scale factors of the accelerometers among them have in common.
  std::optional<identification::CommonScale> scales;
  /// Something stands out, and with priors as wide as these parameters lie from theirs nothing.
  bool explains = false;
  bool taken = false;  ///< what was found takes these priors for wrong: it has room for them
  /// The noise that is told is what is there with that room, as is the patched model; else that
  /// with all priors right.
  bool noise_beside = false;
  const Parameter& farthest() const {
    return *std::ranges::max_element(parameters, {}, &Parameter::sigmas);
  }
};
/// The other way round about the priors of the nominal model: what was found takes them for right,
/// or some for wrong.
struct OtherPriors {
  enum class Are { right, wrong } are = Are::right;
  std::vector<std::size_t> parameters;  ///< whose priors may be wrong
  std::vector<NamedEffect> effects;     ///< missing then; empty: none of the library
  double probability = 0.0;
};
/// The other of eq. (5) and (6) in the place of the nominal one.
struct OtherEquation {
  Coupling nominal = Coupling::eq5;
  double gain = 0.0;          ///< twice the log of the odds of the other
  bool beside_cause = false;  ///< with a cause in the model
  bool of_case = false;       ///< of gyros on a case
  bool open() const;          ///< the test does not tell the two apart
};
/// Terms of the model, a cause among them, whose memory follows another path than the platform; and
/// those, of alternatives too, whose memory hangs on when the platform was turned in a gap.
struct MemoryOff {
  std::vector<MemoryLeftOut> terms;
  std::vector<identification::MemoryGaps> gaps = {};
};
/// Times that are all too long or too short by one factor explain the test as well as what was
/// found, without any of that in the model; or where nothing was found, they explain it.
struct TimesInstead {
  identification::ClockDoubt clock;
  /// Of such times, in one recording of 1000, against the causes that were found.
  double odds = std::numeric_limits<double>::infinity();
};
/// Accelerometers and gimbals of different instants explain the test without any of what was found.
struct DelayInstead {
  identification::DelayDoubt delay;
  /// Of that, in one recording of 1000, against the causes that were found; infinite without any.
  double odds = std::numeric_limits<double>::infinity();
};
/// The magnetic field is that of a dipole: none was recorded or declared.
struct FieldAssumed {
  Vec3 field_l = Vec3::Zero();  ///< [T]
};
/// An effect that would explain the test, were the noise that drives the platform none.
struct NoiseOrEffect {
  NamedEffect effect;
  double sigmas = 0.0;
};
/// Advice was wanted and could not be made.
struct NoAdvice {
  std::string reason;
};

// Of a recording on a case.

/// What is called declared is the scatter within dwells.
struct NoDeclaredNoise {};
/// Of the D_I that are named the common part is taken out.
struct CommonDriftUnseen {};
/// What the motion cannot show.
struct NotObservable {
  std::string what, reason;
};

}  // namespace remark

using Remark =
    std::variant<remark::Input, remark::GimbalOffZero, remark::SaturatedGyro, remark::LoopLeftOut,
                 remark::JustSignificantLeft, remark::LambdaNotSettled, remark::MemberNotConfirmed,
                 remark::NotPredicted, remark::OrNoise, remark::LikelierMissing,
                 remark::SamplesLeftOut, remark::FreeInputExplains, remark::PeriodExplains,
                 remark::LeftNotWhite, remark::CrosstalkMovesLambda, remark::DrivesOneGyro,
                 remark::IncredibleNoise, remark::StrongestLeft, remark::BeyondPrior,
                 remark::OtherPriors, remark::OtherEquation, remark::MemoryOff,
                 remark::TimesInstead, remark::DelayInstead, remark::FieldAssumed,
                 remark::NoiseOrEffect, remark::NoAdvice, remark::NoDeclaredNoise,
                 remark::CommonDriftUnseen, remark::NotObservable>;

}  // namespace drift::diagnosis
