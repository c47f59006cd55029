#pragma once

#include <array>
#include <vector>

#include "core/physics/expression/program.hpp"
#include "core/physics/model_spec.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// A study's own term along a test, its amplitudes one prior sigma from their means.
class OwnCourse {
 public:
  /// All that an equation may read, by number; of use where it reads it.
  using Reading = std::array<double, own_inputs.size() + most_further_columns>;

  /// own: which of own_terms(). Both must outlive it.
  OwnCourse(std::size_t own, const ModelSpec& model);

  /// At a node of the nominal path.
  Reading reading(const Timeline& timeline, const Interval& interval, const Node& node) const;
  double value_at(const Reading& at) const {
    return evaluated<double>([&](std::size_t i) { return at[i]; });
  }
  /// With what input(number) says it reads.
  template <class S, class Input>
  S evaluated(Input&& input) const {
    std::array<S, most_own_parameters> p;
    std::copy(params_.begin(), params_.end(), p.begin());
    return evaluate_program(term_.program, p.data(),
                            [&](int i) -> S { return input(static_cast<std::size_t>(i)); });
  }
  /// The least of its amplitudes as they are here, SI; zero without any.
  double amplitude() const { return amplitude_; }
  /// Numbers of what it reads.
  const std::vector<std::size_t>& inputs() const { return read_; }

 private:
  const OwnTerm& term_;
  const Mounting& mounting_;
  std::array<double, most_own_parameters> params_{};
  double amplitude_ = 0.0;
  std::vector<std::size_t> read_;
};

/// Calls visit(own, course) for each own term that reads nothing which the timeline does not carry.
template <class Visit>
void for_each_own(const Timeline& timeline, const ModelSpec& model, Visit&& visit) {
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own)
    if (timeline.carries(own_terms().terms[own].needs)) visit(own, OwnCourse(own, model));
}

}  // namespace drift
