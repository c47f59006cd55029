#include <fmt/format.h>
#include <matio.h>

#include <memory>
#include <vector>

#include "core/base/seal.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_mat.hpp"
#include "core/recording/recording_output.hpp"

namespace drift {
namespace {

using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;

matvar_t* make_text(const char* name, std::string_view text) {
  std::size_t dims[2] = {text.empty() ? 0u : 1u, text.size()};
  std::string copy(text);
  return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, dims, copy.data(), 0);
}

bool write(mat_t* file, matvar_t* variable) {
  const Variable owned(variable, Mat_VarFree);
  return owned && Mat_VarWrite(file, owned.get(), MAT_COMPRESSION_NONE) == 0;
}

bool write_units(mat_t* file, const Recording& recording) {
  std::vector<const char*> names;
  for (const auto& c : recording.channels) names.push_back(c.name.c_str());
  std::size_t one[2] = {1, 1};
  Variable units(
      Mat_VarCreateStruct("units", 2, one, names.data(), static_cast<unsigned>(names.size())),
      Mat_VarFree);
  if (!units) return false;
  for (const auto& c : recording.channels) {
    matvar_t* text = make_text(nullptr, c.unit.symbol.view());
    if (text == nullptr) return false;
    Mat_VarSetStructFieldByName(units.get(), c.name.c_str(), 0, text);  // takes it over
  }
  return write(file, units.release());
}

}  // namespace

std::string write_mat(const Recording& recording, const Facts& facts, const std::string& path) {
  if (recording.rows() > (std::size_t{1} << 28) - 64)
    return "a variable of a MATLAB v5 file ends at 2 GB; write .h5 or .csv";
  // A header of our own: matio's holds the date, and the same recording should give the same bytes.
  const bool ours = !facts.empty() && facts.front().first == made_here;
  const std::string header =
      fmt::format("MATLAB 5.0 MAT-file, {}",
                  ours ? fmt::format("{}={}", seal_key, open_seal()) : "driftscope recording");
  mat_t* const file = Mat_CreateVer(path.c_str(), header.c_str(), MAT_FT_MAT5);
  if (file == nullptr) return "the file cannot be created";
  std::string wrong, lines;
  std::vector<double> values(recording.rows());
  for (const auto& c : recording.channels) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = in_unit(c.values[i], c.unit);
    std::size_t dims[2] = {values.size(), 1};
    if (!write(file, Mat_VarCreate(c.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims,
                                   values.data(), MAT_F_DONT_COPY_DATA)))
      wrong = "the channel " + c.name + " cannot be written";
  }
  for (const auto& [key, value] : facts) lines += fmt::format("{} = {}\n", key, value);
  if (!write_units(file, recording)) wrong = "the units cannot be written";
  if (!lines.empty() && !write(file, make_text("facts", lines)))
    wrong = "the facts cannot be written";
  if (Mat_Close(file) != 0) wrong = "the file cannot be completed";
  const std::size_t variables = recording.channels.size() + (lines.empty() ? 1 : 2);
  if (wrong.empty() && count_mat_v5_variables(path) != variables)
    wrong = "not all of it reaches the file (is the disk full?)";
  return wrong;
}

}  // namespace drift
