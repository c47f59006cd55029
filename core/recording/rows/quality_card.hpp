#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/saturation.hpp"

namespace drift {

/// What one channel looks like, in the unit of its file.
struct ChannelQuality {
  std::string name, unit;
  bool covariate = false;
  std::size_t measured = 0, missing = 0;              ///< samples
  double min = 0.0, max = 0.0, mean = 0.0, sd = 0.0;  ///< of the measured samples; NaN if none
  std::size_t stuck = 0;             ///< samples in the longest run of one and the same value
  std::size_t stuck_line = 0;        ///< line or row at which that run starts
  double step = 0.0;                 ///< of a readout coarser than its noise (reading_step()); or 0
  std::vector<Saturation> standing;  ///< where a sensor reads what its noise does not allow
  std::size_t saturated() const;     ///< runs of those at the minimum or maximum
};

/// A place where samples are missing.
struct Gap {
  std::size_t line = 0;  ///< line or row after it
  double start = 0.0;    ///< time of the last sample before it [s]
  double length = 0.0;   ///< from there to the next sample [s]
  double within = 0.0;   ///< from the first to the last row of its position [s]; between two: 0
};

/// What a person looks at before trusting a recording.
struct QualityCard {
  std::string file, format;
  std::size_t rows = 0;
  std::vector<std::pair<std::string, std::string>> facts;
  std::size_t positions = 0;             ///< 0: the recording names none
  double start = 0.0, span = 0.0;        ///< first time, and from the first to the last [s]
  double interval = 0.0;                 ///< median sample interval [s]; NaN with one row
  double shortest = 0.0, longest = 0.0;  ///< interval that is usual in a stretch (RowSpacing) [s]
  double jitter = 0.0;       ///< rms deviation from what is usual in a stretch, gaps left out [s]
  std::vector<Gap> gaps;     ///< within a position: longer than 1.5 intervals usual in that stretch
  std::vector<Gap> between;  ///< likewise from one position to the next
  double lost = 0.0;         ///< samples that would fill the gaps within positions
  std::size_t empty = 0;     ///< cells without a number of sensors on a case that measure at all
  std::vector<ChannelQuality> channels;
  WeighedTexts remarks;  ///< sentences about what looks odd, or is assumed
};

/// Looks a recording over; changes and judges nothing.
QualityCard quality_card(const Recording& recording, RecordingKind kind);

/// The card as one screen of text.
std::string to_text(const QualityCard& card);

}  // namespace drift
