#pragma once

#include <nlohmann/json_fwd.hpp>

#include "analysis/report/page/report.hpp"
#include "analysis/strapdown/identify.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// All that the identification of a strapdown recording has to say: tables, the held-out error of
/// every model tried (rotations.svg), identification.json, estimates.csv and study.toml.
Report strapdown_report(const mc::Study& study, const strapdown::StrapdownResult& result);

/// identification.json, schema 1. A number that is not finite is null.
nlohmann::json to_json(const strapdown::StrapdownResult& result);

/// The parameters alone: a row for each, with its unit and sigma.
std::string estimates_csv(const strapdown::StrapdownResult& result);

}  // namespace drift::report
