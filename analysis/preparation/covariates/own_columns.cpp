#include "analysis/preparation/covariates/own_columns.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/params/covariates.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/recording/recording_check.hpp"

namespace drift::preparation {
namespace {

std::string name_of(const Recording& r) {
  return r.source.empty() ? "recording" : r.source;
}

/// Values that no temperature has, of all rows one message.
void look_at_temperature(const Recording& r, const Channel& c, std::vector<std::string>& wrong) {
  constexpr CovariateSpec temperature = covariate("temperature");
  if (c.unit.dim != temperature.unit.dim) return;
  // A difference in K or degF is smaller than what it would be as a temperature.
  const double most = temperature.reason * temperature.unit.to_si - celsius_offset(c.unit);
  Problems problems(name_of(r));
  std::string fix;
  for (std::size_t row = 0; row < c.values.size(); ++row)
    if (std::abs(c.values[row]) > most) add_unreasonable(r, c, row, most, fix, problems);
  for (std::string& message : problems.messages()) wrong.push_back(std::move(message));
}

/// Whether a column has a unit; one of a plain number may have been left out.
bool has_unit(const Channel& c) {
  return c.unit.dim != unit::one.dim;
}

void compare_units(const std::vector<Recording>& recordings, const std::string& name,
                   std::vector<std::string>& remarks, std::vector<std::string>& wrong) {
  const Recording* first = nullptr;
  for (const Recording& r : recordings)
    if (const Channel* c = r.find(name); c != nullptr && has_unit(*c) && first == nullptr)
      first = &r;
  if (first == nullptr) return;
  const Unit& unit = first->find(name)->unit;
  for (const Recording& r : recordings) {
    const Channel* c = r.find(name);
    if (c == nullptr || c->unit.dim == unit.dim) continue;
    if (has_unit(*c))
      wrong.push_back(fmt::format(
          "{}:{}: is in [{}], in {} it is in [{}] (expected one quantity in all recordings: a term "
          "of the study follows it). Correct the unit, or the name of the column",
          name_of(r), name, c->unit.symbol.view(), name_of(*first), unit.symbol.view()));
    else
      remarks.push_back(fmt::format(
          "{}: {} has no unit, in {} it is in [{}]: terms take its plain numbers for the same. "
          "Give the unit in the header, or in columns of [recording]",
          name_of(r), name, name_of(*first), unit.symbol.view()));
  }
}

}  // namespace

std::vector<std::string> mistakes_of_own_columns(const std::vector<Recording>& recordings,
                                                 std::vector<std::string>& remarks) {
  std::vector<std::string> wrong;
  for (const std::string& name : own_terms().covariates) {
    for (const Recording& r : recordings)
      if (const Channel* c = r.find(name)) look_at_temperature(r, *c, wrong);
    compare_units(recordings, name, remarks, wrong);
  }
  return wrong;
}

}  // namespace drift::preparation
