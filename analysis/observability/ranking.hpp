#pragma once

#include <string>
#include <vector>

#include "analysis/observability/information.hpp"

namespace drift::observability {

/// What a test will say of one parameter.
struct ParameterRank {
  std::size_t param = 0;           ///< index in TermLibrary
  double prior_sigma = 0.0;        ///< SI
  double posterior_sigma = 0.0;    ///< SI
  double conditional_sigma = 0.0;  ///< if all other parameters were known (attitudes not), SI
  std::size_t partner = 0;   ///< state it is most correlated with after the test; itself if none
  double correlation = 0.0;  ///< with that state
  double learning_ratio() const { return posterior_sigma / prior_sigma; }
  /// How much the ignorance of the others costs: marginal over conditional sigma, >= 1.
  double collinearity() const { return posterior_sigma / conditional_sigma; }
  double bits() const;  ///< log2(prior / posterior sigma)
};

/// A direction in parameter space along which information stands alone.
struct EigenDirection {
  double information = 0.0;           ///< prior-scaled eigenvalue: 1 = as good as the prior
  VecX direction;                     ///< unit vector over the prior-scaled parameters
  std::vector<std::size_t> dominant;  ///< states by falling participation, at most four, that
                                      ///< together hold 80 % of it if four can
  double participation(std::size_t state) const { return direction[state] * direction[state]; }
};

/// Ranking of every parameter of a plan under one model. Of a drift that walks sigmas, correlations
/// and covariance are those in the last sample, as filters report it; what is said of directions is
/// of the drift that the test begins with.
struct Ranking {
  Layout layout;
  std::vector<ParameterRank> parameters;  ///< layout order
  std::vector<std::size_t> walking;       ///< states whose value walks
  std::vector<std::size_t> order;         ///< states by rising learning ratio: the primary rank
  double bits = 0.0;                     ///< information gained in total, -log2 det(covariance) / 2
  std::vector<EigenDirection> spectrum;  ///< by falling information
  MatX root;                             ///< of the information of the data, prior-scaled
  std::vector<WeakDirection> unseen;     ///< information below unseen_information, weakest first
  MatX root_unheld;                      ///< if the attitude at each caging is unknown
  std::vector<WeakDirection> unheld;     ///< unseen then; what is unseen anyway is among them
  Excitation excitation;                 ///< of the plan
  MatX covariance;                       ///< posterior, prior-scaled

  double learning_ratio(std::size_t state) const { return parameters[state].learning_ratio(); }
};

/// Ranks by Fisher information, with process noise by the Riccati covariance (physics.md 5.1):
/// learning ratio = posterior / prior sigma.
Ranking rank_parameters(const LinearisedPlan& plan);

/// "D_F_x (61 %), D_II_x (13 %)".
std::string name_of(const EigenDirection& direction, const Layout& layout);

/// Eigenvalues and vectors of R^T R by SVD of R, falling: small ones keep their digits.
std::vector<EigenDirection> spectrum_of(const MatX& information_root);

}  // namespace drift::observability
