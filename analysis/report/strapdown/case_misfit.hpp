#pragma once

#include <optional>
#include <string>

#include "analysis/identification/common_scale.hpp"
#include "analysis/strapdown/case_identify.hpp"

namespace drift::report {

/// What moves the three K1 alike, unless the study is of another place.
std::optional<identification::CommonScale> gravity_off(const strapdown::CaseIdentification& id);

/// Why chi-square of the first filter is more than noise makes it: by the priors of the three K1
/// alone, which one cause moves; by the priors of parameters alone, the data being fitted as well
/// as noise lets them; or by what is missing from the model or the noise.
enum class CaseMisfit { none, of_gravity, of_priors, of_model };
CaseMisfit misfit_of(const strapdown::CaseIdentification& id);

/// The verdict on such a fit; misfit: not `none`.
std::string case_misfit_text(const strapdown::CaseIdentification& id, CaseMisfit misfit);

/// What to do next.
std::string case_next(const strapdown::CaseIdentification& id, CaseMisfit misfit);

}  // namespace drift::report
