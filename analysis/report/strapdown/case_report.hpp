#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/report/page/report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// All that the identification of a strapdown recording has to say: tables, identification.json,
/// estimates.csv, covariance.csv and study.toml. InputError (config) as mc::require_own_terms().
Report case_report(const mc::Study& study, const strapdown::CaseIdentification& id);

/// identification.json, schema 1. A number that is not finite is null.
nlohmann::json to_json(const strapdown::CaseIdentification& id, double gravity);

}  // namespace drift::report
