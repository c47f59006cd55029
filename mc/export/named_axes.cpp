#include "mc/export/named_axes.hpp"

#include <algorithm>
#include <set>

#include "core/physics/term_library.hpp"
#include "mc/export/export_text.hpp"

namespace drift::mc {
namespace {

constexpr const char* parameter_unit = "parameter_unit";

/// A plain name of each swept key, none of them `taken`: `truth = [{ ... }, ...]` is no array of
/// true values.
std::vector<std::string> names_of(const std::vector<SweptCoordinate>& swept,
                                  std::set<std::string> taken) {
  taken.insert({"point", "run", "filter", "start", "parameter", parameter_unit});
  std::vector<std::string> names;
  for (const SweptCoordinate& c : swept) {
    std::string name = plain_name(c.key);
    while (!taken.insert(name).second) name += "_";
    names.push_back(name);
  }
  return names;
}

void put_swept(NamedGroup& group, const NamedAxes& axes) {
  for (std::size_t k = 0; k < axes.swept.size(); ++k) {
    const SweptCoordinate& c = axes.swept[k];
    if (c.numbers.empty())
      group.put_words(axes.coordinates[k], "point", c.words, c.key);
    else
      group.put(axes.coordinates[k], {"point"}, {std::string(c.unit.symbol.view()), c.key},
                c.numbers);
  }
  for (const std::string& name : axes.coordinates) group.mark_coordinate(name, "point");
}

}  // namespace

NamedAxes::NamedAxes(const std::vector<StudyPoint>& study_points, std::set<std::string> others) {
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
  coordinates = names_of(swept, std::move(others));
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
    put_swept(group, *this);
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
  group.put_words(parameter_unit, "parameter", units, "unit of the parameter");
  group.mark_coordinate(parameter_unit, "parameter");
}

}  // namespace drift::mc
