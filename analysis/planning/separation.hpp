#pragma once

#include <span>
#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::planning {

/// Information of a test on nominal parameters (t) and signatures (e), in prior sigmas. That of
/// tests whose attitudes start anew adds up.
struct Information {
  MatX tt, te, ee;
  Information& operator+=(const Information& o);
};

Information information_of(const inference::LinearProblem& problem,
                           const inference::NoiseModel& noise);

/// What a way that the truth may be adds to the nominal model. Empty: nothing.
struct Trace {
  std::vector<int> columns;  ///< among all signatures
  VecX amplitude;            ///< of each, in prior sigmas
};

/// Two ways that the truth may be, by index: one is true, the other is taken for it.
struct Contest {
  std::size_t truth = 0, rival = 0;
  bool operator==(const Contest&) const = default;
};

/// How far apart two of them are.
struct Separation {
  double sigma = 0.0;  ///< of the rival, all its parameters at their best, from the truth [1 sigma]
  double alone = 0.0;  ///< of the nominal model from the truth [1 sigma]
  double unlike =
      0.0;  ///< part of the truth's trace that the rival cannot copy however large it is, 0..1
};

/// Separation of each pair. If c is true and d its rival,
///   sigma^2 = a_c' (C_cc - C_cd (C_dd + 1)^-1 C_dc) a_c,   unlike = the same without the 1, over
///   a_c' C_cc a_c,
/// C the information on the signatures that is left by the nominal parameters, in prior sigmas.
/// Against the nominal model sigma^2 = a_c' C_cc a_c, and unlike is its part of the information
/// before the nominal parameters took theirs.
std::vector<Separation> separations(const Information& info, std::span<const Trace> traces,
                                    std::span<const Contest> pairs);

}  // namespace drift::planning
