#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/plan/environment.hpp"
#include "core/plan/excitation.hpp"
#include "core/sim/simulate.hpp"

namespace drift::observability {

/// What a test is judged by before it is done: a model with priors, the numbers it is linearised
/// at, and what is measured where.
struct RankedModel {
  ModelSpec spec;
  Theta nominal = Theta::Zero();                         ///< SI
  MisalignmentAngles loop = MisalignmentAngles::Zero();  ///< coupling "compensated" alone [rad]
  Site site;
  Readout readout;
  Environment environment;  ///< what terms of temperature and field see; empty: neither is known
};

/// The model of a filter, linearised at the means of the truth where the filter has the parameter
/// too, at its own prior means elsewhere (without a truth, everywhere). Noise, that of terms too,
/// is what the filter allows for. A lambda that is a state is taken from the truth's coupling: 0
/// for eq. (5), 1 for eq. (6) and the servo.
RankedModel ranked_model(const ModelSpec& spec, const TruthSpec* truth, const Site& site,
                         const Readout& readout, const Environment& environment = {});

/// What a drift that walks (drift_random_walk, bistable_drift) has added to D_F by some moment, as
/// far as what was measured until then tells: w = by x + rest, in prior sigmas.
struct Walked {
  std::vector<std::size_t> states;  ///< those that walk, at most three; none: nothing does
  MatX by;                          ///< shape (states, n)
  MatX variance;                    ///< of the rest, which no parameter explains
};

/// Everything measured in a stretch of time, compressed to a triangle.
struct TimeBin {
  int position = 0;           ///< from 0
  int chain = 0;              ///< cagings before it, from 0
  bool slew = false;          ///< on the way to the position
  double t0 = 0.0, t1 = 0.0;  ///< [s]
  /// [psi | x], prior-scaled and whitened, shape (3 + n, 3 + n), upper triangular. With process
  /// noise psi is eliminated, its columns are zero, and all bins before are taken for known.
  MatX rows;
  Walked walked;  ///< by its end
};

/// A plan under a model: what every stretch of time says of the parameters and of the attitude at
/// the caging of its chain. A parameter that walks is what it is when the test begins.
struct LinearisedPlan {
  Layout layout;
  int chains = 0, positions = 0;
  double duration = 0.0;      ///< [s]
  std::vector<TimeBin> bins;  ///< in order of time
  Excitation excitation;
  /// With process noise, whose rows go by all of the conditions: the plan linearised under others
  /// (attitude_weight as in InformationSum, unread as in linearise()). Without: none.
  std::function<LinearisedPlan(double attitude_weight, std::optional<int> unread)> again;

  Eigen::Index size() const { return static_cast<Eigen::Index>(layout.size()); }
};

/// Linearises a plan by variational sensitivities along the trajectory that CVODE gives for the
/// nominal parameters. Each dwell is cut into `bins_per_dwell` stretches of (nearly) equally many
/// samples; slews and turns of the case on the way to a position are one stretch of their own.
/// Process noise of the model is in the rows (DrivenRows). unread: a position, from 0, where
/// nothing is measured. InputError (self_check) if the integration fails.
LinearisedPlan linearise(const TestPlan& plan, const RankedModel& model, int bins_per_dwell = 1,
                         std::optional<int> unread = {});

/// Adds up information in order of time as a square root over the parameters; the attitude of each
/// chain is a nuisance with a prior of its own.
class InformationSum {
 public:
  /// attitude_weight: 1 for the prior sigma of the spec, 1e-4 for a sigma 10^4 times wider.
  explicit InformationSum(Eigen::Index parameters, double attitude_weight = 1.0);

  /// Takes in a triangle [psi | x] of a chain; chains come one after the other.
  void add(int chain, const MatX& rows);
  /// R with R^T R = information on the prior-scaled parameters so far, shape (n, n), upper
  /// triangular; the parameter prior is not in it.
  MatX root() const;

 private:
  Eigen::Index n_;
  double weight_;
  int present_ = -1;
  MatX finished_, chain_;
};

/// All bins of a plan, or those that `keep(bin)` says.
template <class Keep>
MatX information_root(const LinearisedPlan& plan, Keep&& keep) {
  InformationSum sum(plan.size());
  for (const TimeBin& bin : plan.bins)
    if (keep(bin)) sum.add(bin.chain, bin.rows);
  return sum.root();
}

/// Of all bins. attitude_weight: as in InformationSum.
MatX whole_root(const LinearisedPlan& plan, double attitude_weight = 1.0);

/// Belief after data, with the prior (unit covariance, prior-scaled): I = R^T R + 1. Of a parameter
/// that walks, of its value at the moment: more than the prior may be left of it.
struct Posterior {
  MatX S;             ///< square root of the covariance, P = S S^T, n rows
  VecX sigma;         ///< marginal standard deviations: the learning ratios
  VecX conditional;   ///< standard deviations if all other parameters were known
  double bits = 0.0;  ///< information gained, -log2 det(P) / 2

  MatX covariance() const { return S * S.transpose(); }
};
Posterior posterior_of(const MatX& information_root, const Walked& walked = {});
/// After the whole plan. attitude_weight: as in InformationSum.
Posterior posterior_of(const LinearisedPlan& plan, double attitude_weight = 1.0);

/// How the parameters at the moment hang on those of the beginning: ones, and what the walk has
/// added. Shape (n, n).
MatX by_the_beginning(const Walked& walked, Eigen::Index n);

}  // namespace drift::observability
