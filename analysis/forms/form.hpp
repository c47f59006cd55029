#pragma once

#include <string>
#include <vector>

#include "analysis/forms/instants.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift::forms {

/// The factor of a form that hangs on where the platform is and what acts on it.
struct AttitudePart {
  enum class Kind {
    one,         ///< 1
    product,     ///< of up to three quantities
    saturation,  ///< tanh(f/S) of one specific force
    harmonic,    ///< a cos(n gimbal) + b sin(n gimbal)
    above,       ///< step(f - C)
    below,       ///< step(C - f)
    beyond,      ///< step(abs(f) - C)
  };
  Kind kind = Kind::one;
  std::vector<std::size_t> of;  ///< quantities; of the others the axis or the gimbal
  int order = 1;                ///< of a harmonic
  double setting = 0.0;         ///< S or C [g]
  double sigma = 0.0;           ///< how well it is known
};

/// The factor that hangs on time.
struct TimePart {
  enum class Kind {
    one,
    power,              ///< t^n [h]
    decay,              ///< exp(-t/T)
    decay_in_position,  ///< exp(-t_position/T)
    harmonic,           ///< a cos(2 pi t/P) + b sin(2 pi t/P)
    onset,              ///< step(t - T0)
    window,             ///< step(t - T0) step(T1 - t)
  };
  Kind kind = Kind::one;
  int order = 1;         ///< of a power
  double setting = 0.0;  ///< T, P or T0 [s]
  double end = 0.0;      ///< T1 [s]
  double sigma = 0.0;    ///< how well they are known
};

/// An effect that the grammar has: what acts, on what.
struct Form {
  OwnTarget place;
  AttitudePart where;
  TimePart when;
  double log_prior = 0.0;  ///< log of the chance that the grammar gives it, all forms together 1
};

/// Values in every interval, a column per amplitude.
MatX columns_of(const AttitudePart& part, const Instants& at);
MatX columns_of(const TimePart& part, const Instants& at);
MatX columns_of(const Form& form, const Instants& at);

inline bool is_pair(const AttitudePart& part) {
  return part.kind == AttitudePart::Kind::harmonic;
}
inline bool is_pair(const TimePart& part) {
  return part.kind == TimePart::Kind::harmonic;
}

/// The setting that a fit may move: a period, a time constant, a width; null without one.
double* moved_setting(Form& form);
double* sigma_of_moved(Form& form);

}  // namespace drift::forms
