#include "core/estimate/compressed/stretch_sums.hpp"

namespace drift {

bool StretchSums::take(CompressedTest& test, const Measurements& measured) {
  test.read(measured);
  left_over_ = test.left_over();
  lagged_ = 0.0;
  channels_.resize(test.timeline().intervals.size());
  const Readout& readout = test.readout();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const StretchReadings* stretch = test.readings(i);
    if (!stretch) continue;
    const std::size_t samples = test.samples(i);
    if (readout.accelerometers &&
        !take_channel(stretch->accelerometers, samples, channels_[i][index(Reading::mean)]))
      return false;
    if (readout.gimbals &&
        !take_channel(stretch->gimbals, samples, channels_[i][index(Reading::at_end)]))
      return false;
  }
  return true;
}

bool StretchSums::take_channel(const StretchChannel& from, std::size_t samples, Channel& to) {
  for (std::size_t a = 0; a < 3; ++a) {
    const StretchChannel::Axis& axis = from.axes[a];
    if (!axis.how || axis.how->samples.size() != samples) return false;
    const MatX& basis = axis.how->projection.basis;
    const VecX& left = axis.left;
    const Eigen::Index pairs = left.size() - 1;
    to[a].reference = from.reference[static_cast<Eigen::Index>(a)];
    to[a].measured = axis.measured;
    to[a].beside.noalias() = basis.topRows(pairs).transpose() * left.tail(pairs);
    to[a].beside.noalias() += basis.bottomRows(pairs).transpose() * left.head(pairs);
    lagged_ += left.head(pairs).dot(left.tail(pairs));
  }
  return true;
}

}  // namespace drift
