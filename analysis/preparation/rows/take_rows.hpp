#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/prepare.hpp"

namespace drift::preparation {

/// Makes samples of the plan of recordings' rows, or coarser ones above `most_rows` rows of all
/// (prepare()). Evenly spaced rows of a recording are held against the plan first, each as if it
/// were alone; a message in `wrong` for each that does not fit, and rows then stay as they are.
void take_rows(Prepared& p, std::size_t most_rows, std::vector<std::string>& wrong);

}  // namespace drift::preparation
