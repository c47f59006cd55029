#pragma once

#include <vector>

#include "core/config/section.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Reads every [[published]] section: results from elsewhere, printed beside ours.
///
///   [[published]]
///   name = "Table 1 of the paper"
///   filter = "eq5"                     # absent: an independent test
///   D_I_z = { values = ["1.51 deg/h/g", "1.69 deg/h/g"], sigmas = ["0.03 deg/h/g", "0.03 deg/h/g"]
///   }
std::vector<Published> read_published(config::Section& root);

}  // namespace drift::mc
