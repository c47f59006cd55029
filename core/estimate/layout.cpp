#include "core/estimate/layout.hpp"

#include <cmath>

namespace drift {

Layout make_layout(const ModelSpec& spec) {
  Layout layout;
  layout.theta.setZero();
  for (const bool rate : {true, false}) {
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
      if (!spec.active[i]) continue;
      layout.theta[i] = spec.priors[i].mean();
      if (TermLibrary::specs[i].kind == ParamKind::noise)
        layout.theta[i] = std::hypot(spec.priors[i].mean(), spec.priors[i].sigma());
      const bool is_state = spec.priors[i].sigma() > 0.0 && can_be_state(TermLibrary::specs[i]);
      if (is_state && TermLibrary::owner(i).in_rates == rate) layout.params.push_back(i);
    }
    if (rate) layout.num_rate = layout.params.size();
  }
  layout.mean.resize(layout.size());
  layout.sigma.resize(layout.size());
  for (std::size_t k = 0; k < layout.size(); ++k) {
    layout.mean[k] = spec.priors[layout.params[k]].mean();
    layout.sigma[k] = spec.priors[layout.params[k]].sigma();
  }
  return layout;
}

}  // namespace drift
