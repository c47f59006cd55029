#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/named.hpp"
#include "core/params/param_spec.hpp"
#include "core/physics/assembly.hpp"
#include "core/physics/expression/program.hpp"

namespace drift {

/// What a user's own term adds to.
enum class OwnSlot {
  rate,           ///< rate of the platform that no gyro takes part in, platform axes [rad/s]
  drift,          ///< w_l of one gyro [rad/s]
  accelerometer,  ///< output of one accelerometer [g]
  gimbal,         ///< angle that one resolver shows [rad]
};

/// One thing a term can act on, as a study file calls it.
struct OwnTarget {
  OwnSlot slot = OwnSlot::rate;
  int axis = 0;
  constexpr bool operator==(const OwnTarget&) const = default;
};
inline constexpr Named<OwnTarget> own_targets[] = {{"rate.x", {OwnSlot::rate, 0}},
                                                   {"rate.y", {OwnSlot::rate, 1}},
                                                   {"rate.z", {OwnSlot::rate, 2}},
                                                   {"drift.x", {OwnSlot::drift, 0}},
                                                   {"drift.y", {OwnSlot::drift, 1}},
                                                   {"drift.z", {OwnSlot::drift, 2}},
                                                   {"accelerometer.x", {OwnSlot::accelerometer, 0}},
                                                   {"accelerometer.y", {OwnSlot::accelerometer, 1}},
                                                   {"accelerometer.z", {OwnSlot::accelerometer, 2}},
                                                   {"gimbal.outer", {OwnSlot::gimbal, 0}},
                                                   {"gimbal.middle", {OwnSlot::gimbal, 1}},
                                                   {"gimbal.inner", {OwnSlot::gimbal, 2}}};

/// How many terms a study may bring, and how many parameters each.
inline constexpr std::size_t most_own_terms = 6;
inline constexpr std::size_t most_own_parameters = 6;

/// A term of a study file, [[term]], read and compiled.
struct OwnTerm {
  std::string key, title;
  std::string equation;     ///< with what it is added to, as the library's are: "w_l,x += A t"
  std::string declaration;  ///< all that it was made of: the same text is the same term
  OwnTarget target;
  EquationProgram program;
  Needs needs;
  std::vector<ParamSpec> params;
};

/// The own terms of a study, and the further columns of a recording that they read, by number.
struct OwnTermSet {
  std::vector<OwnTerm> terms;
  std::vector<std::string> covariates;

  friend bool operator==(const OwnTermSet& a, const OwnTermSet& b) {
    if (a.terms.size() != b.terms.size()) return false;
    for (std::size_t i = 0; i < a.terms.size(); ++i)
      if (a.terms[i].declaration != b.terms[i].declaration) return false;
    return true;
  }
};

}  // namespace drift
