#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/stats/allan_fit.hpp"
#include "core/stats/welch.hpp"

namespace drift::preparation {

/// Rows first..last, both included, in which a sensor rests.
struct RestingRows {
  std::size_t first = 0, last = 0;
};

/// The noise of one channel at rest, in internal units (rad/s, g) and seconds.
struct ChannelNoise {
  std::string channel;
  stats::AllanFit fit;
  stats::Spectrum spectrum;  ///< thinned, for a picture
  /// Deviation of one sample (square root of its Allan variance) in the quietest dwell and the
  /// noisiest, of those with thirty samples or more; 0 without two of them.
  double quietest = 0.0, noisiest = 0.0;
  std::size_t isolated = 0;  ///< samples on a platform that are none: not counted
};

/// Why a recording has no noise card.
enum class NoNoise { there_is_one, unequal_rows, too_short };

/// What rests of a recording say of the noise of its sensors.
struct NoiseCard {
  NoNoise missing = NoNoise::too_short;
  RecordingKind kind = RecordingKind::platform;
  double interval = 0.0;          ///< of the samples [s]
  std::size_t stretches = 0;      ///< evenly spaced rests that are pooled
  double longest = 0.0;           ///< of them [s]
  double total = 0.0;             ///< [s]
  std::size_t left_out = 0;       ///< rows at rest with another interval, or few between gaps
  std::size_t other_spacing = 0;  ///< of them those with another interval
  std::vector<ChannelNoise> channels;
};

/// Looks at each gyro and accelerometer channel in rests of a recording. Nothing is differenced
/// across a gap or from one rest to the next. Rows whose distances scatter by more than a fifth of
/// what is usual in their rest are refused (unequal_rows): an average over them is none over equal
/// times. Of rests with several intervals those of the one with most rows count.
///
/// On a platform what the accelerometers read changes with the attitude in every dwell: the
/// polynomial of fourth degree of each dwell is taken off, which leaves Earth rate and drift below
/// 1 ug in an hour, and only averaging times up to a twentieth of the longest dwell are looked at,
/// of which it takes less than 4 % of white noise, and only Q and N are fitted. Isolated samples
/// far from their dwell (a dropout, a cell in another unit) are no noise: one of them would be all
/// of it.
NoiseCard noise_card(const Recording& recording, RecordingKind kind,
                     const std::vector<RestingRows>& rests);

/// One sigma of a sample, as it scatters about the polynomial of fourth degree in time of its rest:
/// of three channels alike, median over them and the rests, isolated samples taken off. Rows may be
/// missing.
/// For rests that are too short for a card (eight rows do); 0 where there is none, or no scatter.
double scatter_at_rest(const Recording& recording, const std::vector<RestingRows>& rests,
                       const ChannelTriple& channels);

/// The rests of a platform recording: its positions, slews left out.
std::vector<RestingRows> resting_rows(const Recording& recording);

}  // namespace drift::preparation
