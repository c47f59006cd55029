#pragma once

#include <Random123/philox.h>

#include <Random123/conventional/Engine.hpp>
#include <boost/random/normal_distribution.hpp>

namespace drift {

/// Standard normal numbers by the million, for tests whose null is simulated: a pure function of
/// (seed, number), by Marsaglia and Tsang's ziggurat, in a third of the time of Stream::normal.
class NormalDraws {
 public:
  NormalDraws(std::uint64_t seed, std::uint64_t number) : engine_({{seed, number}}) {}
  double operator()() { return normal_(engine_); }

 private:
  r123::Engine<r123::Philox4x64> engine_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace drift
