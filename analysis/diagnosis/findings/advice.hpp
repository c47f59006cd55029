#pragma once

#include <limits>
#include <string>
#include <vector>

#include "analysis/diagnosis/findings/question.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::diagnosis {

/// A pair that an advice is about: one is true, the other is taken for it.
struct AdvisedPair {
  planning::Contest pair;         ///< among the alternatives of the advice
  double now = 0.0, after = 0.0;  ///< separation without and with the plan of the advice [1 sigma]
};

/// What is advised about causes that a test has left equally likely, or hides.
struct Advice {
  enum class Kind {
    add,     ///< the positions of `plan`
    told,    ///< nothing: this plan tells all that was asked
    unlike,  ///< nothing: no candidate leaves a trace like that of the first alternative
    twins,   ///< no position: the traces are the same in the whole pool
    hidden,  ///< no position: all that may be added leaves the pairs below 2 sigma
    varies,  ///< no position: the first alternative follows what varies while a test runs
    repeat,  ///< nothing explains the misfit: repeat the position where most of it is
  };
  Kind kind = Kind::add;
  std::vector<Alternative> alternatives;
  std::vector<AdvisedPair> pairs;  ///< closest first
  Sizes sizes = Sizes::as_found;
  std::vector<Position> plan;      ///< to be added behind the plan, in this order
  double usual_dwell = 0.0;        ///< of the plan [s]
  double wanted = 0.0;             ///< separation that is enough [1 sigma]
  std::vector<std::string> names;  ///< what was asked for, as a user wrote it
  std::size_t asked = 0;           ///< pairs of the question, told apart already or not
  std::size_t most = 0;            ///< additions that a plan may have
  std::size_t pool = 0;            ///< additions that were possible
  int position = 0;                ///< of Kind::repeat, 1-based; 0: not located
  std::string position_name;       ///< of it
  double expected_sigma = none;    ///< separation of the closest pair with the plan [1 sigma]
  double now_sigma = none;         ///< without it
  double verified_sigma = none;    ///< found by simulating the extended plan; NaN: not done

  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace drift::diagnosis
