#pragma once

#include <exception>
#include <span>
#include <string>
#include <vector>

#include "core/base/sha256.hpp"
#include "core/recording/hdf5_handle.hpp"

namespace drift::mc {

/// An HDF5 file in the making. It keeps account of every number and text it is given, and
/// complete() compares that with what reads back from the file: HDF5 writes late, in the closing of
/// this and that, and what it could not write reads as zeros. Objects are named by their path,
/// "/runs/point". Whatever HDF5 refuses is Refused.
class Hdf5Output {
 public:
  class Refused : public std::exception {};
  enum class Type { f64, i64, i32, i8 };  ///< in the file, little-endian; numbers come as double

  explicit Hdf5Output(const std::string& path);

  void make_group(const std::string& path);
  /// Makes a dataset; returns its number, for the calls below.
  std::size_t make_dataset(const std::string& path, Type type, std::vector<hsize_t> shape);
  /// A dataset first, first + 1, ... that names a dimension.
  std::size_t make_scale(const std::string& path, hsize_t size, int first = 0);
  /// A dataset of texts of any length. Octave, which reads numbers alone, cannot load a file that
  /// has one.
  std::size_t make_words(const std::string& path, std::vector<std::string> words);
  /// Makes a dataset name a dimension, by its own name.
  void name_dimension(std::size_t dataset);
  void attach(std::size_t dataset, std::size_t scale, unsigned dimension);
  /// The next numbers of a dataset, the last dimension fastest.
  void append(std::size_t dataset, std::span<const double> values);
  void set_text(const std::string& object, const std::string& name, const std::string& text);
  /// CF: which number of the dataset means what.
  void set_flags(const std::string& object, const std::vector<std::string>& meanings);

  /// Closes the file and reads it back.
  void complete();

 private:
  struct Dataset {
    std::string path;
    Hdf5Handle id;
    std::vector<hsize_t> shape;
    hsize_t written = 0;
    int scales = 0;  ///< attached
    Sha256 digest = {};
    std::vector<std::string> words = {};  ///< of a dataset of texts
  };
  struct Text {
    std::string object, name, text;
  };
  struct Flags {
    std::string object;
    std::size_t count;
  };

  void add_dataset(const std::string& path, hid_t type, std::vector<hsize_t> shape);
  void compare(Dataset& dataset, hid_t file) const;
  void compare(const Text& text, hid_t file) const;
  void compare(const Flags& flags, hid_t file) const;

  std::string path_;
  Hdf5Handle file_;
  std::vector<Dataset> datasets_;
  std::vector<Text> texts_;
  std::vector<Flags> flags_;
};

}  // namespace drift::mc
