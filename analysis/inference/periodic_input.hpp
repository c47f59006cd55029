#pragma once

#include <cmath>

#include "analysis/inference/equation.hpp"
#include "analysis/inference/projector.hpp"

namespace drift::inference {

/// The strongest sinusoid of any period and phase in one equation alone: what a disturbance from
/// outside does that comes back (pickup, a pump, a thermostat, a servo that hunts).
struct PeriodicInput {
  Equation equation = Equation::rate;
  int axis = 0;
  double period_s = 0.0;
  double cosine = 0.0, sine = 0.0;  ///< from the beginning of a recording on; rad/s, g, rad
  /// Projected score of sine and cosine, chi-square of 2 degrees where there is nothing.
  double T = 0.0;
  /// Independent tries that periods and equations are worth at this score: by Davies (1987,
  /// Biometrika 74), for two degrees and data spread evenly over the test, the highest of a
  /// spectrum exceeds T by chance with at most W sqrt(T/2) exp(-T/2), W = (4 pi var t)^1/2 times
  /// the band (Baluev 2008, MNRAS 385). The part of a band of even prior that a line of score T
  /// fills is the inverse of the same number.
  double log_tries = 0.0;

  double amplitude() const { return std::hypot(cosine, sine); }
  double p_value() const;
  /// Log evidence, against none, of a line whose size is known to two decades from what the test
  /// could see up, every order of magnitude alike, and whose phase, period and equation are not.
  double log_evidence() const;
  /// The same where the size is given: what it gains less what is paid for period and equation.
  double log_gain() const { return 0.5 * T - log_tries; }
};

/// Periods from half the test (of several recordings the longest, each by its own clock, as all
/// that runs with time: in whatever order they are given) down to two samples (of sensors on a
/// case, whose rows come in bursts, two rows on average), in every equation that is read: the
/// platform's rate about each axis, each accelerometer and each resolver (a rounded readout
/// excepted, whose rounding comes back by itself). Where lines stand out is seen by the spectrum of
/// the innovations of each equation; how much the best of each is worth, by its projected score.
PeriodicInput strongest_periodic_input(const LinearProblem& problem, const Projector& projector);

/// What it makes of the rows, whitened, parameters projected out.
VecX trace_of(const PeriodicInput& input, const LinearProblem& problem, const Projector& projector);

}  // namespace drift::inference
