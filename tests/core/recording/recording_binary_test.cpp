#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include <functional>

#include "recording_fixture.hpp"

namespace drift::recording_binary_test {
namespace {

using namespace test;

/// A good HDF5 recording that a test then spoils.
std::string spoiled_h5(const Folder& folder, const std::function<void(hid_t)>& spoil) {
  const std::string path = folder / "bad.h5";
  write_recording(platform_recording(), path);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  EXPECT_GE(file, 0);
  spoil(file);
  EXPECT_GE(H5Fclose(file), 0);
  return path;
}

void add_dataset(hid_t file, const char* name, hid_t type, std::vector<hsize_t> dims,
                 hid_t plan = H5P_DEFAULT, bool write = true) {
  const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, plan, H5P_DEFAULT);
  EXPECT_GE(set, 0);
  if (write) {
    hsize_t n = H5Tget_size(type);
    for (const auto d : dims) n *= d;
    const std::vector<char> zeros(n);
    EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data()), 0);
  }
  H5Dclose(set);
  H5Sclose(space);
}

struct H5Case {
  const char* name;
  std::function<void(hid_t)> spoil;
  const char* says;
};

class MalformedHdf5 : public ::testing::TestWithParam<H5Case> {};
INSTANTIATE_TEST_SUITE_P(
    Recording, MalformedHdf5,
    ::testing::Values(
        H5Case{"Group", [](hid_t f) { H5Gclose(H5Gcreate2(f, "g", 0, 0, 0)); },
               "'g': it is a group"},
        H5Case{"TwoDimensions",
               [](hid_t f) {
                 add_dataset(f, "m", H5T_NATIVE_DOUBLE, {40, 3});
               },
               "'m': it has 2 dimensions"},
        H5Case{"Scalar", [](hid_t f) { add_dataset(f, "m", H5T_NATIVE_DOUBLE, {}); },
               "'m': it has 0 dimensions"},
        H5Case{"Text", [](hid_t f) { add_dataset(f, "t", H5T_C_S1, {40}); }, "'t': it holds text"},
        H5Case{"OtherLength", [](hid_t f) { add_dataset(f, "t", H5T_NATIVE_DOUBLE, {39}); },
               ":t: 39 values (expected 40"},
        H5Case{"NoUnit",
               [](hid_t f) {
                 for (const char* name : {"unit", "units"})
                   H5Adelete_by_name(f, "acc_x", name, H5P_DEFAULT);
               },
               ":acc_x: the unit is missing"},
        H5Case{"SoftLink", [](hid_t f) { H5Lcreate_soft("/time", f, "s", 0, 0); },
               "'s': it is a link to elsewhere"},
        H5Case{"ExternalLink",
               [](hid_t f) { H5Lcreate_external("/etc/passwd", "/", f, "s", 0, 0); },
               "'s': it is a link"},
        H5Case{"MissingTime", [](hid_t f) { H5Ldelete(f, "time", 0); },
               ":time: the column is missing"},
        H5Case{"NeverWritten",
               [](hid_t f) { add_dataset(f, "t", H5T_NATIVE_DOUBLE, {40}, H5P_DEFAULT, false); },
               "0 bytes stored"},
        H5Case{"ChunkNeverWritten",
               [](hid_t f) {
                 const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
                 const hsize_t chunk = 8;
                 H5Pset_chunk(plan, 1, &chunk);
                 add_dataset(f, "t", H5T_NATIVE_DOUBLE, {40}, plan, false);
                 H5Pclose(plan);
               },
               "5 of 5 chunks were never written"},
        H5Case{"ChunksOfManyMillions",
               [](hid_t f) {
                 const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
                 const hsize_t chunk = 1u << 20;
                 H5Pset_chunk(plan, 1, &chunk);
                 add_dataset(f, "t", H5T_NATIVE_DOUBLE, {hsize_t{1} << 50}, plan, false);
                 H5Pclose(plan);
               },
               "chunks were never written"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_P(MalformedHdf5, IsRefusedWithPlaceExpectationAndRemedy) {
  const Folder folder;
  const std::string path = spoiled_h5(folder, GetParam().spoil);
  const Reading a = answer(path, RecordingKind::platform);
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording)) << a.text;
  EXPECT_EQ(a.text.rfind(path + ":", 0), 0u) << a.text;
  EXPECT_NE(a.text.find(GetParam().says), std::string::npos) << a.text;
  EXPECT_NE(a.text.find("(expected "), std::string::npos) << a.text;
}

struct MatCase {
  const char* name;
  std::function<matvar_t*()> extra;
  const char* says;
};

matvar_t* doubles(const char* name, std::vector<std::size_t> dims, int flags = 0) {
  static double zeros[400] = {};
  mat_complex_split_t both{zeros, zeros};
  void* data = (flags & MAT_F_COMPLEX) ? static_cast<void*>(&both) : zeros;
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(dims.size()), dims.data(),
                       data, flags);
}

matvar_t* text(const char* name, std::string value) {
  std::size_t dims[2] = {1, value.size()};
  return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, dims, value.data(), 0);
}

class MalformedMat : public ::testing::TestWithParam<MatCase> {};
INSTANTIATE_TEST_SUITE_P(
    Recording, MalformedMat,
    ::testing::Values(MatCase{"Complex",
                              [] {
                                return doubles("c", {40, 1}, MAT_F_COMPLEX);
                              },
                              "'c': it is complex"},
                      MatCase{"Matrix",
                              [] {
                                return doubles("m", {40, 3});
                              },
                              "'m': it is a 40 x 3 matrix"},
                      MatCase{"ThreeDimensions",
                              [] {
                                return doubles("m", {4, 3, 2});
                              },
                              "'m': it has 3 dimensions"},
                      MatCase{"OtherLength",
                              [] {
                                return doubles("m", {1, 39});
                              },
                              ":m: 39 values (expected 40"},
                      MatCase{"ScalarBeside",
                              [] {
                                return doubles("fs", {1, 1});
                              },
                              ":fs: 1 values (expected 40"},
                      MatCase{"NoUnit",
                              [] {
                                return doubles("loop_eta_x", {40, 1});
                              },
                              ":loop_eta_x: the unit is missing"},
                      MatCase{"Text", [] { return text("t", "words"); }, "'t': it is a text"},
                      MatCase{"Cell",
                              [] {
                                std::size_t dims[2] = {1, 1};
                                return Mat_VarCreate("c", MAT_C_CELL, MAT_T_CELL, 2, dims, nullptr,
                                                     0);
                              },
                              "'c': it is a cell array"},
                      MatCase{"Struct",
                              [] {
                                std::size_t dims[2] = {1, 1};
                                const char* fields[] = {"a"};
                                return Mat_VarCreateStruct("s", 2, dims, fields, 1);
                              },
                              "'s': it is a struct"},
                      MatCase{"Sparse",
                              [] {
                                static mat_uint32_t ir[] = {0}, jc[] = {0, 1};
                                static double value[] = {1.0};
                                static mat_sparse_t sparse{1, ir, 1, jc, 2, 1, value};
                                std::size_t dims[2] = {40, 1};
                                return Mat_VarCreate("s", MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims,
                                                     &sparse, 0);
                              },
                              "'s': it is a sparse matrix"},
                      MatCase{"UnitOfNothing", [] { return text("oil_unit", "degC"); },
                              ":oil: a unit is given but"},
                      MatCase{"UnitIsNumber",
                              [] {
                                return doubles("acc_x_unit", {1, 1});
                              },
                              "'acc_x_unit': it is a numeric array"},
                      MatCase{"FactsAreNumbers",
                              [] {
                                return doubles("facts", {1, 1});
                              },
                              "facts: it is a numeric array"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST_P(MalformedMat, IsRefusedWithPlaceExpectationAndRemedy) {
  const Folder folder;
  const std::string path = folder / "bad.mat";
  Recording r = platform_recording();
  r.facts.clear();
  write_recording(r, path);
  mat_t* file = Mat_Open(path.c_str(), MAT_ACC_RDWR);
  ASSERT_NE(file, nullptr);
  matvar_t* extra = GetParam().extra();
  ASSERT_NE(extra, nullptr);
  ASSERT_EQ(Mat_VarWrite(file, extra, MAT_COMPRESSION_NONE), 0);
  Mat_VarFree(extra);
  Mat_Close(file);
  const Reading a = answer(path, RecordingKind::platform);
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording)) << a.text;
  EXPECT_EQ(a.text.rfind(path + ":", 0), 0u) << a.text;
  EXPECT_NE(a.text.find(GetParam().says), std::string::npos) << a.text;
  EXPECT_NE(a.text.find("(expected "), std::string::npos) << a.text;
}

TEST(MalformedBinary, GarbageAndOtherFormatsAreRefused) {
  const Folder folder;
  std::string garbage;
  for (unsigned i = 0, x = 1; i < 5000; ++i)
    garbage += static_cast<char>((x = x * 1664525u + 1013904223u) >> 24);
  write_recording(platform_recording(), folder / "good.h5");
  write_recording(platform_recording(), folder / "good.mat");
  write_recording(platform_recording(), folder / "good.csv");
  const std::string texts[] = {"",
                               "x",
                               garbage,
                               bytes_of(folder / "good.csv"),
                               bytes_of(folder / "good.h5"),
                               bytes_of(folder / "good.mat")};
  for (std::size_t i = 0; i < std::size(texts); ++i)
    for (const char* name : {"bad.csv", "bad.h5", "bad.hdf5", "bad.mat"}) {
      if ((i == 3 && name[4] == 'c') || (i == 4 && name[4] == 'h') || (i == 5 && name[4] == 'm'))
        continue;
      const std::string path = folder.write(name, texts[i]);
      const Reading a = answer(path, RecordingKind::platform);
      EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording))
          << name << " " << i << ": " << a.text;
      EXPECT_EQ(a.text.rfind(path + ":", 0), 0u) << a.text;
    }
}

TEST(MalformedBinary, Matlab73FilesAreRead) {
  const Folder folder;
  const std::string path = folder / "v73.mat";
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT73);
  ASSERT_NE(file, nullptr);
  double values[3] = {1, 2, 3};
  std::size_t dims[2] = {3, 1};
  for (const char* name : {"time", "position", "acc_x", "acc_y", "acc_z"}) {
    matvar_t* v = Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values, 0);
    ASSERT_EQ(Mat_VarWrite(file, v, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(v);
    const std::string name_unit = std::string(name) + "_unit";
    if (std::string_view(name) == "position") continue;
    v = text(name_unit.c_str(), name[0] == 't' ? "s" : "mg");
    ASSERT_EQ(Mat_VarWrite(file, v, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(v);
  }
  Mat_Close(file);
  const Recording r = read_recording(path, RecordingKind::platform, gravity);
  EXPECT_EQ(r.find("acc_y")->values, (std::vector<double>{1e-3, 2e-3, 3e-3}));
  const std::string all = bytes_of(path);
  for (const std::size_t part : {all.size() / 4, all.size() / 2, all.size() - 1})
    EXPECT_EQ(answer(folder.write("cut.mat", all.substr(0, part)), RecordingKind::platform).code,
              4);
}

}  // namespace
}  // namespace drift::recording_binary_test
