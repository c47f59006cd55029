#pragma once

#include <optional>
#include <vector>

#include "analysis/observability/information.hpp"
#include "analysis/planning/position_pool.hpp"

namespace drift::planning {

/// What an addition tells of the attitude at the caging of its chain and of the parameters.
struct AddedRows {
  MatX rows;                     ///< [psi | x]
  observability::Walked walked;  ///< by its end
  double duration = 0.0;         ///< slew and dwell [s]
};

/// Headings of the case at a position slewed to [rad], where it was left at `left` [rad]: as the
/// gimbals need, half round and once round, each forward and back as far as a plan may ask for.
/// Forward and back end alike, yet the rate of the case has the other sign on the way. More turns
/// than one would tell the more of the same, at the more time.
std::vector<std::optional<double>> headings_after(double left);

/// The positions that may come next in a plan, in one order for all that judge them: caged ones,
/// then, where the plan slews, those slewed to. What each tells is integrated when it is asked for.
class Candidates {
 public:
  Candidates(const TestPlan& plan, const observability::RankedModel& model);

  /// Those that may follow `plan`, which has grown. What a caged one tells is kept, unless a term
  /// knows the time or remembers, or a drift walks.
  void renew(const TestPlan& plan);

  std::size_t size() const { return pool_.size(); }
  const Position& position(std::size_t k) const { return pool_[k].front(); }
  bool is_caged(std::size_t k) const { return k < caged_; }
  /// Nothing if the gimbals do not allow it. May be called for different k at the same time.
  const std::optional<AddedRows>& gain(std::size_t k);

 private:
  void take(Entry entry, std::vector<std::optional<double>> headings);

  const observability::RankedModel& model_;
  bool past_, slews_;
  double dwell_, sample_;
  TestPlan before_caged_, before_slewed_;
  std::vector<Addition> pool_;
  std::size_t caged_ = 0;
  std::vector<std::optional<std::optional<AddedRows>>> gains_;
};

}  // namespace drift::planning
