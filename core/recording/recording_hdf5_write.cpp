#include <hdf5_hl.h>

#include <vector>

#include "core/recording/hdf5_handle.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_hdf5.hpp"

namespace drift {
namespace {

bool set_text(hid_t object, const std::string& name, std::string_view value) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const std::string text(value);
  if (!type || !space || H5Tset_size(type.get(), text.size() + 1) < 0 ||
      H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0)
    return false;
  const Hdf5Handle attribute(
      H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  return attribute && H5Awrite(attribute.get(), type.get(), text.c_str()) >= 0;
}

Hdf5Handle write_channel(hid_t file, const Channel& channel, std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = in_unit(channel.values[i], channel.unit);
  const hsize_t n = values.size();
  const Hdf5Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  const Hdf5Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  // Without time stamps the same recording gives the same bytes.
  if (!space || !plan || H5Pset_obj_track_times(plan.get(), false) < 0) return {-1, H5Dclose};
  Hdf5Handle dataset(H5Dcreate2(file, channel.name.c_str(), H5T_IEEE_F64LE, space.get(),
                                H5P_DEFAULT, plan.get(), H5P_DEFAULT),
                     H5Dclose);
  if (!dataset ||
      (n > 0 && H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                         values.data()) < 0) ||
      !set_text(dataset.get(), "unit", channel.unit.symbol.view()) ||
      !set_text(dataset.get(), "units",
                channel.unit.symbol.view()))  // the name that CF readers look for
    return {-1, H5Dclose};
  return dataset;
}

}  // namespace

std::string write_hdf5(const Recording& recording, const Facts& facts, const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Hdf5Handle plan(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  constexpr unsigned order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
  if (!plan || H5Pset_obj_track_times(plan.get(), false) < 0 ||  // of the root group
      H5Pset_link_creation_order(plan.get(), order) < 0 ||
      H5Pset_attr_creation_order(plan.get(), order) < 0)
    return "HDF5 does not start";
  Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, plan.get(), H5P_DEFAULT), H5Fclose);
  if (!file) return "HDF5 cannot create the file";
  for (const auto& [key, value] : facts)
    if (!set_text(file.get(), key, value)) return "HDF5 cannot write the fact " + key;
  std::vector<double> values(recording.rows());
  std::vector<Hdf5Handle> datasets;
  const std::size_t none = recording.channels.size();
  std::size_t time = none;
  for (const auto& channel : recording.channels) {
    if (channel.name == "time") time = datasets.size();
    datasets.push_back(write_channel(file.get(), channel, values));
    if (!datasets.back()) return "HDF5 cannot write the channel " + channel.name;
  }
  if (time != none) {
    if (H5DSset_scale(datasets[time].get(), "time") < 0) return "HDF5 cannot write the time scale";
    for (std::size_t i = 0; i < datasets.size(); ++i)
      if (i != time && H5DSattach_scale(datasets[i].get(), datasets[time].get(), 0) < 0)
        return "HDF5 cannot attach the time scale";
  }
  for (auto& dataset : datasets)
    if (!dataset.close()) return "HDF5 cannot complete a channel";
  if (H5Fflush(file.get(), H5F_SCOPE_GLOBAL) < 0 || !file.close())
    return "HDF5 cannot complete the file";
  return {};
}

}  // namespace drift
