#pragma once

#include "analysis/identification/identify.hpp"
#include "analysis/report/identify/figures.hpp"
#include "analysis/report/page/html_report.hpp"

namespace drift::report {

/// Everything there is to say of an identification, with its pictures.
HtmlReport identification_html(const mc::Study& study, const identification::Identification& id,
                               const std::vector<Figure>& figures);

}  // namespace drift::report
