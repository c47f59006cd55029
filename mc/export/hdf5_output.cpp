#include "mc/export/hdf5_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <numeric>

#include "mc/export/hdf5_box.hpp"

namespace drift::mc {
namespace {

void check(bool good) {
  if (!good) throw Hdf5Output::Refused();
}

Hdf5Handle checked(Hdf5Handle handle) {
  check(static_cast<bool>(handle));
  return handle;
}

hid_t file_type(Hdf5Output::Type type) {
  switch (type) {
    case Hdf5Output::Type::i64:
      return H5T_STD_I64LE;
    case Hdf5Output::Type::i32:
      return H5T_STD_I32LE;
    case Hdf5Output::Type::i8:
      return H5T_STD_I8LE;
    case Hdf5Output::Type::f64:
      break;
  }
  return H5T_IEEE_F64LE;
}

Hdf5Handle create_file(const std::string& path) {
  // A file that a full disk cannot take stays open within HDF5, whose handler at exit writes it
  // once more and crashes. All that matters is closed and compared by complete().
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle create = checked({H5Pcreate(H5P_FILE_CREATE), H5Pclose});
  const Hdf5Handle access = checked({H5Pcreate(H5P_FILE_ACCESS), H5Pclose});
  check(H5Pset_obj_track_times(create.get(), false) >= 0);
  // The older format has no attributes above 64 kB, which a long study file is.
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST) >= 0);
  return checked({H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create.get(), access.get()), H5Fclose});
}

/// Moves numbers of a box between memory and a dataset.
template <class Transfer>
void transfer_box(hid_t dataset, const Box& box, const Transfer& transfer) {
  const Hdf5Handle memory = checked({H5Screate_simple(1, &box.numbers, nullptr), H5Sclose});
  const Hdf5Handle space = checked({H5Dget_space(dataset), H5Sclose});
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, box.start.data(), nullptr,
                            box.count.data(), nullptr) >= 0 &&
        transfer(memory.get(), space.get()) >= 0);
}

/// The type of a text of any length.
Hdf5Handle words_type() {
  Hdf5Handle type = checked({H5Tcopy(H5T_C_S1), H5Tclose});
  check(H5Tset_size(type.get(), H5T_VARIABLE) >= 0 && H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0);
  return type;
}

void compare_words(hid_t dataset, const std::vector<std::string>& words) {
  const Hdf5Handle type = words_type();
  std::vector<char*> read(words.size(), nullptr);
  check(H5Dread(dataset, type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()) >= 0);
  bool same = true;
  for (std::size_t i = 0; i < words.size(); ++i) {
    same = same && read[i] != nullptr && words[i] == read[i];
    H5free_memory(read[i]);
  }
  check(same);
}

hsize_t count_of(const std::vector<hsize_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
}

std::vector<int> counted(std::size_t n) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

Hdf5Output::Hdf5Output(const std::string& path) : path_(path), file_(create_file(path)) {}

void Hdf5Output::make_group(const std::string& path) {
  const Hdf5Handle plan = checked({H5Pcreate(H5P_GROUP_CREATE), H5Pclose});
  check(H5Pset_obj_track_times(plan.get(), false) >= 0);  // the same results give the same bytes
  check(checked(
            {H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, plan.get(), H5P_DEFAULT), H5Gclose})
            .close());
}

void Hdf5Output::add_dataset(const std::string& path, hid_t type, std::vector<hsize_t> shape) {
  const Hdf5Handle space =
      checked({H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose});
  const Hdf5Handle plan = checked({H5Pcreate(H5P_DATASET_CREATE), H5Pclose});
  check(H5Pset_obj_track_times(plan.get(), false) >= 0);
  datasets_.push_back({path,
                       checked({H5Dcreate2(file_.get(), path.c_str(), type, space.get(),
                                           H5P_DEFAULT, plan.get(), H5P_DEFAULT),
                                H5Dclose}),
                       std::move(shape)});
}

std::size_t Hdf5Output::make_dataset(const std::string& path, Type type,
                                     std::vector<hsize_t> shape) {
  add_dataset(path, file_type(type), std::move(shape));
  return datasets_.size() - 1;
}

std::size_t Hdf5Output::make_scale(const std::string& path, hsize_t size, int first) {
  const std::size_t scale = make_dataset(path, Type::i64, {size});
  constexpr hsize_t most = 1 << 17;  // 1 MB at a time: a study may have more runs than memory holds
  std::vector<double> numbers;
  for (hsize_t from = 0; from < size; from += numbers.size()) {
    numbers.resize(std::min(most, size - from));
    std::iota(numbers.begin(), numbers.end(),
              static_cast<double>(first) + static_cast<double>(from));
    append(scale, numbers);
  }
  name_dimension(scale);
  return scale;
}

std::size_t Hdf5Output::make_words(const std::string& path, std::vector<std::string> words) {
  const Hdf5Handle type = words_type();
  add_dataset(path, type.get(), {words.size()});
  Dataset& d = datasets_.back();
  std::vector<const char*> texts;
  for (const std::string& word : words) texts.push_back(word.c_str());
  check(H5Dwrite(d.id.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) >= 0);
  d.written = words.size();
  d.words = std::move(words);
  return datasets_.size() - 1;
}

void Hdf5Output::name_dimension(std::size_t dataset) {
  const Dataset& d = datasets_[dataset];
  check(H5DSset_scale(d.id.get(), d.path.substr(d.path.rfind('/') + 1).c_str()) >= 0);
}

void Hdf5Output::attach(std::size_t dataset, std::size_t scale, unsigned dimension) {
  Dataset& d = datasets_[dataset];
  check(H5DSattach_scale(d.id.get(), datasets_[scale].id.get(), dimension) >= 0);
  ++d.scales;
}

void Hdf5Output::append(std::size_t dataset, std::span<const double> values) {
  Dataset& d = datasets_[dataset];
  d.digest.update(values);
  while (!values.empty()) {
    const Box box = largest_box(d.shape, d.written, values.size());
    check(box.numbers > 0);
    transfer_box(d.id.get(), box, [&](hid_t memory, hid_t space) {
      return H5Dwrite(d.id.get(), H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data());
    });
    d.written += box.numbers;
    values = values.subspan(box.numbers);
  }
}

void Hdf5Output::set_text(const std::string& object, const std::string& name,
                          const std::string& text) {
  const Hdf5Handle type = checked({H5Tcopy(H5T_C_S1), H5Tclose});
  const Hdf5Handle space = checked({H5Screate(H5S_SCALAR), H5Sclose});
  check(H5Tset_size(type.get(), text.size() + 1) >= 0 &&
        H5Tset_cset(type.get(), H5T_CSET_UTF8) >= 0);
  Hdf5Handle attribute =
      checked({H5Acreate_by_name(file_.get(), object.c_str(), name.c_str(), type.get(), space.get(),
                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose});
  check(H5Awrite(attribute.get(), type.get(), text.c_str()) >= 0 && attribute.close());
  texts_.push_back({object, name, text});
}

void Hdf5Output::set_flags(const std::string& object, const std::vector<std::string>& meanings) {
  const std::vector<int> values = counted(meanings.size());
  const hsize_t n = values.size();
  const Hdf5Handle space = checked({H5Screate_simple(1, &n, nullptr), H5Sclose});
  Hdf5Handle attribute =
      checked({H5Acreate_by_name(file_.get(), object.c_str(), "flag_values", H5T_STD_I32LE,
                                 space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose});
  check(H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()) >= 0 && attribute.close());
  flags_.push_back({object, values.size()});
  set_text(object, "flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
}

void Hdf5Output::complete() {
  for (Dataset& d : datasets_) check(d.written == count_of(d.shape) && d.id.close());
  check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0 && file_.close());
  Hdf5Handle file = checked({H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose});
  for (Dataset& d : datasets_) compare(d, file.get());
  for (const Text& t : texts_) compare(t, file.get());
  for (const Flags& f : flags_) compare(f, file.get());
  check(file.close());
}

void Hdf5Output::compare(Dataset& dataset, hid_t file) const {
  constexpr hsize_t most = 1 << 20;  // 8 MB at a time
  const Hdf5Handle set = checked({H5Dopen2(file, dataset.path.c_str(), H5P_DEFAULT), H5Dclose});
  const Hdf5Handle space = checked({H5Dget_space(set.get()), H5Sclose});
  const hsize_t count = count_of(dataset.shape);
  check(H5Sget_simple_extent_npoints(space.get()) == static_cast<hssize_t>(count));
  for (unsigned k = 0; k < dataset.shape.size() && dataset.scales > 0; ++k)
    check(H5DSget_num_scales(set.get(), k) == 1);
  if (!dataset.words.empty()) return compare_words(set.get(), dataset.words);
  std::vector<double> values;
  Sha256 digest;
  for (hsize_t from = 0; from < count; from += values.size()) {
    const Box box = largest_box(dataset.shape, from, std::min(most, count - from));
    values.resize(box.numbers);
    transfer_box(set.get(), box, [&](hid_t memory, hid_t part) {
      return H5Dread(set.get(), H5T_NATIVE_DOUBLE, memory, part, H5P_DEFAULT, values.data());
    });
    digest.update(values);
  }
  check(digest.finish() == dataset.digest.finish());
}

void Hdf5Output::compare(const Text& text, hid_t file) const {
  const Hdf5Handle attribute = checked(
      {H5Aopen_by_name(file, text.object.c_str(), text.name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
       H5Aclose});
  const Hdf5Handle type = checked({H5Aget_type(attribute.get()), H5Tclose});
  std::string read(H5Tget_size(type.get()), '?');
  check(H5Aread(attribute.get(), type.get(), read.data()) >= 0 && read.c_str() == text.text);
}

void Hdf5Output::compare(const Flags& flags, hid_t file) const {
  const Hdf5Handle attribute =
      checked({H5Aopen_by_name(file, flags.object.c_str(), "flag_values", H5P_DEFAULT, H5P_DEFAULT),
               H5Aclose});
  const Hdf5Handle space = checked({H5Aget_space(attribute.get()), H5Sclose});
  check(H5Sget_simple_extent_npoints(space.get()) == static_cast<hssize_t>(flags.count));
  std::vector<int> read(flags.count, -1);
  check(H5Aread(attribute.get(), H5T_NATIVE_INT, read.data()) >= 0 && read == counted(flags.count));
}

}  // namespace drift::mc
