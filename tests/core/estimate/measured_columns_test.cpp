// Estimators refuse what was measured along another timeline.
#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"
#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::measured_columns_test {
namespace {

using namespace drift::test;

struct MeasuredColumns : testing::Test {
  Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0);
  FilterSpec filter = base_filter(Coupling::eq5);
  Readout readout;
  Theta start = make_layout(filter).theta;
  Measurements right = Simulator(base_truth(Coupling::eq5), readout).run(timeline, 1, 0).measured;

  /// Nothing, and a few columns more or less of either channel.
  std::vector<Measurements> wrong() const {
    const Eigen::Index n = right.acc.cols();
    std::vector<Measurements> all(4, right);
    all[0] = {};
    all[1].acc = Mat3X(right.acc.leftCols(n - 3));
    all[2].gimbal = Mat3X(right.gimbal.leftCols(n - 3));
    all[3].acc = all[3].gimbal = Mat3X::Zero(3, n + 1);
    return all;
  }

  template <class Lanes, class Job>
  void run_in_lanes(const Measurements* measured) const {
    std::vector<Job> jobs(2);
    for (Job& job : jobs) {
      job.measured = &right;
      job.start = start;
    }
    jobs.back().measured = measured;
    Lanes(filter, timeline, readout).run(jobs);
  }
};

TEST_F(MeasuredColumns, AreThoseOfTheTimeline) {
  EXPECT_TRUE(is_along(right, timeline));
  const std::vector<Vec3> level(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  for (const Measurements& m : wrong()) {
    SCOPED_TRACE(testing::Message() << m.acc.cols() << " " << m.gimbal.cols());
    EXPECT_FALSE(is_along(m, timeline));
    const MeasuredTest test{timeline, readout, m};
    EXPECT_THROW(fit_batch(filter, test, start), ContractError);
    EXPECT_THROW(fit_batch_from(filter, test, start, level), ContractError);
    EXPECT_THROW(run_ekf(filter, test, start), ContractError);
    EXPECT_THROW(MeasurementEquations(test, filter.model(), make_layout(filter), 1e-3),
                 ContractError);
    EXPECT_THROW(IteratedPasses(filter, timeline, readout, start).run(m, start), ContractError);
    EXPECT_THROW((run_in_lanes<EkfLanes, EkfJob>(&m)), ContractError);
    EXPECT_THROW((run_in_lanes<IteratedLanes, IteratedJob>(&m)), ContractError);
    EXPECT_THROW(make_recording(timeline, m, readout), ContractError);
  }
  EXPECT_THROW((run_in_lanes<EkfLanes, EkfJob>(nullptr)), ContractError);
  EXPECT_THROW((run_in_lanes<IteratedLanes, IteratedJob>(nullptr)), ContractError);
  EXPECT_NO_THROW((run_in_lanes<EkfLanes, EkfJob>(&right)));
  EXPECT_NO_THROW((run_in_lanes<IteratedLanes, IteratedJob>(&right)));
}

TEST_F(MeasuredColumns, AnIntervalOrAnAttitudeThatIsNotThereIsRefused) {
  Ekf ekf(filter, timeline, readout, start, KeepHistory::no);
  EXPECT_THROW(ekf.process(timeline.intervals.size(), right.acc.col(0), right.gimbal.col(0)),
               ContractError);
  EXPECT_THROW(fit_batch_from(filter, {timeline, readout, right}, start, {}), ContractError);
}

}  // namespace
}  // namespace drift::measured_columns_test
