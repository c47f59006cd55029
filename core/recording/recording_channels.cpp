#include "core/recording/recording_channels.hpp"

#include <algorithm>
#include <cmath>

#include "core/params/covariates.hpp"

namespace drift {
namespace {

constexpr ChannelQuantity time_q{unit::s, "a time, for example [s], [ms], [min] or [h]"};
constexpr ChannelQuantity force_q{
    unit::g, "a specific force, for example [g], [mg] or [ug]", true,
    100.0};  // instruments on a platform or a case saturate before; -999 m/s^2 is no reading
constexpr ChannelQuantity angle_q{
    unit::deg, "an angle, for example [deg], [rad], [arcmin] or [arcsec]", true, 1e5};
constexpr ChannelQuantity rate_q{
    unit::deg_per_h, "an angular rate, for example [deg/h], [deg/s] or [rad/s]", true, 200.0};
constexpr ChannelQuantity command_q{rate_q.unit, rate_q.words, true, 10.0};
constexpr ChannelQuantity number_q{unit::one, "a plain number, without unit", false};

/// The covariate that a column is, or a component of; null: none of the library's.
const CovariateSpec* covariate_in(std::string_view column) {
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k)
      if (c.column(k).view() == column) return &c;
  return nullptr;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::optional<ChannelQuantity> known_quantity(std::string_view name) {
  if (name == "time") return time_q;
  if (name == "position" || name == "phase") return number_q;
  if (name == "case_heading" || name.starts_with("loop_eta_") || name.starts_with("loop_xi_"))
    return angle_q;
  if (const CovariateSpec* c = covariate_in(name))
    return ChannelQuantity{c->unit, c->measures, true, c->reason * c->unit.to_si};
  constexpr std::array quantities{force_q, angle_q, command_q,
                                  rate_q};  // in the order of the triples
  for (std::size_t t = 0; t < channel_triples.size(); ++t)
    if (std::ranges::find(channel_triples[t].names, name) != channel_triples[t].names.end())
      return quantities[t];
  return std::nullopt;
}

bool valid_channel_name(std::string_view name) {
  if (name.empty() || name.size() > 63 || !is_letter(name.front())) return false;
  if (name == "units" || name == "facts" || name.ends_with("_unit")) return false;
  return std::ranges::all_of(name, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

bool is_covariate(std::string_view name, RecordingKind kind) {
  if (name == "time" || name.starts_with("acc_")) return !known_quantity(name);
  if (kind == RecordingKind::strapdown) return !(name.starts_with("gyro_") && known_quantity(name));
  if (name.starts_with("gyro_") || covariate_in(name) != nullptr) return true;
  return !known_quantity(name);
}

double in_unit(double value, const Unit& unit) {
  const double quotient = value / unit.to_si;
  if (quotient * unit.to_si == value || !std::isfinite(quotient)) return quotient;
  double best = quotient;
  for (const double side : {-HUGE_VAL, HUGE_VAL}) {
    const double other = std::nextafter(quotient, side);
    if (std::abs(other * unit.to_si - value) < std::abs(best * unit.to_si - value)) best = other;
  }
  return best;
}

std::optional<Vec3> measured(const Recording& recording, const ChannelTriple& channels,
                             std::size_t row) {
  Vec3 v;
  for (std::size_t a = 0; a < 3; ++a) {
    const Channel* c = recording.find(channels.names[a]);
    if (!c || !std::isfinite(c->values[row])) return std::nullopt;
    v[static_cast<Eigen::Index>(a)] = c->values[row];
  }
  return v;
}

bool is_angle(std::string_view name) {
  return name.starts_with("gimbal_") || name.starts_with("case_heading");
}

bool read_at_the_end(std::string_view name) {
  return name == "time" || name == "position" || name == "phase" || is_angle(name) ||
         name.starts_with("loop_");
}

}  // namespace drift
