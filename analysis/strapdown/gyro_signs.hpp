#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/estimate/strapdown/dwells.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/mixup.hpp"

namespace drift::strapdown {

/// Columns of gyros and of accelerometers as they may have to be taken.
struct ColumnsAs {
  Mixup gyros = {}, accelerometers = {};
};
/// Errors of the turns (gyro_unit.hpp) with the columns taken so.
using ErrorsAs = std::function<std::vector<double>(const ColumnsAs&)>;

/// Which columns are exchanged or reversed, and the line that mends them; empty: no such change
/// explains the turns that are wrong. Of gyros or of accelerometers, where in three turns at least
/// the error is above a half: what makes the median small, of all turns and of these, and leaves
/// the fewest above a half. Of fewer wrong turns all gyros reversed, where none is left. declared:
/// errors of the columns as they are.
///
/// Turns of gravity, df/dt = -w x f, are the same for f' = M f and w' = det(M) M w, M exchanging or
/// reversing axes: acc_x reversed is what gyro_y and gyro_z reversed are. One is the mirror image
/// of the other where det(M) is -1, and is told by the Earth's rate at rest: w f is that about Up,
/// and turns its sign. Where the rests show it (MirrorLimits) only what gives it the sign that it
/// has at the site's latitude counts. What mends gyros and what mends accelerometers are both
/// said, the one with fewer changes first. Where that leaves none, the axes are left-handed: one of
/// gyros and accelerometers alike.
std::string mistaken_columns(const std::vector<Dwell>& dwells, const Site& site,
                             const std::vector<double>& declared, const ErrorsAs& errors_as);

}  // namespace drift::strapdown
