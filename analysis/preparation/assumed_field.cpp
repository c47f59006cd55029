#include "analysis/preparation/assumed_field.hpp"

#include <cmath>

namespace drift::preparation {

Vec3 dipole_field_l(double latitude) {
  constexpr double at_equator = 29.8e-6;  // [T]
  return {at_equator * std::cos(latitude), 0.0, -2.0 * at_equator * std::sin(latitude)};
}

FieldKnown assume_field(Timeline& timeline, double latitude) {
  if (timeline.carries(covariate("field"))) return FieldKnown::declared_or_recorded;
  timeline.set_vector(covariate("field"), dipole_field_l(latitude));
  return FieldKnown::assumed;
}

FieldKnown assume_field(Environment& environment, double latitude) {
  CovariateCourse& field = environment[covariate("field")];
  if (field.declared()) return FieldKnown::declared_or_recorded;
  const Vec3 field_l = dipole_field_l(latitude);
  field.mean = {field_l.x(), field_l.y(), field_l.z()};
  return FieldKnown::assumed;
}

}  // namespace drift::preparation
