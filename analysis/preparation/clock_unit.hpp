#pragma once

#include <string>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// What is wrong with the times of a platform's recording by whose clock the free platform turns
/// against the case by many times, or a small part of, the Earth's rate: in which unit they would
/// be right. Empty where it turns as the Earth does, and where gimbals and accelerometers do not
/// both show it (angles in another unit turn as wrongly). That a platform turns too slowly is said
/// only where commands are recorded and zero: a loop that nobody recorded would keep it level.
std::string other_unit_of_time(const Recording& recording);

}  // namespace drift::preparation
