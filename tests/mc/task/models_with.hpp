#pragma once

#include "core/physics/drift_model.hpp"
#include "core/physics/parameters_config.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

/// Terms and their default priors.
template <class Spec>
Spec model(Coupling coupling, std::initializer_list<std::string_view> terms) {
  Spec spec;
  spec.coupling = coupling;
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    spec.priors[i] = TermLibrary::specs[i].prior_si();
  for (const std::string_view term : terms)
    spec.active |= TermLibrary::completed(params_named(term));
  if (coupling == Coupling::lambda) spec.active.set(closure_param);
  return spec;
}
inline TruthSpec truth_with(std::initializer_list<std::string_view> terms,
                            Coupling coupling = Coupling::eq5) {
  return model<TruthSpec>(coupling, terms);
}
inline FilterSpec filter_with(std::initializer_list<std::string_view> terms,
                              Coupling coupling = Coupling::eq5) {
  return model<FilterSpec>(coupling, terms);
}

}  // namespace drift::test
