#include "core/sim/own_terms_drawn.hpp"

#include <fmt/format.h>

#include "core/physics/own/own_terms.hpp"

namespace drift {

std::string own_terms_drawn(const TermMask& terms, const Theta& drawn) {
  std::string all;
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own) {
    if (!terms[TermLibrary::num_known + own]) continue;
    const OwnTerm& term = own_terms().terms[own];
    const std::size_t first = TermLibrary::terms[TermLibrary::num_known + own].first;
    std::string values;
    for (std::size_t k = 0; k < term.params.size(); ++k) {
      const ParamSpec& p = term.params[k];
      values += fmt::format("{}{} = {:.4g} {}", k > 0 ? ", " : "", p.key.view(),
                            drawn[static_cast<Eigen::Index>(first + k)] / p.unit.to_si,
                            p.unit.symbol.view());
    }
    all += fmt::format("{}{} ({})", all.empty() ? "" : " and ", term.key, values);
  }
  return all;
}

}  // namespace drift
