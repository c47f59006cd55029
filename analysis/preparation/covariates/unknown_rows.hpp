#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/covariates/covariate_gaps.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Whose terms are to know what they follow.
enum class Following {
  filters,  ///< of the study
  library,  ///< its first filter, and all terms that a diagnosis may name
};

/// A covariate that is taken as not recorded.
struct UnusedCovariate {
  CovariateSet set = 0;
  std::string why;
};

/// Leaves out of the fit what hangs on covariates that are not known, and says what of every column
/// is missing that such terms follow. recordings: made ready, a number in every row where a column
/// is known; gaps: of each, as its file has them (bridge_covariates()).
///
/// Accelerometers and gimbals are not measured in rows at one of whose ends a covariate is unknown
/// that a term of the filters follows. If such a term acts on the platform's rate, so are the rows
/// behind them until the platform is caged anew: nobody knows how it drifted meanwhile. Of what
/// only a diagnosis looks for, rows are left out as long as most of the test remains; else the
/// column is taken out instead, and returned: that leaves more to be examined.
///
/// InputError (recording) where no row is left.
std::vector<UnusedCovariate> leave_out_unknown(const mc::Study& study,
                                               std::vector<Recording>& recordings,
                                               const std::vector<std::vector<ColumnGaps>>& gaps,
                                               Following following,
                                               std::vector<std::string>& remarks);

}  // namespace drift::preparation
