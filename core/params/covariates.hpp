#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/base/linalg.hpp"
#include "core/base/units.hpp"

namespace drift {

/// A set of covariates: a bit for each of the table, then one for each further column that the
/// terms of a study name.
using CovariateSet = std::uint32_t;

/// All that is to be known of something that terms may follow beside the motion; it is declared in
/// `known_covariates` and nowhere else. Columns of recordings, keys of [environment], inputs of own
/// equations, what is checked and what is said all come from there.
struct CovariateSpec {
  enum class Kind {
    /// Varies while a test runs. Terms see how far it is from the mean of the recording, and its
    /// rate; [environment] says how it varies in simulations, and nothing of a recording.
    number,
    /// Belongs to the site: three components in local axes, the same all the time where
    /// [environment] declares them, which also goes for a recording without them.
    vector
  };
  std::string_view name;      ///< of its column, key and input; of a vector the stem of three
  std::string_view what;      ///< in messages, with "the": "magnetic field"
  std::string_view measures;  ///< its quantity, with units: "a temperature, [degC], [K] or [degF]"
  Unit unit;                  ///< in which it is shown, and the numbers below are given
  Kind kind = Kind::number;
  double least = 0.0, most = 0.0;  ///< that may be declared
  double swing = 0.0;              ///< largest amplitude, of a number, that may be declared
  double reason = 0.0;             ///< a sample of a recording that is larger is a mistake
  double usual = 0.0;              ///< how far it may well be from its mean; the size of a vector
  std::string_view example = {};   ///< what may be declared: "\"20 degC\""
  /// Number of its stream of random draws, its own for good: a new row changes no draw of an old
  /// seed.
  std::uint32_t stream = no_stream;
  std::size_t number = 0;  ///< place in the table; set there
  std::size_t first = 0;   ///< place of its first component in Covariates; set there

  static constexpr std::uint32_t no_stream = ~0u;

  constexpr CovariateSet set() const { return CovariateSet{1} << number; }
  constexpr bool is_vector() const { return kind == Kind::vector; }
  constexpr std::size_t components() const { return is_vector() ? 3 : 1; }
  /// "temperature"; "field_n", "field_w", "field_u".
  constexpr Name column(std::size_t component) const {
    Name key(name);
    if (is_vector()) key.append(std::array<std::string_view, 3>{"_n", "_w", "_u"}[component]);
    return key;
  }
  constexpr Unit unit_per_hour() const {
    Name symbol = unit.symbol;
    symbol.append("/h");
    return *parse_unit(symbol);
  }
};

namespace detail {
template <std::size_t N>
consteval std::array<CovariateSpec, N> numbered(std::array<CovariateSpec, N> table) {
  for (std::size_t k = 0, first = 0; k < N; first += table[k++].components()) {
    table[k].number = k;
    table[k].first = first;
  }
  return table;
}
}  // namespace detail

inline constexpr auto known_covariates = detail::numbered(std::array{
    CovariateSpec{.name = "temperature",
                  .what = "temperature",
                  .measures = "a temperature, [degC], [K] or [degF]",
                  .unit = "degC"_unit,
                  .least = -60.0,
                  .most = 120.0,
                  .swing = 100.0,
                  .reason = 250.0,
                  .usual = 10.0,
                  .example = "\"20 degC\"",
                  .stream = 0},
    CovariateSpec{.name = "field",
                  .what = "magnetic field",
                  .measures = "a magnetic field, for example [gauss] or [uT]",
                  .unit = "gauss"_unit,
                  .kind = CovariateSpec::Kind::vector,
                  .least = -1e3,
                  .most = 1e3,
                  .reason = 1e3,
                  .usual = 0.5,
                  .example = "\"0.26 gauss\", \"0 gauss\", \"-0.48 gauss\"",
                  .stream = 1},
});
static_assert(
    [] {
      for (const CovariateSpec& a : known_covariates)
        for (const CovariateSpec& b : known_covariates)
          if (a.stream == CovariateSpec::no_stream ||
              (a.number != b.number && a.stream == b.stream))
            return false;
      return true;
    }(),
    "every covariate has a stream of its own");

/// A covariate named in the code; a typo does not compile.
consteval const CovariateSpec& covariate(std::string_view name) {
  std::size_t k = 0;
  while (known_covariates[k].name != name) ++k;
  return known_covariates[k];
}

inline constexpr std::size_t covariate_components =
    known_covariates.back().first + known_covariates.back().components();
/// How many further columns of a recording the terms of a study may name.
inline constexpr std::size_t most_further_columns = 4;

/// The columns of all, in the order of their components.
inline constexpr auto covariate_columns = [] {
  std::array<Name, covariate_components> columns;
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k) columns[c.first + k] = c.column(k);
  return columns;
}();

inline constexpr CovariateSet every_known_covariate =
    (CovariateSet{1} << known_covariates.size()) - 1;
constexpr CovariateSet further_column(std::size_t k) {
  return CovariateSet{1} << (known_covariates.size() + k);
}
/// What varies while a test runs, so that no plan can say what it will be.
inline constexpr CovariateSet varying_covariates = [] {
  CovariateSet set = ~every_known_covariate;
  for (const CovariateSpec& c : known_covariates)
    if (!c.is_vector()) set |= c.set();
  return set;
}();

/// A number for every component of every covariate and for every further column: values at an
/// instant, means or rates [SI].
struct Covariates {
  std::array<double, covariate_components + most_further_columns> value{};

  double& operator[](const CovariateSpec& number) { return value[number.first]; }
  double operator[](const CovariateSpec& number) const { return value[number.first]; }
  Eigen::Map<Vec3> vector(const CovariateSpec& c) { return Eigen::Map<Vec3>(&value[c.first]); }
  Eigen::Map<const Vec3> vector(const CovariateSpec& c) const {
    return Eigen::Map<const Vec3>(&value[c.first]);
  }
  double& further(std::size_t k) { return value[covariate_components + k]; }
  double further(std::size_t k) const { return value[covariate_components + k]; }

  bool operator==(const Covariates&) const = default;
};

/// Of everything something, for scenes in which it is looked what a term depends on: so many times
/// a part of what is usual.
inline Covariates covariates_of_a_scene(double times = 1.0) {
  constexpr std::array parts{0.07, 0.02, -0.96};
  Covariates scene;
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; k < c.components(); ++k)
      scene.value[c.first + k] = times * parts[k] * c.usual * c.unit.to_si;
  for (std::size_t k = 0; k < most_further_columns; ++k)
    scene.further(k) = times * (0.3 + 0.1 * static_cast<double>(k));
  return scene;
}

}  // namespace drift
