#include "core/sim/own_course.hpp"

#include <algorithm>
#include <cmath>

#include "core/sim/kinematics.hpp"

namespace drift {

OwnCourse::OwnCourse(std::size_t own, const ModelSpec& model)
    : term_(own_terms().terms[own]), mounting_(model.mounting) {
  const std::size_t first = TermLibrary::terms[TermLibrary::num_known + own].first;
  for (std::size_t i = 0; i < term_.params.size(); ++i) {
    const Prior& prior = model.priors[first + i];
    const bool drawn = TermLibrary::specs[first + i].amplitude();
    params_[i] = prior.mean() + (drawn ? prior.sigma() : 0.0);
    if (const double size = std::abs(params_[i]); drawn && size > 0.0)
      amplitude_ = amplitude_ > 0.0 ? std::min(amplitude_, size) : size;
  }
  for (std::size_t k = 0; k < term_.program.size; ++k)
    if (term_.program.code[k].op == Operation::input)
      read_.push_back(static_cast<std::size_t>(term_.program.code[k].index));
}

OwnCourse::Reading OwnCourse::reading(const Timeline& timeline, const Interval& interval,
                                      const Node& node) const {
  Scene<double> scene(node.omega_ic_l, interval.omega_cmd_p, mounting_, node.R_lr);
  Needs needs = term_.needs;
  needs.clock = true;
  scene.look_around(needs, moment_at(timeline, interval, node.t), node.R_lr, nullptr);
  Reading all{};
  for (const std::size_t i : read_) all[i] = read_input(i, term_.target.axis, scene.in);
  return all;
}

}  // namespace drift
