#include "mc/export/named_axes.hpp"

#include <algorithm>
#include <set>

#include "core/physics/term_library.hpp"
#include "mc/export/export_text.hpp"

namespace drift::mc {
namespace {

void put_swept(NamedGroup& group, const std::vector<SweptCoordinate>& swept) {
  std::vector<std::string> names;
  std::set<std::string> taken{"point", "run", "filter", "start", "parameter"};
  for (const SweptCoordinate& c : swept) {
    std::string name = plain_name(c.key);
    while (!taken.insert(name).second) name += "_";
    if (c.numbers.empty())
      group.put_words(name, "point", c.words, c.key);
    else
      group.put(name, {"point"}, {std::string(c.unit.symbol.view()), c.key}, c.numbers);
    names.push_back(name);
  }
  for (const std::string& name : names) group.mark_coordinate(name, "point");
}

}  // namespace

NamedAxes::NamedAxes(const std::vector<StudyPoint>& study_points) {
  std::set<std::size_t> named;
  for (const StudyPoint& p : study_points) {
    points.push_back(p.label);
    columns.emplace_back(p.study);
    named.insert(columns.back().truth.begin(), columns.back().truth.end());
    for (const StudyColumns::Filter& f : columns.back().filters) {
      if (std::ranges::find(filters, f.name) == filters.end()) filters.push_back(f.name);
      starts = std::max(starts, f.starts);
    }
  }
  params.assign(named.begin(), named.end());
  swept = swept_coordinates(study_points);
}

std::size_t NamedAxes::filter(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::find(filters, name) - filters.begin());
}

std::size_t NamedAxes::parameter(std::size_t library_index) const {
  return static_cast<std::size_t>(std::ranges::find(params, library_index) - params.begin());
}

std::vector<std::string> NamedAxes::with_point(std::vector<std::string> dimensions) const {
  if (points.size() > 1) dimensions.insert(dimensions.begin(), "point");
  return dimensions;
}

void NamedAxes::make_dimensions(NamedGroup& group) const {
  if (points.size() > 1) {
    group.name_along("point", points, "study point: the values that were swept");
    put_swept(group, swept);
  }
  group.name_along("filter", filters, "filter of the study");
  group.number_along("start", starts, 1, "initial estimate, from 1");
  put_parameter_dimension(group, params);
}

void put_parameter_dimension(NamedGroup& group, const std::vector<std::size_t>& params) {
  std::vector<std::string> keys, units;
  for (const std::size_t p : params) {
    keys.emplace_back(TermLibrary::specs[p].key.view());
    units.emplace_back(TermLibrary::specs[p].unit.symbol.view());
  }
  group.name_along("parameter", keys, "parameter, as `driftscope terms` lists it");
  group.put_words("parameter_unit", "parameter", units, "unit of the parameter");
  group.mark_coordinate("parameter_unit", "parameter");
}

}  // namespace drift::mc
