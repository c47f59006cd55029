#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drift::mc {

/// The lines in which two texts differ, "- line" of the first and "+ line" of the second, in order;
/// at most `most` of them, then "... and N more".
std::vector<std::string> difference(std::string_view a, std::string_view b, std::size_t most = 12);

}  // namespace drift::mc
