#include "analysis/preparation/assumed_field.hpp"

#include <cmath>

namespace drift::preparation {

Vec3 dipole_field_l(double latitude) {
  constexpr double at_equator = 29.8e-6;  // [T]
  return {at_equator * std::cos(latitude), 0.0, -2.0 * at_equator * std::sin(latitude)};
}

FieldKnown assume_field(Timeline& timeline, double latitude) {
  if (timeline.has_field) return FieldKnown::declared_or_recorded;
  const Vec3 field_l = dipole_field_l(latitude);
  for (Interval& i : timeline.intervals) i.around0.field_l = i.around1.field_l = field_l;
  timeline.has_field = true;
  return FieldKnown::assumed;
}

}  // namespace drift::preparation
