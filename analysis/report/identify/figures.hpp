#pragma once

#include <string>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::report {

/// A picture and the file it belongs in.
struct Figure {
  std::string file;  ///< "estimates.svg"
  std::string caption;
  std::string svg;
};

/// Library indices of the parameters worth a picture: the published ones; else those the study
/// gives a true value of its own (at most 6); else the 3 that depend most on the start.
std::vector<std::size_t> highlighted_parameters(const mc::Study& study,
                                                const identification::Identification& id);

/// Estimates against time from every start, with their sigma bands and the truth or an independent
/// test as a line: all filters together (estimates.svg) and each alone (figure_<filter>.svg); and
/// the EKF's NIS per measured scalar with its 95 % band (nis.svg).
std::vector<Figure> identification_figures(const mc::Study& study,
                                           const identification::Identification& id);

}  // namespace drift::report
