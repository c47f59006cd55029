#include "mc/task/study_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/estimate/starts.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::mc {

StudyColumns::StudyColumns(const Study& study) {
  require_own_terms(study);
  ParamMask wanted = study.truth.active;
  for (const FilterSpec& spec : study.filters) {
    Filter filter{spec.name, spec.coupling, make_layout(spec), start_count(spec), 0, {}};
    for (const std::size_t p : filter.layout.params) wanted.set(p);
    filters.push_back(std::move(filter));
  }
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i]) truth.push_back(i);
  count = truth.size();
  for (Filter& filter : filters) {
    filter.first = count;
    count += filter.starts * filter.width();
    for (const std::size_t p : filter.layout.params)
      filter.truth.push_back(static_cast<std::size_t>(std::ranges::find(truth, p) - truth.begin()));
  }
}

std::vector<Column> StudyColumns::named() const {
  std::vector<Column> columns;
  const auto parameter = [&](const std::string& prefix, std::size_t p) {
    const auto& spec = TermLibrary::specs[p];
    columns.push_back({fmt::format("{}/{}", prefix, spec.key.view()), spec.unit});
  };
  for (const std::size_t p : truth) parameter("truth", p);
  for (const Filter& filter : filters)
    for (std::size_t s = 0; s < filter.starts; ++s) {
      const std::string prefix = fmt::format("{}/{}", filter.name, s);
      for (const StoredField& field : stored_fields)
        columns.push_back({fmt::format("{}/{}", prefix, field.name), unit::one});
      for (const std::size_t p : filter.layout.params) parameter(prefix + "/estimate", p);
      for (const std::size_t p : filter.layout.params) parameter(prefix + "/sigma", p);
    }
  return columns;
}

}  // namespace drift::mc
