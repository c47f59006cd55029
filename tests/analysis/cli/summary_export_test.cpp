// The group /summary of an HDF5 export, against the rows of the CSV export and the statistics of
// summary.json: of a study in which one filter diverges here and there, and another never.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/recording/hdf5_handle.hpp"
#include "tests/support/program.hpp"

namespace drift::summary_export_test {
namespace {

using namespace drift::test;
using Json = nlohmann::json;

/// A filter whose bias of an accelerometer is sure within 0.1 ug leaves the million sigmas that an
/// estimate may be off in some of the runs.
constexpr const char* study = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell = "20 min"
sample = "2 min"
[readout]
accelerometer_noise = "0.1 ug"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "K0_x"]
[truth.parameters]
K0_x = { normal = ["0 ug", "5000 ug"] }
[[filter]]
name = "sure"
coupling = "eq5"
terms = ["fixed_drift", "K0_x"]
[filter.parameters]
K0_x = { normal = ["0 ug", "0.1 ug"] }
[[filter]]
name = "wide"
coupling = "eq5"
terms = ["fixed_drift", "K0_x"]
[filter.parameters]
K0_x = { normal = ["0 ug", "5000 ug"] }
[monte_carlo]
runs = 40
seed = 5
estimator = "iterated"
allowed_failures = 1000
[sweep]
"truth.parameters.D_F_x" = ["0.1 deg/h", "0.2 deg/h"]
)";

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// What the numbers of a column come to, and the largest of them.
struct Summary {
  std::size_t n = 0;
  double mean = 0.0, sd = 0.0, min = 0.0, max = 0.0;
  double largest() const { return std::max(std::abs(min), std::abs(max)); }
};

Summary summary_of(const std::vector<double>& values) {
  Summary s{values.size()};
  if (values.empty()) return s;
  for (const double v : values) s.mean += v / static_cast<double>(s.n);
  for (const double v : values) s.sd += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(s.sd / static_cast<double>(s.n - 1));
  s.min = *std::ranges::min_element(values);
  s.max = *std::ranges::max_element(values);
  return s;
}

/// The columns of a CSV export in their order, of each study point, over the runs that yielded
/// data.
struct Exported {
  std::vector<std::string> names;            ///< "wide/0/estimate/K0_x", without the unit
  std::vector<std::vector<Summary>> points;  ///< of each point, of each column
  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }
};

Exported read_csv(const std::string& path) {
  std::istringstream lines(text_of(path));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) continue;
  const std::vector<std::string> header = split(line);
  const auto first = static_cast<std::size_t>(
      std::ranges::find_if(header, [](const auto& h) { return h.starts_with("truth/"); }) -
      header.begin());
  Exported out;
  for (std::size_t c = first; c < header.size() && header[c].find('/') != std::string::npos; ++c)
    out.names.push_back(header[c].substr(0, header[c].find(" [")));
  std::vector<std::vector<std::vector<double>>> values(
      2, std::vector<std::vector<double>>(out.names.size()));
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = split(line);
    EXPECT_TRUE(cells[2] == "ok" || cells[2] == "filter_diverged") << line;
    for (std::size_t c = 0; c < out.names.size(); ++c)
      if (const double v = std::strtod(cells[first + c].c_str(), nullptr); std::isfinite(v))
        values[static_cast<std::size_t>(std::stoi(cells[0]))][c].push_back(v);
  }
  for (const auto& point : values) {
    out.points.emplace_back();
    for (const auto& column : point) out.points.back().push_back(summary_of(column));
  }
  return out;
}

/// /summary/WHAT, point by point.
std::vector<double> read_summary(const std::string& path, const std::string& what,
                                 std::size_t count) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle set(H5Dopen2(file.get(), ("/summary/" + what).c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  EXPECT_EQ(H5Sget_simple_extent_npoints(space.get()), static_cast<hssize_t>(count)) << what;
  std::vector<double> read(count);
  EXPECT_GE(H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()), 0);
  return read;
}

class SummaryExport : public testing::Test {
 protected:
  void SetUp() override {
    const std::string out = folder_.file("out"), file = folder_.write("s.toml", study);
    const Answer run = driftscope("run " + file + " --progress none -o " + out);
    ASSERT_EQ(run.code, 0) << run.err;
    for (const std::string format : {"csv", "hdf5"}) {
      const Answer a =
          driftscope("export " + out + " --format " + format + " -o " + folder_.file(format));
      ASSERT_EQ(a.code, 0) << a.err;
    }
    csv_ = read_csv(folder_.file("csv"));
    json_ = Json::parse(text_of(out + "/summary.json"));
  }

  /// Of every point and column.
  std::vector<double> summary(const char* what) const {
    return read_summary(folder_.file("hdf5"), what, csv_.points.size() * csv_.names.size());
  }

  ScratchFolder folder_;
  Exported csv_;
  Json json_;
};

TEST_F(SummaryExport, SaysOfEveryColumnWhatItsRowsSay) {
  const std::size_t columns = csv_.names.size();
  ASSERT_GT(columns, 20u);
  const auto n = summary("n"), mean = summary("mean"), sd = summary("sd"), min = summary("min"),
             max = summary("max");
  for (std::size_t p = 0; p < csv_.points.size(); ++p)
    for (std::size_t c = 0; c < columns; ++c) {
      const Summary& s = csv_.points[p][c];
      const std::size_t i = p * columns + c;
      SCOPED_TRACE(csv_.names[c]);
      EXPECT_EQ(n[i], static_cast<double>(s.n));
      ASSERT_GT(s.n, 1u);
      // Forty values, each printed in full and in the unit of the column: some roundings each.
      const double rounding = 1e-13 * s.largest();
      EXPECT_NEAR(mean[i], s.mean, rounding);
      EXPECT_NEAR(min[i], s.min, rounding);
      EXPECT_NEAR(max[i], s.max, rounding);
      // Of values that hardly differ the spread is what roundings leave of it.
      EXPECT_NEAR(sd[i], s.sd, 1e-12 * s.sd + 10.0 * rounding);
    }
}

TEST_F(SummaryExport, CountsRunsInWhichAnotherFilterDivergedAsTheStatisticsDo) {
  const std::size_t columns = csv_.names.size();
  const auto n = summary("n"), mean = summary("mean"), sd = summary("sd");
  ASSERT_EQ(json_["points"].size(), csv_.points.size());
  for (std::size_t p = 0; p < csv_.points.size(); ++p)
    for (const Json& filter : json_["points"][p]["filters"]) {
      const std::string name = filter["name"];
      const double diverged = filter["starts"][0]["diverged"]["hits"];
      if (name == "sure") {
        EXPECT_GT(diverged, 0.0);
        EXPECT_LT(diverged, 40.0);
      } else {
        EXPECT_EQ(diverged, 0.0);
      }
      for (const Json& parameter : filter["parameters"]) {
        const std::string key = parameter["key"];
        SCOPED_TRACE(name + " " + key);
        const auto at = [&](const std::string& column) {
          return p * columns + csv_.column(name + "/0/" + column + "/" + key);
        };
        const std::size_t estimate = at("estimate"), sigma = at("sigma");
        EXPECT_EQ(n[estimate], 40.0 - diverged);
        EXPECT_EQ(n[estimate], parameter["runs"].get<double>());
        EXPECT_EQ(n[sigma], n[estimate]);
        // The statistics have the root mean square of the sigmas.
        const double mean_square =
            mean[sigma] * mean[sigma] + sd[sigma] * sd[sigma] * (n[sigma] - 1.0) / n[sigma];
        EXPECT_NEAR(std::sqrt(mean_square) / parameter["sigma"].get<double>(), 1.0, 1e-12);
        if (name == "sure") continue;  // whose truths are those of the runs that it ended well
        const std::size_t truth = p * columns + csv_.column("truth/" + key);
        EXPECT_EQ(n[truth], 40.0);
        EXPECT_NEAR(mean[estimate] - mean[truth], parameter["bias"]["value"].get<double>(),
                    1e-13 * csv_.points[p][csv_.column("truth/" + key)].largest());
      }
    }
}

}  // namespace
}  // namespace drift::summary_export_test
