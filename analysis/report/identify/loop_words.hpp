#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/identification/stated_loop.hpp"
#include "core/estimate/layout.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::report {

/// That recordings state a loop which removed misalignments, and that a filter leaves it out: a
/// sentence. recordings: how each of several is called; empty of one. filters: names.
std::string loop_left_out_text(const identification::StatedLoop& loop,
                               const std::vector<std::string>& recordings,
                               const std::vector<std::string>& filters);
/// What to set, before the command is repeated. number: of the filter in its study, from 0.
std::string loop_next(const identification::StatedLoop& loop, const FilterSpec& filter,
                      std::size_t number, std::string_view command);

}  // namespace drift::report
