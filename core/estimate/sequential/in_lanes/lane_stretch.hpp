#pragma once

#include <array>
#include <vector>

#include "core/estimate/compressed/stretch_sums.hpp"
#include "core/estimate/sequential/in_lanes/lane_filter.hpp"

namespace drift {

/// Rows of a stretch (StretchRows) of several runs, one in each lane: what its channels read at the
/// nodes and the derivatives of that, combined as the readings are. What comes out of a lane does
/// not depend on its neighbours.
class LaneStretch {
 public:
  using Sums = std::array<const StretchSums*, static_cast<std::size_t>(Pack::width)>;

  /// Whitened rows of a channel, for each polynomial of its three axes.
  struct Channel {
    std::vector<PackMat> by_attitude;           ///< at the beginning of the stretch, of each row
    std::vector<std::vector<Pack>> by_rate;     ///< three axes of each rate state
    std::vector<std::vector<Pack>> by_readout;  ///< of each entry; empty where it does not act
    std::vector<PackVec> residual;              ///< measured minus predicted
    std::size_t rows() const { return rows_; }
    LaneFilter::Scalars scalars(std::size_t row) const;

   private:
    friend class LaneStretch;
    std::size_t rows_ = 0;  ///< of the vectors, which never become shorter
  };

  /// Works out interval i of the test, a stretch. jacobian, phi: at its nodes; readings: of each
  /// lane. Allocates nothing once it has seen the longest stretch.
  void work_out(const CompressedTest& test, std::size_t i,
                const std::vector<LaneJacobian>& jacobian, const PackVec* phi,
                const LaneLinearizer& linearizer, const Sums& readings);

  /// Of means of accelerometers, and of gimbals at the ends; without rows where they are not read.
  const Channel& channel(Reading what) const { return channels_[what == Reading::mean ? 0 : 1]; }
  /// From the beginning to the end, and three numbers of each rate state.
  const PackMat& Phi() const { return Phi_.back(); }
  const std::vector<Pack>& G() const { return G_; }
  /// StretchRows::tail, the larger of its channels.
  Pack tail() const { return tail_; }

 private:
  void resize(std::size_t nodes, std::size_t rate, std::size_t entries, const CompressedTest& test,
              std::size_t i);
  void transitions(const Interval& interval, const std::vector<LaneJacobian>& jacobian);
  void predict(const CompressedTest& test, std::size_t i, Reading what,
               const std::vector<LaneJacobian>& jacobian, const PackVec* phi,
               const LaneLinearizer& linearizer, const Sums& readings);
  void by_rate(const CompressedTest& test, std::size_t i,
               const std::vector<LaneJacobian>& jacobian);
  void by_readout(const AxisReading& how, const std::vector<LaneJacobian>& jacobian);
  void measure_tail(const Channel& channel, const std::vector<LaneLinearizer::Entry>& entries);

  std::array<Channel, 2> channels_;
  std::vector<PackMat> Phi_;               ///< from the beginning to each node
  std::vector<Pack> G_;                    ///< to the end
  std::array<std::vector<PackMat>, 2> H_;  ///< of each channel at the nodes, by the attitude there
  Pack tail_ = Pack(0.0);
  // Work: three numbers at every node, or of every row.
  std::vector<Pack> turned_back_, along_, at_nodes_, combined_;
  std::vector<PackMat> back_;
};

}  // namespace drift
