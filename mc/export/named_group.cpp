#include "mc/export/named_group.hpp"

#include <algorithm>

#include "core/base/check.hpp"

namespace drift::mc {

NamedGroup::NamedGroup(Hdf5Output& file, std::string path) : file_(file), path_(std::move(path)) {
  if (!path_.empty()) file_.make_group(path_);
}

void NamedGroup::name_along(const std::string& dimension, const Names& names,
                            const std::string& about) {
  const std::size_t words = file_.make_words(path_of(dimension), names);
  file_.name_dimension(words);
  file_.set_text(path_of(dimension), "long_name", about);
  scales_.push_back({dimension, words, names.size()});
}

void NamedGroup::number_along(const std::string& dimension, std::size_t size, int first,
                              const std::string& about) {
  scales_.push_back({dimension, file_.make_scale(path_of(dimension), size, first), size});
  file_.set_text(path_of(dimension), "units", "1");
  file_.set_text(path_of(dimension), "long_name", about);
}

const NamedGroup::Scale& NamedGroup::scale(const std::string& dimension) const {
  const auto at = std::ranges::find(scales_, dimension, &Scale::name);
  DRIFT_DEMAND(at != scales_.end());
  return *at;
}

std::size_t NamedGroup::make(const std::string& name, const Names& dimensions, const Said& said,
                             Hdf5Output::Type type) {
  std::vector<hsize_t> shape;
  for (const std::string& dimension : dimensions) shape.push_back(size(dimension));
  const std::size_t set = file_.make_dataset(path_of(name), type, shape);
  for (unsigned k = 0; k < dimensions.size(); ++k)
    file_.attach(set, scale(dimensions[k]).dataset, k);
  file_.set_text(path_of(name), "units", said.units);
  file_.set_text(path_of(name), "long_name", said.about);
  std::string coordinates;
  for (const auto& [coordinate, dimension] : coordinates_)
    if (std::ranges::find(dimensions, dimension) != dimensions.end())
      coordinates += (coordinates.empty() ? "" : " ") + coordinate;
  if (!coordinates.empty()) file_.set_text(path_of(name), "coordinates", coordinates);
  return set;
}

void NamedGroup::put(const std::string& name, const Names& dimensions, const Said& said,
                     std::span<const double> values, Hdf5Output::Type type) {
  file_.append(make(name, dimensions, said, type), values);
}

void NamedGroup::put_words(const std::string& name, const std::string& dimension,
                           const Names& words, const std::string& about) {
  const std::size_t set = file_.make_words(path_of(name), words);
  file_.attach(set, scale(dimension).dataset, 0);
  file_.set_text(path_of(name), "long_name", about);
}

void NamedGroup::mark_coordinate(const std::string& name, const std::string& dimension) {
  coordinates_.emplace_back(name, dimension);
}

}  // namespace drift::mc
