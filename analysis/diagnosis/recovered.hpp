#pragma once

#include "analysis/diagnosis/findings/recovered_signal.hpp"
#include "analysis/preparation/covariates.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// A missing input as a time series: one unknown constant per bin of time in one equation, smooth
/// (Ornstein-Uhlenbeck prior whose size and time constant maximise the likelihood), parameters and
/// attitudes marginalised. What fitted parameters can absorb is not recovered.
struct InputEstimate {
  inference::Equation equation = inference::Equation::rate;
  int axis = 0;
  std::vector<std::pair<std::size_t, std::size_t>> bins;  ///< intervals of each
  VecX value, sigma;                                      ///< of each bin, SI
  double gain = 0.0;  ///< twice the log likelihood gained over no input
  MatX C;             ///< information on the bins, parameters projected out
  MatX smoother;      ///< value = smoother g
  VecX g;
  MatX cross;  ///< shape (bins, candidates): candidates seen through the bins
};

/// The same for each of the twelve equations, best first. per_position: bins of each position.
std::vector<InputEstimate> estimate_inputs(const inference::MeasuredRows& rows,
                                           const Timeline& timeline,
                                           const inference::Projector& projector, int per_position);

/// Whether the shape of a signal is to be found, is that of a cause which is named, or of the most
/// probable of several, or is not asked for.
enum class ShapeFrom { signal, cause, alternative, nothing };

/// As a time series with a description of its shape. cause: candidate columns with amplitudes whose
/// signature is drawn over it; may be empty.
RecoveredSignal recovered_signal(const InputEstimate& input, const Timeline& timeline,
                                 const std::vector<preparation::Covariate>& covariates,
                                 const std::vector<std::pair<int, double>>& cause,
                                 ShapeFrom shape = ShapeFrom::signal);

}  // namespace drift::diagnosis
