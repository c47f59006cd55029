#pragma once

#include "analysis/identify.hpp"
#include "analysis/report/html_report.hpp"
#include "analysis/report/identification_figures.hpp"

namespace drift {

/// Everything there is to say of an identification, with its pictures.
HtmlReport identification_html(const Study& study, const Identification& id,
                               const std::vector<Figure>& figures);

}  // namespace drift
