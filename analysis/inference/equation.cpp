#include "analysis/inference/equation.hpp"

#include <fmt/format.h>

namespace drift::inference {

std::span<const Equation> equations_of(const Timeline& timeline) {
  static constexpr Equation of_platform[] = {Equation::rate, Equation::attitude,
                                             Equation::accelerometer, Equation::gimbal};
  static constexpr Equation of_case[] = {Equation::rate, Equation::accelerometer};
  return timeline.of_case ? std::span<const Equation>(of_case)
                          : std::span<const Equation>(of_platform);
}

const Unit& unit_of(Equation equation) {
  if (equation == Equation::rate) return unit::deg_per_h;
  return equation == Equation::accelerometer ? unit::ug : unit::arcsec;
}

std::string equation_name(Equation equation, int axis) {
  static constexpr const char* gimbals[] = {"outer", "middle", "inner"};
  switch (equation) {
    case Equation::rate:
      return fmt::format("platform rate {}", "xyz"[axis]);
    case Equation::attitude:
      return fmt::format("attitude offset {}", "xyz"[axis]);
    case Equation::accelerometer:
      return fmt::format("accelerometer {}", "xyz"[axis]);
    case Equation::gimbal:
      break;
  }
  return fmt::format("gimbal {}", gimbals[axis]);
}

}  // namespace drift::inference
