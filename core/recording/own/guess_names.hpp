#pragma once

#include <string>
#include <string_view>

namespace drift {

/// The channel that a header of some laboratory may mean ("Ax_mss" -> acc_x); empty if none.
std::string guessed_channel(std::string_view header);

/// Whether a header may be short for this gimbal ("Mid" -> gimbal_middle); not enough by itself.
bool may_be_gimbal(std::string_view header, std::string_view channel);

/// The unit at the end of a header ("Zeit_ms" -> ms, "Ax_mss" -> m/s^2); empty if there is none.
std::string guessed_unit(std::string_view header);

/// The same where it stands behind a symbol of one letter ("T_degC" -> degC): of longer names what
/// looks like one may be another word ("acc_x_c").
std::string unit_of_symbol(std::string_view header);

}  // namespace drift
