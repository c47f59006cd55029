#include "analysis/inference/equation.hpp"

#include <fmt/format.h>

namespace drift::inference {

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
