#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/export/hdf5_output.hpp"

namespace drift::mc {

/// What a coordinate or an array says of itself (CF).
struct Said {
  std::string units, about;
};

/// A group of a netCDF-4 file: dimensions with their coordinates, and arrays over dimensions that
/// are named.
class NamedGroup {
 public:
  using Names = std::vector<std::string>;

  /// Makes the group; the root, "", is there.
  NamedGroup(Hdf5Output& file, std::string path);

  /// A dimension along which things have names.
  void name_along(const std::string& dimension, const Names& names, const std::string& about);
  /// A dimension along which things are numbered first, first + 1, ...
  void number_along(const std::string& dimension, std::size_t size, int first,
                    const std::string& about);
  std::size_t size(const std::string& dimension) const { return scale(dimension).size; }

  /// Makes an array over dimensions, to be filled with Hdf5Output::append; returns its number.
  std::size_t make(const std::string& name, const Names& dimensions, const Said& said,
                   Hdf5Output::Type type = Hdf5Output::Type::f64);
  /// Makes and fills one; the last dimension fastest.
  void put(const std::string& name, const Names& dimensions, const Said& said,
           std::span<const double> values, Hdf5Output::Type type = Hdf5Output::Type::f64);
  void put_words(const std::string& name, const std::string& dimension, const Names& words,
                 const std::string& about);
  /// Says that an array along a dimension is a coordinate of whatever is made later along it.
  void mark_coordinate(const std::string& name, const std::string& dimension);
  std::string path_of(const std::string& name) const { return path_ + "/" + name; }

 private:
  struct Scale {
    std::string name;
    std::size_t dataset, size;
  };
  const Scale& scale(const std::string& dimension) const;

  Hdf5Output& file_;
  std::string path_;
  std::vector<Scale> scales_;
  std::vector<std::pair<std::string, std::string>> coordinates_;  ///< and their dimensions
};

}  // namespace drift::mc
