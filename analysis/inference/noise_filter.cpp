#include "analysis/inference/noise_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/inference/noise/noise_covariance.hpp"
#include "core/estimate/lanes.hpp"

namespace drift::inference {
namespace {

/// Numbers of states that there is code for; states that are not there stay zero.
constexpr int rounded_up(int states) {
  for (const int n : {3, 4, 6, 9, 12, 16})
    if (states <= n) return n;
  return most_states;
}

/// Calls f.template operator()<states>().
template <class F>
void for_states(int states, F&& f) {
  switch (states) {
    case 3:
      return f.template operator()<3>();
    case 4:
      return f.template operator()<4>();
    case 6:
      return f.template operator()<6>();
    case 9:
      return f.template operator()<9>();
    case 12:
      return f.template operator()<12>();
    case 16:
      return f.template operator()<16>();
    default:
      return f.template operator()<most_states>();
  }
}

/// Lanes of columns at once whose states and innovations fit into the registers; two at least, as
/// the innovations of one would wait for each other.
template <int states>
constexpr int lanes_of() {
  constexpr int registers = lane_width == 8 ? 32 : 16, fit = (registers - 2) / (states + 1);
  return fit > 4 ? 4 : fit < 2 ? 2 : fit;
}

/// Calls body.template operator()<count>(column) for blocks of `most` lanes of columns from one on,
/// then for what is left.
template <int most, class Body>
void for_blocks(std::size_t column, std::size_t width, Body& body) {
  for (; column + most * lane_width <= width; column += most * lane_width)
    body.template operator()<most>(column);
  if constexpr (most > 1) for_blocks<most - 1>(column, width, body);
}

}  // namespace

NoiseFilter::NoiseFilter(const MeasuredRows& rows, const NoiseModel& noise) : rows_(rows.rows()) {
  states_ = rounded_up(NoiseStates(noise).count);
  const auto all = static_cast<std::size_t>(rows_);
  H_.resize(all * static_cast<std::size_t>(states_));
  reads_others_.resize(all);
  root_.resize(all);
  inverse_root_.resize(all);
  for_states(states_, [&]<int states>() { find_gains<states>(rows, noise); });
}

template <int states>
void NoiseFilter::find_gains(const MeasuredRows& rows, const NoiseModel& noise) {
  constexpr int others = states - 3;
  const NoiseStates s(noise);
  NoiseCovariance<states> P(s, noise);
  events_.reserve(4 * rows.drives.size());
  moves_.reserve(3 * rows.drives.size() * 4 * static_cast<std::size_t>(others));
  gain_.resize(H_.size() + P.whole);  // whole lanes are written
  Eigen::Index next = 0;
  double product = 1.0;  // whose log is taken now and then
  walk(
      rows, noise, s,
      [&](Anew what) {
        P.begin(what);
        events_.push_back({next, what == Anew::recording ? states : 3, 0});
      },
      [&](const NoiseStep& step) {
        if constexpr (others > 0) {
          events_.push_back({next, 0, moves_.size()});
          moves_.resize(moves_.size() + 4 * others);
          double* move = moves_.data() + events_.back().move;
          for (int m = 0; m < others; ++m, move += 4) {
            for (int i = 0; i < 3; ++i) move[i] = step.drive(i, m);
            move[3] = step.decay[m];
          }
          P.move(step);
        }
      },
      [&](Eigen::Index k, const OverStates& given, double sigma) {
        const auto at = static_cast<std::size_t>(k);
        double* const h = H_.data() + at * states;
        int seen = 0;
        for (int m = 0; m < states; ++m) {
          h[m] = m < s.count ? given[m] : 0.0;
          seen |= m >= 3 && h[m] != 0.0;
        }
        reads_others_[at] = static_cast<unsigned char>(seen);
        const double S = P.take(h, seen != 0, sigma, gain_.data() + at * states);
        root_[at] = std::sqrt(S);
        inverse_root_[at] = 1.0 / root_[at];
        product *= S;
        if (!(product > 1e-150 && product < 1e150))
          log_det_ += std::log(std::exchange(product, 1.0));
        next = k + 1;
      });
  log_det_ += std::log(product);
}

NoiseFilter::Columns NoiseFilter::begin(std::size_t width, Eigen::Index first) const {
  Columns c{std::vector<double>(static_cast<std::size_t>(states_) * width, 0.0), width, 0, first};
  while (c.event < events_.size() && events_[c.event].row < first) ++c.event;
  return c;
}

template <int states, int lanes, NoiseFilter::Way way>
void NoiseFilter::run_lanes(const Columns& columns, std::size_t column, const double* from,
                            double* to, Eigen::Index count, double* state) const {
  // What is stored must not seem to change what the loop reads; states are numbered by constants
  // alone, so that they stay in registers.
  const std::size_t width = columns.width;
  const double *const H = H_.data(), *const gains = gain_.data(), *const moves = moves_.data();
  const double* const scale = way == Way::whiten ? inverse_root_.data() : root_.data();
  const unsigned char* const reads_others = reads_others_.data();
  const Event *event = events_.data() + columns.event, *const end = events_.data() + events_.size();
  const Lanes zero = broadcast(0.0);
  Lanes x[states][lanes];
  const auto at = [&](auto* of, std::size_t row, int l) {
    return of + row * width + column + static_cast<std::size_t>(l) * lane_width;
  };
#pragma GCC unroll 19
  for (int m = 0; m < states; ++m)
#pragma GCC unroll 4
    for (int l = 0; l < lanes; ++l) x[m][l] = load(at(state, static_cast<std::size_t>(m), l));
  for (Eigen::Index r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(columns.row + r);
    for (; event != end && event->row == columns.row + r; ++event) {
      if (const int anew = event->anew; anew > 0) {
#pragma GCC unroll 19
        for (int m = 0; m < states; ++m)
#pragma GCC unroll 4
          for (int l = 0; l < lanes; ++l) x[m][l] = m < anew ? zero : x[m][l];
        continue;
      }
      const double* move = moves + event->move;
#pragma GCC unroll 16
      for (int m = 3; m < states; ++m, move += 4) {
#pragma GCC unroll 4
        for (int l = 0; l < lanes; ++l) {
          x[0][l] = mul_add(x[m][l], broadcast(move[0]), x[0][l]);
          x[1][l] = mul_add(x[m][l], broadcast(move[1]), x[1][l]);
          x[2][l] = mul_add(x[m][l], broadcast(move[2]), x[2][l]);
          x[m][l] = mul_add(x[m][l], broadcast(move[3]), zero);
        }
      }
    }
    const double *h = H + k * states, *gain = gains + k * states;
    constexpr double sign = way == Way::whiten ? -1.0 : 1.0;
    Lanes e[lanes], y[lanes];
#pragma GCC unroll 4
    for (int l = 0; l < lanes; ++l) {
      e[l] = load(at(from, static_cast<std::size_t>(r), l));
      if constexpr (way == Way::colour) e[l] = mul_add(e[l], broadcast(scale[k]), zero);
      y[l] = e[l];
    }
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m)
#pragma GCC unroll 4
      for (int l = 0; l < lanes; ++l) y[l] = mul_add(x[m][l], broadcast(sign * h[m]), y[l]);
    if (reads_others[k] != 0) {
#pragma GCC unroll 16
      for (int m = 3; m < states; ++m)
#pragma GCC unroll 4
        for (int l = 0; l < lanes; ++l) y[l] = mul_add(x[m][l], broadcast(sign * h[m]), y[l]);
    }
    // The innovation is what came out on one way, what went in on the other.
    const Lanes* innovation = way == Way::whiten ? y : e;
#pragma GCC unroll 19
    for (int m = 0; m < states; ++m)
#pragma GCC unroll 4
      for (int l = 0; l < lanes; ++l) x[m][l] = mul_add(innovation[l], broadcast(gain[m]), x[m][l]);
#pragma GCC unroll 4
    for (int l = 0; l < lanes; ++l) {
      if constexpr (way == Way::whiten) y[l] = mul_add(y[l], broadcast(scale[k]), zero);
      store(at(to, static_cast<std::size_t>(r), l), y[l]);
    }
  }
#pragma GCC unroll 19
  for (int m = 0; m < states; ++m)
#pragma GCC unroll 4
    for (int l = 0; l < lanes; ++l) store(at(state, static_cast<std::size_t>(m), l), x[m][l]);
}

template <int states>
void NoiseFilter::run(Way way, Columns& columns, const double* from, double* to,
                      Eigen::Index count) const {
  double* const state = columns.state.data();
  const auto block = [&]<int lanes>(std::size_t column) {
    way == Way::whiten
        ? run_lanes<states, lanes, Way::whiten>(columns, column, from, to, count, state)
        : run_lanes<states, lanes, Way::colour>(columns, column, from, to, count, state);
  };
  for_blocks<lanes_of<states>()>(0, columns.width, block);
  columns.row += count;
  while (columns.event < events_.size() && events_[columns.event].row < columns.row)
    ++columns.event;
}

void NoiseFilter::run(Way way, Columns& columns, const double* from, double* to,
                      Eigen::Index count) const {
  for_states(states_, [&]<int states>() { run<states>(way, columns, from, to, count); });
}

void NoiseFilter::whiten(Columns& columns, const double* rows, double* white,
                         Eigen::Index count) const {
  run(Way::whiten, columns, rows, white, count);
}
void NoiseFilter::colour(Columns& columns, const double* white, double* rows,
                         Eigen::Index count) const {
  run(Way::colour, columns, white, rows, count);
}

}  // namespace drift::inference
