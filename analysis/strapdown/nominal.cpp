#include "analysis/strapdown/nominal.hpp"

#include <algorithm>

namespace drift::strapdown {
namespace {

bool estimates(const FilterSpec& filter, std::initializer_list<std::string_view> groups) {
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (filter.active[i] && filter.priors[i].kind != Prior::Kind::fixed &&
        std::find(groups.begin(), groups.end(), TermLibrary::specs[i].group.view()) != groups.end())
      return true;
  return false;
}

bool turns_with(const Model& model, std::string_view group) {
  return std::any_of(model.turning.begin(), model.turning.end(),
                     [&](std::size_t p) { return TermLibrary::specs[p].group.view() == group; });
}

}  // namespace

const std::vector<PartOfModel>& parts_of_model() {
  static const std::vector<PartOfModel> parts{
      {"accelerometer", "accelerometer bias, scale", "bias + scale", {"K0", "K1"}, true},
      {"accelerometer",
       "accelerometer misalignment",
       "bias + scale + misalignment",
       {"dP", "dO"},
       true},
      {"accelerometer",
       "accelerometer quadratic",
       "bias + scale + misalignment + quadratic",
       {"K2"},
       true},
      {"torquer_scale", "gyro scale", " + scale", {"s"}, false},
      {"gyro_misalignment", "gyro misalignment", " + misalignment", {"eta", "xi"}, false},
      {"g_drift", "g_drift, input axis alone", " + input-axis g-drift", {"D_I"}, false},
      {"g_drift", "g_drift, all axes", " + g-drift", {"D_O", "D_S"}, false},
      {"g2_drift", "g2_drift", " + g^2-drift", {"D_II", "D_OO", "D_IO", "D_IS", "D_OS"}, false}};
  return parts;
}

Model nominal_model(const FilterSpec& filter) {
  Model model;
  model.equation = filter.coupling;
  if (estimates(filter, {"K2"}))
    model.accelerometer = AccelerometerModel::quadratic;
  else if (estimates(filter, {"dP", "dO"}))
    model.accelerometer = AccelerometerModel::misaligned;
  else if (estimates(filter, {"K0", "K1"}))
    model.accelerometer = AccelerometerModel::bias_scale;
  if (estimates(filter, {"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS"}))
    model.drift = DriftOrder::g2_sensitive;
  else if (estimates(filter, {"D_O", "D_S"}))
    model.drift = DriftOrder::g_sensitive;
  else if (estimates(filter, {"D_I"}))
    model.drift = DriftOrder::input_axis;
  const auto add = [&](const std::vector<std::size_t>& group) {
    model.turning.insert(model.turning.end(), group.begin(), group.end());
  };
  if (estimates(filter, {"s"})) add(group<"s">());
  if (estimates(filter, {"eta", "xi"})) {
    add(group<"eta">());
    add(group<"xi">());
  }
  return model;
}

bool holds(const Model& model, const PartOfModel& part) {
  const std::string_view group = part.groups.front();
  if (group == "K0") return model.accelerometer >= AccelerometerModel::bias_scale;
  if (group == "dP") return model.accelerometer >= AccelerometerModel::misaligned;
  if (group == "K2") return model.accelerometer >= AccelerometerModel::quadratic;
  if (group == "D_I") return model.drift >= DriftOrder::input_axis;
  if (group == "D_O") return model.drift >= DriftOrder::g_sensitive;
  if (group == "D_II") return model.drift >= DriftOrder::g2_sensitive;
  return turns_with(model, group);
}

}  // namespace drift::strapdown
