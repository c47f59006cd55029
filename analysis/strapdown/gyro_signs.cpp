#include "analysis/strapdown/gyro_signs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/strapdown/rate_about_up.hpp"
#include "core/stats/median.hpp"

namespace drift::strapdown {
namespace {

using Limits = preparation::GyroUnitLimits;
using preparation::MirrorLimits;

bool nothing_like(double error) {
  return error > Limits::nothing_like;
}

std::size_t wrong_of(const std::vector<double>& errors) {
  return static_cast<std::size_t>(std::ranges::count_if(errors, nothing_like));
}

Mixup all_reversed() {
  return {.sign = {-1.0, -1.0, -1.0}};
}

bool is_mirrored(const Mixup& m) {
  Mat3 M;
  for (int i = 0; i < 3; ++i) M.col(i) = m.of(Vec3::Unit(i));
  return M.determinant() < 0.0;
}

/// Whether the rests have the Earth's rate about Up as it is at the site, or as it is at the
/// mirrored latitude; none: they do not show it. What the gyros read along Up is that rate and
/// their drift, which is the same in all attitudes of the case.
std::optional<bool> earth_as_at(const Site& site, const std::vector<Dwell>& dwells,
                                const ColumnsAs& as) {
  if (dwells.size() < MirrorLimits::rests) return std::nullopt;
  const double expected = site.omega_ie_l().z();
  std::vector<Vec3> up, gyro;
  for (const Dwell& dwell : dwells) {
    up.push_back(as.accelerometers.of(dwell.acc).normalized());
    gyro.push_back(as.gyros.of(dwell.gyro));
  }
  const auto read = rate_about_up(up, gyro);
  if (!read || !(MirrorLimits::sigmas * read->sigma < std::abs(expected)) ||
      !(std::abs(std::abs(read->rate) - std::abs(expected)) <
        MirrorLimits::room * std::abs(expected)))
    return std::nullopt;
  return read->rate * expected > 0.0;
}

/// A change that explains what is seen.
struct Mending {
  ColumnsAs as;
  std::size_t left = 0;  ///< turns that are nothing like what they should be
  bool of_gyros() const { return as.gyros.changes() > 0; }
  const Mixup& mixup() const { return of_gyros() ? as.gyros : as.accelerometers; }
};

/// All that leave the fewest turns.
std::vector<Mending> mendings(const std::vector<double>& declared, const ErrorsAs& errors_as) {
  const std::size_t wrong = wrong_of(declared);
  std::vector<Mending> all;
  std::size_t fewest = wrong;
  const auto consider = [&](const ColumnsAs& as) {
    const std::vector<double> otherwise = errors_as(as);
    std::vector<double> of_wrong;
    for (std::size_t k = 0; k < otherwise.size(); ++k)
      if (nothing_like(declared[k])) of_wrong.push_back(otherwise[k]);
    const std::size_t left = wrong_of(otherwise);
    if (left >= wrong || !(stats::upper_median(std::move(of_wrong)) < Limits::alike) ||
        !(stats::upper_median(otherwise) < Limits::alike))
      return;
    all.push_back({as, left});
    fewest = std::min(fewest, left);
  };
  for (const Mixup& m : every_mixup()) {
    if (m.changes() == 0) continue;
    consider({.gyros = m});
    consider({.accelerometers = m});
  }
  std::erase_if(all, [&](const Mending& m) { return m.left > fewest; });
  return all;
}

/// What the Earth's rate at the site says of several changes.
enum class BySite { nothing, some_are_mirrored, all_are_mirrored };

/// Keeps those that give the Earth's rate the sign that it has at the site, where any do.
BySite keep_those_of_site(std::vector<Mending>& all, const Site& site,
                          const std::vector<Dwell>& dwells) {
  std::vector<Mending> right;
  std::size_t mirrored = 0;
  for (const Mending& m : all) {
    const std::optional<bool> as_there = earth_as_at(site, dwells, m.as);
    if (as_there && *as_there) right.push_back(m);
    if (as_there && !*as_there) ++mirrored;
  }
  if (right.empty())
    return mirrored > 0 && mirrored == all.size() ? BySite::all_are_mirrored : BySite::nothing;
  all = std::move(right);
  return mirrored > 0 ? BySite::some_are_mirrored : BySite::nothing;
}

/// What mends left-handed axes, where it leaves no more turns than the changes of one triad do and
/// has the Earth's rate as it is at the site; or "". Which axis is reversed is one: right-handed
/// triads differ by a rotation.
std::string left_handed(const std::vector<Mending>& mirrored, const Site& site,
                        const std::vector<Dwell>& dwells, const ErrorsAs& errors_as) {
  const Mixup z_reversed{.sign = {1.0, 1.0, -1.0}};
  const ColumnsAs as{z_reversed, z_reversed};
  if (mirrored.empty() || wrong_of(errors_as(as)) > mirrored.front().left ||
      !earth_as_at(site, dwells, as).value_or(false))
    return "";
  return "the axes are left-handed: with one of them reversed in gyros and accelerometers alike "
         "gravity turns as the gyros do and the Earth turns as at the latitude of the study. "
         "Correct the recording, or say so in the study: [recording] columns = { gyro_z = "
         "\"-gyro_z\", acc_z = \"-acc_z\" }, each with its unit as in the header";
}

/// The one with the fewest changes, of gyros or of accelerometers; none if several are.
std::optional<Mixup> plainest(const std::vector<Mending>& all, bool of_gyros) {
  return the_one_mixup([&](const Mixup& m) {
    return std::ranges::any_of(all, [&](const Mending& one) {
      return one.of_gyros() == of_gyros && one.mixup().from == m.from && one.mixup().sign == m.sign;
    });
  });
}

std::string text_of(const Mixup& mixup, bool of_gyros) {
  return mixup_text(mixup, of_gyros ? gyro_channels : accelerometer_channels,
                    "from rest to rest gravity turns as the gyros do");
}

}  // namespace

std::string mistaken_columns(const std::vector<Dwell>& dwells, const Site& site,
                             const std::vector<double>& declared, const ErrorsAs& errors_as) {
  const double as_declared = stats::upper_median(declared);
  if (wrong_of(declared) < Limits::fewest_turns) {
    const std::vector<double> reversed = errors_as({.gyros = all_reversed()});
    const bool mends =
        as_declared >= Limits::alike && wrong_of(reversed) == 0 &&
        stats::upper_median(reversed) < std::min(Limits::alike, Limits::far_better * as_declared);
    return mends ? text_of(all_reversed(), true) : "";
  }
  std::vector<Mending> all = mendings(declared, errors_as);
  const BySite by_site = keep_those_of_site(all, site, dwells);
  if (by_site == BySite::all_are_mirrored)
    if (const std::string said = left_handed(all, site, dwells, errors_as); !said.empty())
      return said;
  const bool by_earth = by_site == BySite::some_are_mirrored;
  const auto gyros = plainest(all, true), forces = plainest(all, false);
  if (!gyros && !forces) return "";
  const std::string said_of_site = fmt::format(
      ". The Earth's rate at rest tells it from its mirror image, which turns gravity "
      "alike: so it is that of {:.4g} deg, the latitude of the study",
      site.latitude / unit::deg.to_si);
  if (!gyros || !forces)
    return text_of(gyros ? *gyros : *forces, gyros.has_value()) + (by_earth ? said_of_site : "");
  const bool gyros_first = plainness(*gyros) <= plainness(*forces);
  return fmt::format(
      "{}. Or {}{}", text_of(gyros_first ? *gyros : *forces, gyros_first),
      text_of(gyros_first ? *forces : *gyros, !gyros_first),
      is_mirrored(*forces)
          ? ". One makes the mirror image of what the other makes, and both turn gravity alike: "
            "look which way the sensors are marked"
          : ". Both make the same unit, along the axes of the sensors that are left as they are");
}

}  // namespace drift::strapdown
