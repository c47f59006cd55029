#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/diagnosis/recovered.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::blind {

/// A sealed trial as every rival sees it: the nominal fit, what it leaves, and the library's
/// signatures, whitened by the noise that is estimated before anything is searched.
struct RivalTest {
  search::Fitted examined;
  std::vector<diagnosis::InputEstimate> inputs;  ///< recovered, of every equation

  /// A signature of one parameter at one setting.
  struct Column {
    int column = 0;  ///< of LinearProblem::extra
    std::size_t candidate = 0;
  };
  std::vector<Column> columns;
};

/// Reads, fits and examines one trial.
RivalTest rival_test(const std::string& study_path, const std::string& recording_path);

/// What a rival says: that something is missing, and what.
struct RivalAnswer {
  bool alarm = false;
  std::vector<std::size_t> named;  ///< candidates of one parameter, each once
};

/// A rival: what it is called, and its answer at a chance `alpha` of a false alarm.
struct Rival {
  std::string name;
  RivalAnswer (*answer)(const RivalTest& test, double alpha);
};

/// Chi-square of the nominal fit under the declared noise and Ljung and Box's Q of its residuals,
/// half of alpha each; names nothing.
RivalAnswer chi_square_alarm(const RivalTest& test, double alpha);
/// The signature that is most like the residuals, parameters not projected out of it.
RivalAnswer unprojected_correlation(const RivalTest& test, double alpha);
/// Sequentially thresholded least squares (SINDy) on the recovered rates, threshold by BIC.
RivalAnswer thresholded_least_squares(const RivalTest& test, double alpha);
/// LASSO on the recovered rates, penalty by BIC.
RivalAnswer lasso(const RivalTest& test, double alpha);
/// Projected scores, forward, as long as Benjamini and Hochberg's procedure rejects one.
RivalAnswer forward_selection(const RivalTest& test, double alpha);
/// The strongest signature of one half of the positions, tested by F on the other (LISDD).
RivalAnswer split_sample(const RivalTest& test, double alpha);

/// All of them.
std::vector<Rival> rivals();

}  // namespace drift::blind
