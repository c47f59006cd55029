#pragma once

#include "analysis/inference/equation.hpp"
#include "analysis/inference/max_t.hpp"
#include "core/plan/timeline.hpp"

namespace drift::inference {

/// A unit box: something constant in one equation, position and window.
struct Window {
  Equation equation = Equation::rate;
  int axis = 0;
  int position = 0;                ///< from 0
  std::size_t first = 0, end = 0;  ///< intervals
  double start_s = 0.0, end_s = 0.0;
  double unit = 1.0;  ///< amplitude that a scan column stands for, SI
};

/// Whether the information that windows share with the candidates is worked out.
enum class Cross { known, left_out };

/// The windows of one position, against the parameters and the candidates.
struct PositionScan {
  std::vector<Window> windows;
  Projector::Scan scan;
  VecX T;  ///< projected score of each, one degree; 0 where unobservable
};

/// Boxes in 3 rate equations, 3 attitude offsets, 3 accelerometers and 3 gimbals of every position:
/// full, halves and quarters, the latter two with half overlap. A box in the rate is felt to the
/// end of its chain; what it does after its position is left out of the test direction (which stays
/// exact).
std::vector<PositionScan> scan_windows(const LinearProblem& problem, const Timeline& timeline,
                                       const Projector& projector, Cross cross = Cross::known);

/// The signature of a window over rows first .. first + count: per rad/s, rad, g, rad.
VecX window_signature(const MeasuredRows& rows, const Timeline& timeline, const Window& window,
                      Eigen::Index first, Eigen::Index count);

/// Null distribution of the largest window, positions joined.
MaxNull scan_null(const std::vector<PositionScan>& scans, int draws);

}  // namespace drift::inference
