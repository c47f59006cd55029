#pragma once

#include "analysis/report/svg/figure.hpp"

namespace drift::report {

/// A chart that a reader may zoom: at most 4000 points of every curve stand with it.
Figure zoomable(const Chart& chart, std::string caption, std::string file = {});

/// Those points as JSON, without a '<': panels with series (an x that is a number: that of the
/// series before with this index), bands, lines and marks; null is no number.
std::string zoom_numbers(const Chart& chart);

}  // namespace drift::report
