#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/units.hpp"
#include "core/config/node.hpp"
#include "core/config/option.hpp"
#include "core/config/report.hpp"
#include "core/params/prior.hpp"

namespace drift::config {

/// A number as written, with its unit.
struct Quantity {
  double value = 0.0;  ///< in `unit`
  Unit unit;
  double si() const { return value * unit.to_si; }
  double in(const Unit& other) const {  // exact where nothing is to be converted
    return unit.to_si == other.to_si ? value : value * (unit.to_si / other.to_si);
  }
};

/// "20 arcsec", "0.5": a number, and its unit if it has one; nothing of anything else.
std::optional<Quantity> quantity_in(std::string_view text);

/// Reads "60 min"; a TOML number where option.unit is dimensionless. Checks dimension, range,
/// finiteness and, of a temperature that is no difference, the zero of its scale; reports what is
/// wrong, calling the value `key`, and is then empty.
std::optional<Quantity> read_quantity(Report& report, const Node& node, std::string_view key,
                                      const Option& option);

/// Reads a plain value, `{ normal = [mean, sigma] }` or `{ uniform = [low, high] }`, into
/// option.unit.
std::optional<Prior> read_prior(Report& report, const Node& node, std::string_view key,
                                const Option& option);

/// Whether a table is such a distribution.
bool is_distribution(const Node& node);

/// "0.2 deg/h", "normal(0, 200) arcsec": a prior given in `unit`.
std::string prior_text(const Prior& prior, const Unit& unit);

/// "0.2 deg/h"; "0.2" if there is no dimension.
std::string quantity_text(double value, const Unit& unit);

/// "an angle, such as \"1 arcsec\"": what is expected where `unit` is.
std::string expected_quantity(const Unit& unit);

}  // namespace drift::config
