#include "core/recording/recording_hdf5.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/recording/hdf5_handle.hpp"

namespace drift {
namespace {

/// Text of a scalar attribute: a string, or a number in digits. Empty if it is anything else.
std::optional<std::string> attribute_text(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute) return std::nullopt;
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type || !space || H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind == H5T_INTEGER || kind == H5T_FLOAT) {
    double value = 0.0;
    if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
    return fmt::format("{}", value);
  }
  if (kind != H5T_STRING) return std::nullopt;
  std::string text;
  if (H5Tis_variable_str(type.get()) > 0) {
    const Hdf5Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    char* held = nullptr;
    if (!memory || H5Tset_size(memory.get(), H5T_VARIABLE) < 0 ||
        H5Tset_cset(memory.get(), H5Tget_cset(type.get())) < 0 ||
        H5Aread(attribute.get(), memory.get(), &held) < 0)
      return std::nullopt;
    if (held != nullptr) text = held;
    H5free_memory(held);
  } else {
    text.resize(H5Tget_size(type.get()));
    if (text.empty() || text.size() > (1u << 20) ||
        H5Aread(attribute.get(), type.get(), text.data()) < 0)
      return std::nullopt;
    text.resize(std::min(text.find('\0'), text.size()));
  }
  return text;
}

/// Whether all the numbers the dataset declares are in the file: what was never written would read
/// as plausible zeros. Says so if not.
bool all_written(hid_t dataset, std::string_view name, hsize_t n, std::size_t size,
                 Problems& problems) {
  const auto bad = [&](std::string_view wrong, std::string_view fix) {
    problems.add(name, wrong, "every declared value stored in this file", fix);
    return false;
  };
  const Hdf5Handle plan(H5Dget_create_plist(dataset), H5Pclose);
  if (!plan) return bad("the dataset cannot be examined", copy_again);
  const H5D_layout_t layout = H5Pget_layout(plan.get());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(plan.get()) > 0)
    return bad("the values are in another file", "Export a file that holds its own data");
  if (n == 0) return true;
  const double bytes = static_cast<double>(n) * static_cast<double>(size);
  const auto stored = static_cast<double>(H5Dget_storage_size(dataset));
  if (layout != H5D_CHUNKED)
    return stored >= bytes ||
           bad(fmt::format("{} values declared, {} bytes stored", n, stored), copy_again);
  hsize_t chunk = 0, written = 0;
  if (H5Pget_chunk(plan.get(), 1, &chunk) < 1 || chunk == 0)
    return bad("the chunks cannot be examined", copy_again);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  if (!space || H5Dget_num_chunks(dataset, space.get(), &written) < 0)
    return bad("the chunks cannot be examined", copy_again);
  const hsize_t expected = n / chunk + (n % chunk != 0 ? 1 : 0);
  if (written < expected)
    return bad(fmt::format("{} of {} chunks were never written", expected - written, expected),
               "The writer was stopped: end the recording properly");
  // deflate shrinks by at most 1032
  return bytes <= 1100.0 * stored + 1e6 ||
         bad("the values cannot be so many in so few bytes", copy_again);
}

class Hdf5Reader {
 public:
  explicit Hdf5Reader(RawSink& sink) : sink_(sink) {}

  void read(hid_t file) {
    const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose);
    if (!root) return damaged("the root group cannot be opened");
    H5G_info_t info{};
    if (H5Gget_info(root.get(), &info) < 0) return damaged("the root group cannot be examined");
    if (info.nlinks > 10000)
      return damaged(fmt::format("the root group holds {} objects", info.nlinks));
    const Hdf5Handle plan(H5Gget_create_plist(root.get()), H5Pclose);
    unsigned links = 0, attributes = 0;  // as the writer arranged them, if it kept the order
    if (plan) {
      H5Pget_link_creation_order(plan.get(), &links);
      H5Pget_attr_creation_order(plan.get(), &attributes);
    }
    const auto order = [](unsigned flags) {
      return (flags & H5P_CRT_ORDER_INDEXED) ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    };
    hsize_t at = 0;
    if (H5Aiterate2(root.get(), order(attributes), H5_ITER_INC, &at, &Hdf5Reader::on_attribute,
                    this) < 0)
      damaged("the attributes of the root group cannot be read");
    at = 0;
    if (H5Literate(root.get(), order(links), H5_ITER_INC, &at, &Hdf5Reader::on_link, this) < 0)
      damaged("the list of datasets cannot be read");
  }

 private:
  void damaged(std::string_view what) {
    sink_.problems().add("", what, "an undamaged HDF5 file with one dataset per channel",
                         copy_again);
  }

  static herr_t on_attribute(hid_t root, const char* name, const H5A_info_t*, void* self) {
    if (const auto text = attribute_text(root, name))
      static_cast<Hdf5Reader*>(self)->sink_.fact(name, *text);
    return 0;
  }

  static herr_t on_link(hid_t root, const char* name, const H5L_info_t* info, void* self) {
    static_cast<Hdf5Reader*>(self)->read_dataset(root, name, info->type);
    return 0;
  }

  void read_dataset(hid_t root, const std::string& name, H5L_type_t link) {
    const auto bad = [&](std::string_view wrong, std::string_view fix) {
      sink_.problems().add(in_quotes(name), wrong, "a one-dimensional numeric dataset", fix);
    };
    if (link != H5L_TYPE_HARD)
      return bad("it is a link to elsewhere", "Store the values under this name");
    const Hdf5Handle object(H5Oopen(root, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object) return bad("it cannot be opened", copy_again);
    if (H5Iget_type(object.get()) != H5I_DATASET)
      return bad("it is a group or a type", "Put the channels into the root group, without groups");
    const Hdf5Handle type(H5Dget_type(object.get()), H5Tclose);
    const Hdf5Handle space(H5Dget_space(object.get()), H5Sclose);
    if (!type || !space) return bad("it cannot be examined", copy_again);
    const H5T_class_t kind = H5Tget_class(type.get());
    if (kind != H5T_INTEGER && kind != H5T_FLOAT)
      return bad(kind == H5T_STRING ? "it holds text" : "it holds no numbers",
                 "Remove it or write numbers; text belongs into attributes");
    if (H5Sget_simple_extent_ndims(space.get()) != 1)
      return bad(fmt::format("it has {} dimensions", H5Sget_simple_extent_ndims(space.get())),
                 "Write one dataset per channel");
    const hssize_t n = H5Sget_simple_extent_npoints(space.get());
    if (n < 0) return bad("its length cannot be read", copy_again);
    if (!all_written(object.get(), in_quotes(name), static_cast<hsize_t>(n),
                     H5Tget_size(type.get()), sink_.problems()))
      return;
    std::vector<double> values(static_cast<std::size_t>(n));
    if (n > 0 &&
        H5Dread(object.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      return bad("its values cannot be read (damaged, or a compression this HDF5 lacks)",
                 "Export the file again, uncompressed or with gzip");
    sink_.column(name, values);
    auto unit = attribute_text(object.get(), "unit");
    if (!unit) unit = attribute_text(object.get(), "units");
    if (unit) sink_.unit(name, trimmed(*unit));
  }

  RawSink& sink_;
};

}  // namespace

void read_hdf5(const std::string& path, RawSink& sink) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Fis_hdf5(path.c_str()) <= 0)
    return sink.problems().add("", "it is no HDF5 file", "the format its extension says",
                               "Check how the recording was exported");
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file)
    return sink.problems().add(
        "", "the HDF5 file cannot be opened: it is damaged, cut off, or still being written",
        "a complete HDF5 file",
        "Copy or export it again; on a network drive without locks set "
        "HDF5_USE_FILE_LOCKING=FALSE");
  Hdf5Reader(sink).read(file.get());
}

}  // namespace drift
