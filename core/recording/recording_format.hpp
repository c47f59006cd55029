#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/named.hpp"
#include "core/base/units.hpp"

namespace drift {

/// What separates the cells of a line.
enum class Delimiter { automatic, comma, semicolon, tab, space };
inline constexpr Named<Delimiter> delimiters[] = {{"auto", Delimiter::automatic},
                                                  {",", Delimiter::comma},
                                                  {";", Delimiter::semicolon},
                                                  {"tab", Delimiter::tab},
                                                  {"space", Delimiter::space}};

/// What separates the whole part of a number from its decimals.
enum class DecimalMark { automatic, point, comma };
inline constexpr Named<DecimalMark> decimal_marks[] = {
    {"auto", DecimalMark::automatic}, {".", DecimalMark::point}, {",", DecimalMark::comma}};

/// What the sensors of a strapdown recording give.
enum class SampleKind {
  rates,       ///< rates at the end of the sample interval, instants
  mean_rates,  ///< means over the sample interval
  increments,  ///< angle and velocity gained over the sample interval: means, times its length
};
inline constexpr Named<SampleKind> sample_kinds[] = {{"rates", SampleKind::rates},
                                                     {"mean_rates", SampleKind::mean_rates},
                                                     {"increments", SampleKind::increments}};

/// What the accelerometers of a platform's row are.
enum class AccelerometerReading {
  mean,       ///< over the interval that ends at its time
  momentary,  ///< at its time
};
inline constexpr Named<AccelerometerReading> accelerometer_readings[] = {
    {"mean", AccelerometerReading::mean}, {"momentary", AccelerometerReading::momentary}};

/// How numbers stand for angles in degrees.
enum class AngleDigits {
  automatic,            ///< decimal, unless they look otherwise: then they are refused
  decimal,              ///< 45.5042
  minutes_and_seconds,  ///< 45.3015, which is 45 deg 30' 15"
};
inline constexpr Named<AngleDigits> angle_digits[] = {
    {"auto", AngleDigits::automatic},
    {"decimal", AngleDigits::decimal},
    {"dd.mmss", AngleDigits::minutes_and_seconds}};

/// One column of a user's file that stands for a channel: `acc_x = "-Ax [m/s^2]"`.
struct MappedColumn {
  std::string channel;              ///< the name the program knows, or a covariate's
  std::string own;                  ///< the header in the file
  std::optional<std::string> unit;  ///< empty: the one of the file
  double sign = 1.0;                ///< the values are multiplied by it
};

/// What is added to a channel after unit and sign.
struct ChannelOffset {
  std::string channel;
  double value = 0.0;  ///< [internal units]
  Dimension dim;
};

/// How a user's file is read as a recording: [recording] of the study file
/// (core/docs/recording.md).
struct RecordingFormat {
  std::vector<MappedColumn> columns;
  std::vector<std::pair<std::string, int>> positions;  ///< text -> number of the plan's position
  std::vector<ChannelOffset> offsets;
  std::vector<std::string> ignore;  ///< headers in the file
  /// Columns that terms of the study itself follow, by their own names: known without a channel.
  std::vector<std::string> of_terms = {};
  std::vector<std::string> missing;  ///< cells that stand for what was not measured: "-9999"
  std::vector<std::string> header;   ///< of a text file without a header row; empty: it has one
  Delimiter delimiter = Delimiter::automatic;
  DecimalMark decimal = DecimalMark::automatic;
  std::uint64_t skip_rows = 0;  ///< lines before the header; 0: recognised
  std::optional<double> rate;   ///< of rows without a column of time [1/s]
  std::string date;             ///< header of the dates of times of day; empty: none
  std::string counter;          ///< header of a counter that stands for time; empty: none
  std::optional<double> wrap;   ///< the counter begins again at 0 when it reaches this
  std::optional<double> tick;   ///< one count [s]
  SampleKind kind = SampleKind::rates;
  AngleDigits angles = AngleDigits::automatic;  ///< gimbals and the heading of the case, in deg
  AccelerometerReading accelerometers = AccelerometerReading::mean;
  /// By how much older than their row says the readings of a platform are [s].
  std::optional<double> accelerometers_late, gimbals_late;
};

}  // namespace drift
