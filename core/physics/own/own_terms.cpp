#include "core/physics/own/own_terms.hpp"

#include <utility>

#include "core/base/check.hpp"
#include "core/physics/term_library.hpp"

namespace drift {
namespace {

OwnTermSet& current_own_terms() {
  static OwnTermSet set;
  return set;
}

Subsystem part_of_platform(OwnSlot slot) {
  switch (slot) {
    case OwnSlot::drift:
      return Subsystem::gyro;
    case OwnSlot::accelerometer:
      return Subsystem::accelerometers;
    case OwnSlot::gimbal:
      return Subsystem::resolvers;
    case OwnSlot::rate:
      break;
  }
  return Subsystem::structure;
}

TermInfo info_of_own(const OwnTerm& term) {
  TermInfo info;
  info.key = term.key;
  info.title = term.title;
  info.equation = term.equation;
  info.source = "[[term]] of the study file";
  info.subsystem = part_of_platform(term.target.slot);
  info.count = term.params.size();
  info.in_rates = term.target.slot == OwnSlot::rate || term.target.slot == OwnSlot::drift;
  info.in_readout = term.target.slot == OwnSlot::accelerometer;
  info.in_gimbals = term.target.slot == OwnSlot::gimbal;
  info.needs = term.needs;
  return info;
}

}  // namespace

const OwnTermSet& own_terms() {
  return current_own_terms();
}

void set_own_terms(OwnTermSet set) {
  DRIFT_DEMAND(set.terms.size() <= most_own_terms && set.covariates.size() <= most_further_columns);
  for (const OwnTerm& term : set.terms) DRIFT_DEMAND(term.params.size() <= most_own_parameters);
  if (set == current_own_terms()) return;
  current_own_terms() = std::move(set);  // whose texts the library's tables point to
  std::vector<TermLibrary::Filling> fillings;
  own_contents = {};
  for (std::size_t i = 0; i < current_own_terms().terms.size(); ++i) {
    const OwnTerm& term = current_own_terms().terms[i];
    own_contents[i] = {term.program, term.target};
    fillings.push_back({info_of_own(term), term.params});
  }
  TermLibrary::fill_places(fillings);
}

}  // namespace drift
