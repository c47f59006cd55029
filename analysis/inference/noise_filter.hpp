#pragma once

#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

/// One Kalman filter whose gains depend on the noise alone; every column (residual, parameters,
/// candidates) runs through them and comes out as innovations, white and of unit variance when the
/// noise model is right (Willsky and Jones 1976). States: attitude error (new at
/// each caging, unit prior), and as the noise asks for them drift random walk, Markov drift,
/// correlated accelerometer noise, an input in one equation; all of them new in each recording.
///
/// Columns lie side by side in rows of `width` numbers, whole lanes (core/estimate/lanes.hpp): the
/// states of a few lanes of columns stay in registers while row after row goes through.
class NoiseFilter {
 public:
  NoiseFilter(const MeasuredRows& rows, const NoiseModel& noise);

  /// log det of the covariance of all rows, attitude marginalised.
  double log_det() const { return log_det_; }
  Eigen::Index rows() const { return rows_; }

  /// Where some columns stand: zero before row `first`.
  struct Columns {
    std::vector<double> state;
    std::size_t width = 0, event = 0;
    Eigen::Index row = 0;
  };
  Columns begin(std::size_t width, Eigen::Index first = 0) const;
  /// The next `count` rows; `white` may be where the rows are.
  void whiten(Columns& columns, const double* rows, double* white, Eigen::Index count) const;
  /// The way back: white rows become noise with this covariance.
  void colour(Columns& columns, const double* white, double* rows, Eigen::Index count) const;

 private:
  enum class Way { whiten, colour };
  /// Something that happens to the state in front of a row.
  struct Event {
    Eigen::Index row = 0;
    int anew = 0;  ///< so many states start anew: the attitude, with a recording all of them
    /// Otherwise attitude += drive others, others *= decay: in moves_, from here on 4 numbers for
    /// each of the others.
    std::size_t move = 0;
  };
  template <int states>
  void find_gains(const MeasuredRows& rows, const NoiseModel& noise);
  template <int states>
  void run(Way way, Columns& columns, const double* from, double* to, Eigen::Index count) const;
  template <int states, int lanes, Way way>
  void run_lanes(const Columns& columns, std::size_t column, const double* from, double* to,
                 Eigen::Index count, double* state) const;
  void run(Way way, Columns& columns, const double* from, double* to, Eigen::Index count) const;

  int states_ = 3;  ///< rounded up to those that there is code for
  Eigen::Index rows_ = 0;
  std::vector<Event> events_;
  std::vector<double> moves_;
  std::vector<double> H_, gain_;             ///< states by states of every row
  std::vector<unsigned char> reads_others_;  ///< rows on which more than the attitude is seen
  std::vector<double> root_, inverse_root_;  ///< sigma of each innovation
  double log_det_ = 0.0;
};

}  // namespace drift::inference
