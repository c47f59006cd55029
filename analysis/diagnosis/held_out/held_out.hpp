#pragma once

#include <functional>

#include "analysis/diagnosis/findings/fit_comparison.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// How held-out positions are predicted.
enum class FoldMethod {
  linear,    ///< by conditioning the linearised test: exact up to second order, no fit
  refitted,  ///< both models fitted again without the position, through the full dynamics
};

/// How folds are made.
struct FoldOptions {
  FoldMethod method = FoldMethod::linear;
  std::vector<std::size_t>
      recording_ends;  ///< interval behind the last of each recording; one or none: not told apart
  std::function<void(std::size_t, std::size_t)>
      progress;  ///< folds done, of how many; from any thread
};

/// Predicts every position from all the others, with the nominal and with the patched model; where
/// there are several recordings, every recording from the others too, its initial attitudes alone
/// unknown beyond their posterior (predictor.hpp). Nested: the cause is chosen
/// anew from the rest alone, the nominal model where nothing there is
/// significant.
HeldOut held_out(const search::Fitted& nominal, const search::Fitted& patched,
                 const MeasuredTest& test, const std::vector<std::size_t>& named,
                 double library_threshold, const FoldOptions& options);

/// Gain of the log score over all positions, each predicted from the others, of one fitted model
/// over another of the same test; by conditioning the linearised tests, under the noise of the
/// second.
double held_out_gain(const search::Fitted& before, const search::Fitted& after);

}  // namespace drift::diagnosis
