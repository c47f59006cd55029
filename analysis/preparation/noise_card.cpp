#include "analysis/preparation/noise_card.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/stats/median.hpp"
#include "core/stats/trend.hpp"

namespace drift::preparation {
namespace {

using stats::AllanNoise;

constexpr int trend_degree = 4;
constexpr std::size_t trend_free = 20;     // a dwell is at least so many averaging times long
constexpr std::size_t least_samples = 16;  // of a stretch
constexpr std::size_t judged_samples = 30;
constexpr double most_jitter = 0.2;          // rms, in intervals
constexpr double isolated_by_chance = 1e-3;  // that any sample of a channel is taken for none
constexpr int lines_per_decade = 20;

/// Upper median of the distances of rows in a rest; 0 of a single row.
double usual_step(const std::vector<double>& time, const RestingRows& rest) {
  std::vector<double> steps;
  for (std::size_t k = rest.first + 1; k <= rest.last; ++k) steps.push_back(time[k] - time[k - 1]);
  return steps.empty() ? 0.0 : stats::upper_median(std::move(steps));
}

/// The parts of the rests in which every row follows the one before at the distance that is usual
/// in that rest.
struct Even {
  std::vector<RestingRows> parts;
  double jitter = 0.0;  ///< rms, in intervals
  std::size_t left_out = 0;
};

std::size_t rows_of(const RestingRows& part) {
  return part.last - part.first + 1;
}

Even evenly_spaced(const std::vector<double>& time, const std::vector<RestingRows>& rests) {
  Even even;
  double squares = 0.0, steps = 0.0;
  for (const RestingRows& r : rests) {
    const double interval = usual_step(time, r);
    for (std::size_t first = r.first, last = first; first <= r.last; first = ++last) {
      for (; last < r.last; ++last) {
        const double off = (time[last + 1] - time[last]) / interval - 1.0;
        if (!(std::abs(off) < 0.5)) break;
        squares += off * off;
        steps += 1.0;
      }
      if (last - first + 1 >= least_samples)
        even.parts.push_back({first, last});
      else
        even.left_out += last - first + 1;
    }
  }
  if (steps > 0.0) even.jitter = std::sqrt(squares / steps);
  return even;
}

/// Positions may have a sample each, and what is averaged over so many samples is then over other
/// times: of the spacings that the parts have, the one with most rows. Returns how many rows the
/// others have, which are taken out.
///
/// Two parts have one spacing where their own differ by no more than what their jitter may do
/// (three sigma), and by what moves no variance by more than the least that its own chance is: of
/// n samples a variance is known to sqrt(2/n), and one that falls with the square of the time is
/// off by twice the part that the time is.
std::size_t keep_one_spacing(const std::vector<double>& time, Even& even) {
  if (even.parts.empty()) return 0;
  const auto spacing = [&](const RestingRows& p) {
    return (time[p.last] - time[p.first]) / static_cast<double>(p.last - p.first);
  };
  std::size_t all = 0;
  for (const RestingRows& p : even.parts) all += rows_of(p);
  const auto differ = [&](const RestingRows& a, const RestingRows& b) {
    const auto steps = static_cast<double>(std::min(rows_of(a), rows_of(b)) - 1);
    return spacing(b) / spacing(a) - 1.0 >
           std::sqrt(0.5 / static_cast<double>(all)) + 3.0 * even.jitter / std::sqrt(steps);
  };
  std::vector<RestingRows> parts = even.parts;
  std::ranges::sort(parts, {}, spacing);
  std::size_t most = 0;
  std::pair<double, double> kept{};
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end) {
    std::size_t rows = 0;
    for (end = first; end == first || (end < parts.size() && !differ(parts[end - 1], parts[end]));
         ++end)
      rows += rows_of(parts[end]);
    if (rows <= most) continue;
    most = rows;
    kept = {spacing(parts[first]), spacing(parts[end - 1])};
  }
  std::erase_if(even.parts, [&](const RestingRows& p) {
    return spacing(p) < kept.first || spacing(p) > kept.second;
  });
  even.left_out += all - most;
  return all - most;
}

/// The measured samples of a channel in even parts: a sample that is missing ends a stretch.
std::vector<stats::Stretch> stretches_of(const Channel& channel,
                                         const std::vector<RestingRows>& parts) {
  std::vector<stats::Stretch> all;
  for (const RestingRows& part : parts) {
    stats::Stretch one;
    const auto finish = [&] {
      if (one.size() >= least_samples) all.push_back(one);
      one.clear();
    };
    for (std::size_t k = part.first; k <= part.last; ++k)
      if (std::isfinite(channel.values[k]))
        one.push_back(channel.values[k]);
      else
        finish();
    finish();
  }
  return all;
}

std::vector<std::size_t> lengths_of(const std::vector<stats::Stretch>& stretches) {
  std::vector<std::size_t> lengths;
  for (const stats::Stretch& s : stretches) lengths.push_back(s.size());
  return lengths;
}

/// A channel that is stuck, or too coarse to show any noise.
bool constant(const std::vector<stats::Stretch>& stretches) {
  const std::size_t one[] = {1};
  return !(stats::allan_variances(stretches, one)[0] > 0.0);
}

void compare_rests(const std::vector<stats::Stretch>& stretches, ChannelNoise& noise) {
  const std::size_t one[] = {1};
  std::size_t judged = 0;
  double low = 0.0, high = 0.0;
  for (const stats::Stretch& s : stretches) {
    if (s.size() < judged_samples) continue;
    const double deviation = std::sqrt(stats::allan_variances({&s, 1}, one)[0]);
    low = judged == 0 ? deviation : std::min(low, deviation);
    high = std::max(high, deviation);
    ++judged;
  }
  if (judged >= 2) {
    noise.quietest = low;
    noise.noisiest = high;
  }
}

/// The noises that so many averaging times an octave apart can tell.
std::vector<AllanNoise> looked_for(RecordingKind kind, const stats::AllanFitter& fitter) {
  if (!fitter.enough()) return {AllanNoise::white};
  if (kind == RecordingKind::platform) return {AllanNoise::quantisation, AllanNoise::white};
  return {stats::AllanFitter::all_noises.begin(), stats::AllanFitter::all_noises.end()};
}

}  // namespace

std::vector<RestingRows> resting_rows(const Recording& recording) {
  const Channel *position = recording.find("position"), *phase = recording.find("phase");
  const auto rests = [&](std::size_t k) { return phase == nullptr || phase->values[k] == 0.0; };
  const auto same = [&](std::size_t a, std::size_t b) {
    return position == nullptr || position->values[a] == position->values[b];
  };
  std::vector<RestingRows> all;
  for (std::size_t k = 0; k < recording.rows(); ++k) {
    if (!rests(k)) continue;
    const std::size_t first = k;
    while (k + 1 < recording.rows() && rests(k + 1) && same(first, k + 1)) ++k;
    all.push_back({first, k});
  }
  return all;
}

NoiseCard noise_card(const Recording& recording, RecordingKind kind,
                     const std::vector<RestingRows>& rests) {
  NoiseCard card;
  card.kind = kind;
  const Channel* time = recording.find("time");
  if (time == nullptr) return card;
  Even even = evenly_spaced(time->values, rests);
  if (even.jitter > most_jitter) {
    card.missing = NoNoise::unequal_rows;
    return card;
  }
  card.other_spacing = keep_one_spacing(time->values, even);
  card.left_out = even.left_out;
  card.stretches = even.parts.size();
  double span = 0.0, steps = 0.0;
  for (const RestingRows& p : even.parts) {
    span += time->values[p.last] - time->values[p.first];
    steps += static_cast<double>(p.last - p.first);
  }
  if (steps > 0.0) card.interval = span / steps;
  for (const RestingRows& p : even.parts)
    card.longest =
        std::max(card.longest, static_cast<double>(p.last - p.first + 1) * card.interval);
  card.total = (steps + static_cast<double>(even.parts.size())) * card.interval;

  std::optional<stats::AllanFitter> fitter;
  std::vector<std::size_t> prepared;  // the lengths that the fitter is for
  for (const ChannelTriple& triple : {gyro_channels, accelerometer_channels})
    for (const std::string_view name : triple.names) {
      const Channel* channel = recording.find(name);
      if (channel == nullptr) continue;
      stats::Detrended dwells{stretches_of(*channel, even.parts)};
      if (kind == RecordingKind::platform)
        dwells = stats::without_trend_and_isolated(std::move(dwells.stretches), trend_degree,
                                                   isolated_by_chance);
      const auto& stretches = dwells.stretches;
      const auto lengths = lengths_of(stretches);
      if (lengths.empty()) continue;
      const std::size_t longest = std::ranges::max(lengths);
      if (!fitter || lengths != prepared) {
        fitter.emplace(lengths, card.interval,
                       kind == RecordingKind::platform ? longest / trend_free : longest);
        prepared = lengths;
      }
      if (!fitter->possible() || constant(stretches)) continue;
      ChannelNoise noise{std::string(name), fitter->fit(stretches, looked_for(kind, *fitter)),
                         stats::thinned(stats::welch(stretches, card.interval), lines_per_decade)};
      noise.isolated = dwells.isolated;
      compare_rests(stretches, noise);
      card.channels.push_back(std::move(noise));
    }
  if (!card.channels.empty()) card.missing = NoNoise::there_is_one;
  return card;
}

double scatter_at_rest(const Recording& recording, const std::vector<RestingRows>& rests,
                       const ChannelTriple& channels) {
  constexpr std::size_t taken = trend_degree + 1, least_free = 3;
  std::vector<double> variances;
  const Channel* time = recording.find("time");
  if (time == nullptr) return 0.0;
  for (const std::string_view name : channels.names) {
    const Channel* channel = recording.find(name);
    if (channel == nullptr) continue;
    std::vector<stats::Stretch> all;
    std::vector<std::vector<double>> times;  // rows and samples may be missing
    for (const RestingRows& rest : rests) {
      stats::Stretch values;
      std::vector<double> at;
      for (std::size_t k = rest.first; k <= rest.last; ++k)
        if (std::isfinite(channel->values[k])) {
          values.push_back(channel->values[k]);
          at.push_back(time->values[k]);
        }
      if (values.size() < taken + least_free) continue;
      all.push_back(std::move(values));
      times.push_back(std::move(at));
    }
    for (const stats::Stretch& left :
         stats::without_trend_and_isolated(std::move(all), times, trend_degree, isolated_by_chance)
             .stretches) {
      const auto free = static_cast<double>(left.size() - taken);
      double squares = 0.0;
      for (const double x : left) squares += x * x;
      // The median of chi-square (Wilson and Hilferty).
      variances.push_back(squares / (free * std::pow(1.0 - 2.0 / (9.0 * free), 3)));
    }
  }
  return variances.empty() ? 0.0 : std::sqrt(stats::median(std::move(variances)));
}

}  // namespace drift::preparation
