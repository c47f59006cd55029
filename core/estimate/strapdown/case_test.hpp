#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/estimate/measured_test.hpp"
#include "core/estimate/strapdown/dwells.hpp"

namespace drift::strapdown {

/// A strapdown recording laid out as a platform test. The case is the platform: gyros and
/// accelerometers stand on it, and what the gyros read is what it is "told" to do, so that
///
///   (I + S) (C w_ip) + w_l = reading   <=>   w_ip = C^-1 ((I + S_T) w_cmd - w_l'),
///
/// eq. (6) of a platform that is torqued with its own readings, S_T and w_l' as in sensed_case().
/// Positions are dwells. In a dwell the case stands still on the Earth (Interval::rest): the gyros
/// are measured in place of gimbal angles, the accelerometers as on a platform. On the way to the
/// next dwell the readings carry the attitude along; nothing is measured there, unless the
/// accelerometers are said to be read there, too (InTurns).
struct CaseTest {
  Timeline timeline;
  Measurements measured;
  Readout readout;  ///< noise of a row, from the scatter of the rows within dwells
  /// That the scatter of the gyros stands for, and what an unknown North does [rad/sqrt(s)].
  double angle_random_walk = 0.0;
  double row = 0.0;               ///< length of the rows in dwells [s]
  std::vector<std::size_t> ways;  ///< dwell (from 0) at the end of each way without a gap
  std::size_t ways_with_gap = 0;
  std::vector<bool> still;  ///< of each dwell: a rest to the gyros
  /// Of each interval from when to when its gyros are read [s]: its own ends, but for the half of a
  /// dwell that has the gyros of the whole (Carry::one_way). What its accelerometers follow is then
  /// off by a quarter of the change in the dwell: they are read over the half.
  std::vector<std::pair<double, double>> read_over;
  std::vector<Mat3> R_lp;  ///< attitude at the start of each chain as it was assumed
};

/// The axes of the case are those of the accelerometers: x is the input axis of accelerometer x, y
/// lies in the plane of the input axes of x and y. So these three are zero.
inline constexpr std::array<std::size_t, 3> zero_by_definition{
    TermLibrary::index("dP_x"), TermLibrary::index("dO_x"), TermLibrary::index("dP_y")};

/// About how many rows the dwells are cut into, together.
inline constexpr double rows_at_rest = 400.0;
/// Attitude change and length of a row on the way: [rad], [s]. Within a row the reading is taken as
/// constant: what an error of relative size e makes of that is at most e turn^2 / 12, 1e-4 e.
inline constexpr double longest_turn_row = 0.04, longest_way_row = 1.0;
/// Over one way: an axis that stands still lets rows be longer. Of the error only what turns do to
/// each other counts: 2 e times the `bend`, by which the turn of a row differs from the sum of its
/// samples', 5e-4 e.
inline constexpr double longest_turn_row_one_way = 0.25, largest_bend = 2.5e-4;
/// Part of a way's fastest rate by which the rate may change within a row. What depends on the rate
/// otherwise than linearly (torquer_nonlinearity) is worked out at its mean: of a change d of the
/// rate its square is off by d^2 / 12, a thousandth, where ramps are all that tells it from a scale
/// factor. Not where accelerometers are read on the way: their rows end where the rate is steady;
/// nor over one way alone (longest_turn_row_one_way), where it would be three times the work: a
/// hand turns at all rates, and ramps are not all that tells.
inline constexpr double largest_change = 0.1;
/// A row in which accelerometers are read ends where the rate is steady, if it can (speeds_up): it
/// may be so many times longer until then.
inline constexpr double longer_while_speeding_up = 3.0;

/// The attitude of least turn from the local axes that has `f_c` up, turned about Up by an azimuth
/// from North to West [rad].
Mat3 levelled(const Vec3& f_c, double azimuth);

/// How far attitude is carried along.
enum class Carry {
  through,  ///< from way to way, until one has a gap: azimuth is worth carrying
  one_way,  ///< over one way; a dwell's first half ends a chain, its second half begins the next.
            ///< For gyros that do not see where North is: all that a way shows then is where up is
            ///< before and after it, and of the Earth's rate only what is about up is known. Half
            ///< of a still dwell (stillness.hpp) is one row at rest; in any other the readings
            ///< carry the attitude as on a way, while gravity is seen
};

/// What is made of the accelerometers while the case turns. On a table with fixed axes they read
/// gravity and what the turn itself does to them; moved by hand they read the hand.
enum class InTurns { left_out, read };

/// Lays a recording out. in_turns: `read` only with Carry::through. azimuth: heading of the case at
/// the start of each chain, from North to West about Up, against the attitude of least turn that
/// levels it [rad]; empty: zero.
CaseTest lay_out_case(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                      Carry carry, const std::vector<double>& azimuth = {},
                      InTurns in_turns = InTurns::left_out);

}  // namespace drift::strapdown
