#include "analysis/inference/noise_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/inference/noise/noise_states.hpp"
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

}  // namespace

NoiseFilter::NoiseFilter(const MeasuredRows& rows, const NoiseModel& noise) : rows_(rows.rows()) {
  const int used = NoiseStates(noise).count;
  states_ = rounded_up(used);
  const auto all = static_cast<std::size_t>(rows_);
  H_.resize(all * static_cast<std::size_t>(states_));
  gain_.resize(H_.size());
  reads_others_.resize(all);
  root_.resize(all);
  for_states(states_, [&]<int states>() { find_gains<states>(rows, noise, used); });
}

template <int states>
void NoiseFilter::find_gains(const MeasuredRows& rows, const NoiseModel& noise, int used) {
  constexpr int others = states - 3;
  constexpr int whole = static_cast<int>(whole_lanes(states));  // rows: Eigen handles them by lanes
  using Pairs = Eigen::Matrix<double, whole, states>;           // by its columns, each whole lanes
  const NoiseStates s(noise);
  Pairs P = Pairs::Zero();
  const OverPairs initial = initial_covariance(s, noise);
  P.topLeftCorner(used, used) = initial;
  events_.reserve(4 * rows.drives.size());
  moves_.reserve(3 * rows.drives.size() * 4 * static_cast<std::size_t>(others));
  Eigen::Index next = 0;
  double product = 1.0;  // whose log is taken now and then
  walk(
      rows, noise, s,
      [&](Anew what) {
        if (what == Anew::recording) {
          P.topLeftCorner(used, used) = initial;
          events_.push_back({next, states, 0});
          return;
        }
        P.template topRows<3>().setZero();
        P.template leftCols<3>().setZero();
        P.template topLeftCorner<3, 3>().setIdentity();
        events_.push_back({next, 3, 0});
      },
      [&](const NoiseStep& step) {
        if constexpr (others > 0) {
          events_.push_back({next, 0, moves_.size()});
          moves_.resize(moves_.size() + 4 * others);
          double* const move = moves_.data() + events_.back().move;
          Eigen::Matrix<double, whole, 1> decay = Eigen::Matrix<double, whole, 1>::Ones();
          for (int m = 0; m < others; ++m) {
            for (int i = 0; i < 3; ++i) move[4 * m + i] = step.drive(i, m);
            move[4 * m + 3] = decay[3 + m] = step.decay[m];
          }
          // F P F' of F = [1, drive; 0, decay].
          for (int c = 0; c < states; ++c) {
            for (int m = 0; m < others; ++m)
              P.col(c).template head<3>() += P(3 + m, c) * step.drive.col(m);
            P.col(c).array() *= decay.array();
          }
          for (int m = 0; m < others; ++m) {
            for (int i = 0; i < 3; ++i) P.col(i) += P.col(3 + m) * step.drive(i, m);
            P.col(3 + m) *= step.decay[m];
            P(3 + m, 3 + m) += step.variance[m];
          }
          if constexpr (others >= 3)
            if (step.kicked) {  // of the first of the others
              P.template topLeftCorner<3, 3>() += step.kick * step.kick.transpose();
              P.template block<3, 3>(0, 3) += step.kick;
              P.template block<3, 3>(3, 0) += step.kick.transpose();
            }
          P.template topLeftCorner<3, 3>() += step.anew * step.anew.transpose();
        }
      },
      [&](Eigen::Index k, const OverStates& given, double sigma) {
        const auto at = static_cast<std::size_t>(k);
        double* const h = H_.data() + at * states;  // zero from `used` on
        double* const gain = gain_.data() + at * states;
        std::copy_n(given.data(), used, h);
        Eigen::Matrix<double, whole, 1> Ph = P.col(0) * h[0];
        for (int m = 1; m < states; ++m) Ph += P.col(m) * h[m];
        double S = sigma * sigma;
        for (int m = 0; m < states; ++m) S += h[m] * Ph[m];
        root_[at] = std::sqrt(S);
        const double inverse = 1.0 / S;
        for (int m = 0; m < states; ++m) {
          gain[m] = Ph[m] * inverse;
          P.col(m) -= Ph * gain[m];
        }
        reads_others_[at] = std::any_of(h + 3, h + states, [](double x) { return x != 0.0; });
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
  const std::size_t width = columns.width;
  const Lanes zero = broadcast(0.0);
  Lanes x[states][lanes];
  const auto at = [&](auto* of, std::size_t row, int l) {
    return of + row * width + column + static_cast<std::size_t>(l) * lane_width;
  };
  for (int m = 0; m < states; ++m)
    for (int l = 0; l < lanes; ++l) x[m][l] = load(at(state, static_cast<std::size_t>(m), l));
  std::size_t event = columns.event;
  for (Eigen::Index r = 0; r < count; ++r) {
    const auto k = static_cast<std::size_t>(columns.row + r);
    for (; event < events_.size() && events_[event].row == columns.row + r; ++event) {
      if (const int anew = events_[event].anew; anew > 0) {
        for (int m = 0; m < anew; ++m)
          for (int l = 0; l < lanes; ++l) x[m][l] = zero;
        continue;
      }
      const double* move = moves_.data() + events_[event].move;
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
    const double *h = H_.data() + k * states, *gain = gain_.data() + k * states;
    constexpr double sign = way == Way::whiten ? -1.0 : 1.0;
    Lanes e[lanes], y[lanes];
    for (int l = 0; l < lanes; ++l) {
      e[l] = load(at(from, static_cast<std::size_t>(r), l));
      if constexpr (way == Way::colour) e[l] = mul_add(e[l], broadcast(root_[k]), zero);
      y[l] = e[l];
    }
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m)
      for (int l = 0; l < lanes; ++l) y[l] = mul_add(x[m][l], broadcast(sign * h[m]), y[l]);
    if (reads_others_[k]) {
#pragma GCC unroll 16
      for (int m = 3; m < states; ++m)
        for (int l = 0; l < lanes; ++l) y[l] = mul_add(x[m][l], broadcast(sign * h[m]), y[l]);
    }
    // The innovation is what came out on one way, what went in on the other.
    const Lanes* innovation = way == Way::whiten ? y : e;
#pragma GCC unroll 16
    for (int m = 0; m < states; ++m)
      for (int l = 0; l < lanes; ++l) x[m][l] = mul_add(innovation[l], broadcast(gain[m]), x[m][l]);
    for (int l = 0; l < lanes; ++l) {
      if constexpr (way == Way::whiten) y[l] = mul_add(y[l], broadcast(1.0 / root_[k]), zero);
      store(at(to, static_cast<std::size_t>(r), l), y[l]);
    }
  }
  for (int m = 0; m < states; ++m)
    for (int l = 0; l < lanes; ++l) store(at(state, static_cast<std::size_t>(m), l), x[m][l]);
}

template <int states>
void NoiseFilter::run(Way way, Columns& columns, const double* from, double* to,
                      Eigen::Index count) const {
  for_lanes<lanes_of<states>()>(columns.width, [&]<int lanes>(std::size_t column) {
    double* state = columns.state.data();
    way == Way::whiten
        ? run_lanes<states, lanes, Way::whiten>(columns, column, from, to, count, state)
        : run_lanes<states, lanes, Way::colour>(columns, column, from, to, count, state);
  });
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
