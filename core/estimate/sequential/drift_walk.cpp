#include "core/estimate/sequential/drift_walk.hpp"

#include "core/physics/stochastic.hpp"

namespace drift {
namespace {

constexpr auto fixed_drift_x = TermLibrary::index("D_F_x");

int axis_of(const Layout& layout, std::size_t state) {
  return static_cast<int>(layout.params[state] - fixed_drift_x);
}

}  // namespace

std::vector<std::size_t> walking_states(const FilterSpec& filter, const Layout& layout) {
  std::vector<std::size_t> states;
  if (!drift_varies(filter.noise, filter.model().terms)) return states;
  for (std::size_t k = 0; k < layout.size(); ++k)
    if (layout.params[k] >= fixed_drift_x && layout.params[k] < fixed_drift_x + 3)
      states.push_back(k);
  return states;
}

double walk_variance(const FilterSpec& filter, const Layout& layout, std::size_t state,
                     const Theta& theta, double duration) {
  const double sigma = layout.sigma[static_cast<Eigen::Index>(state)];
  return drift_variance(filter.noise, filter.model().terms, theta, axis_of(layout, state),
                        duration) /
         (sigma * sigma);
}

double variance_between_recordings(const FilterSpec& filter, const Layout& layout,
                                   std::size_t state, const Theta& theta) {
  const double sigma = layout.sigma[static_cast<Eigen::Index>(state)];
  return drift_variance_between_recordings(filter.model().terms, theta, axis_of(layout, state)) /
         (sigma * sigma);
}

}  // namespace drift
