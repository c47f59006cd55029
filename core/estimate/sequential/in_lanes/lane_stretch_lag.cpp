#include "core/estimate/sequential/in_lanes/lane_stretch_lag.hpp"

#include <algorithm>

#include "core/estimate/sequential/in_lanes/lane_tiles.hpp"

namespace drift {

LaneStretchLag::LaneStretchLag(const CompressedTest& test, std::size_t parameters, std::size_t rate,
                               const std::vector<LaneLinearizer::Entry>& readout)
    : test_(test),
      parameters_(parameters),
      rate_(rate),
      readout_(readout),
      stretches_(test.timeline().intervals.size()),
      Phi_(stretches_.size()),
      G_(stretches_.size()),
      N_(3 * rate),
      by_parameter_(3 * parameters) {}

void LaneStretchLag::pass(std::size_t i, const PackMat& Phi, const std::vector<Pack>& G) {
  Phi_[i] = Phi;
  G_[i] = G;
}

void LaneStretchLag::go_back(const PackMat& Phi, const std::vector<Pack>& G) {
  const PackMat back = Phi.inverse().eval();
  M_ = times(back, M_);
  for (std::size_t c = 0; c < N_.size(); c += 3) {
    const Pack rest[3] = {N_[c] - G[c], N_[c + 1] - G[c + 1], N_[c + 2] - G[c + 2]};
    for (std::size_t a = 0; a < 3; ++a)
      N_[c + a] = row_times(back, static_cast<int>(a), rest, Pack(0.0));
  }
}

Pack LaneStretchLag::sum(const std::vector<LaneFilter>& ends, const std::vector<Pack>& moved,
                         const LaneInformation& information, const LaneStretch::Sums& readings) {
  const auto& intervals = test_.timeline().intervals;
  Pack sum = Pack::of_each([&](int l) { return readings[static_cast<std::size_t>(l)]->lagged(); });
  for (std::size_t i = intervals.size(); i-- > 0;) {
    if (i + 1 == intervals.size() || intervals[i + 1].cage) {
      M_ = in_all_lanes(Mat3::Identity());
      std::ranges::fill(N_, Pack(0.0));
    }
    if (!test_.readings(i)) {
      go_back(Phi_[i], G_[i]);
      continue;
    }
    go_back(stretches_[i].Phi(), stretches_[i].G());
    const LaneFilter& end = ends[static_cast<std::size_t>(intervals[i].chain)];
    for (std::size_t k = 0; k < parameters_; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        by_parameter_[3 * k + a] = row_times(M_, static_cast<int>(a), end.by_parameter(k),
                                             k < rate_ ? N_[3 * k + a] : Pack(0.0));
    for (const Reading what : {Reading::mean, Reading::at_end})
      if (stretches_[i].channel(what).rows() > 0)
        sum += of_channel(i, what, end, moved, information, readings);
  }
  return sum;
}

/// Four rows of an axis from the first on over the parameters, column k of row r at 4 k + r.
void LaneStretchLag::rows_of_axis(const LaneStretch::Channel& channel, std::size_t axis,
                                  std::size_t first, Pack* tiles) const {
  const int a = static_cast<int>(axis);
  for (std::size_t r = 0; r < 4; ++r) {
    const std::size_t p = first + r;
    if (p >= channel.rows()) {
      for (std::size_t k = 0; k < parameters_; ++k) tiles[4 * k + r] = Pack(0.0);
      continue;
    }
    for (std::size_t k = 0; k < parameters_; ++k)
      tiles[4 * k + r] = row_times(channel.by_attitude[p], a, &by_parameter_[3 * k],
                                   k < rate_ ? channel.by_rate[p][3 * k + axis] : Pack(0.0));
    if (channel.by_readout.empty()) continue;
    for (std::size_t e = 0; e < readout_.size(); ++e)
      if (readout_[e].slot == a)
        tiles[4 * (rate_ + readout_[e].state) + r] += channel.by_readout[p][e];
  }
}

Pack LaneStretchLag::of_channel(std::size_t i, Reading what, const LaneFilter& end,
                                const std::vector<Pack>& moved, const LaneInformation& information,
                                const LaneStretch::Sums& readings) {
  const LaneStretch::Channel& channel = stretches_[i].channel(what);
  const MatX& neighbours = test_.complete(i, what).neighbours;
  const std::size_t rows = channel.rows(), fours = (rows + 3) / 4;
  const auto N = [&](std::size_t p, std::size_t q) {
    if (p >= rows || q >= rows) return Pack(0.0);
    const auto k = static_cast<Eigen::Index>(p), l = static_cast<Eigen::Index>(q);
    return Pack(0.5 * (neighbours(k, l) + neighbours(l, k)));
  };
  const PackVec offset = times_vector(M_, end.beside_parameters());
  const PackMat V = times(times(M_, end.variance()), PackMat(M_.transpose()));
  if (white_.size() < fours) white_.resize(fours);
  residual_.resize(4 * fours);
  by_rest_.resize(rows);
  Pack sum(0.0);
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    for (std::size_t f = 0; f < fours; ++f) {
      std::vector<Pack>& white = white_[f];
      white.resize(information.padded() * 4, Pack(0.0));
      rows_of_axis(channel, a, 4 * f, white.data());
      for (std::size_t r = 0; r < 4; ++r) {
        const std::size_t p = 4 * f + r;
        if (p >= rows) continue;
        Pack e = channel.residual[p][axis] -
                 row_times(channel.by_attitude[p], axis, offset.data(), Pack(0.0));
        for (std::size_t k = 0; k < parameters_; ++k) e = mul_add(-white[4 * k + r], moved[k], e);
        residual_[p] = e;
        for (int b = 0; b < 3; ++b)
          by_rest_[p][b] = row_times(channel.by_attitude[p], axis, &V(0, b), Pack(0.0));
      }
      information.whiten(white.data());
    }
    for (std::size_t f = 0; f < fours; ++f)
      for (std::size_t g = 0; g <= f; ++g) {
        Pack tile[16];
        for (Pack& t : tile) t = Pack(0.0);
        for (std::size_t k = 0; k < information.padded(); ++k)
          add_product<Sign::plus>(&white_[f][4 * k], &white_[g][4 * k], tile);
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t q = 0; q < 4; ++q) {
            const std::size_t p = 4 * f + r, o = 4 * g + q;
            if (p >= rows || o >= rows) continue;
            // What the parameters and the rest say, and the residuals themselves.
            const Pack covariance =
                row_times(channel.by_attitude[p], axis, by_rest_[o].data(), tile[4 * r + q]);
            sum = mul_add(Pack(f == g ? 1.0 : 2.0) * N(p, o),
                          mul_add(residual_[p], residual_[o], covariance), sum);
          }
      }
    for (std::size_t p = 0; p < rows; ++p) {
      const Pack beside = Pack::of_each([&](int l) {
        return readings[static_cast<std::size_t>(l)]
            ->of(i, what)[a]
            .beside[static_cast<Eigen::Index>(p)];
      });
      sum = mul_add(residual_[p], beside, sum);
    }
  }
  return sum;
}

}  // namespace drift
