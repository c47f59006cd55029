#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "core/estimate/layout.hpp"
#include "mc/study/study.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// What stands where in the row of a run: first the truth, then for each filter and start how the
/// estimate went, the estimates and their sigmas. All SI.
struct StudyColumns {
  /// Numbers about an estimate as a whole, in this order.
  enum Field : std::size_t {
    status,    ///< EstimateStatus
    nis,       ///< sum of the normalised innovations squared (batch: minimum of data + prior cost)
    nis_dof,   ///< measured scalars it sums over
    lag1,      ///< correlation of whitened innovations one sample apart (EKF alone)
    nees,      ///< normalised estimation error squared in the observed directions
    nees_dof,  ///< number of directions whose sigma is below healthy_sigma of the prior's
    nees_all,  ///< in all directions
    fields
  };

  struct Filter {
    std::string name;
    Coupling coupling = Coupling::eq5;
    Layout layout;
    std::size_t starts = 1;
    std::size_t first = 0;           ///< column of start 0
    std::vector<std::size_t> truth;  ///< column of the truth of each parameter
    std::size_t width() const { return fields + 2 * layout.size(); }
    std::size_t at(std::size_t start, Field field) const { return first + start * width() + field; }
    std::size_t estimate(std::size_t start, std::size_t k) const { return at(start, fields) + k; }
    std::size_t sigma(std::size_t start, std::size_t k) const {
      return estimate(start, k) + layout.size();
    }
  };

  std::vector<std::size_t> truth;  ///< library index of columns 0, 1, ...: all that is active in
                                   ///< the truth or estimated by a filter
  std::vector<Filter> filters;
  std::size_t count = 0;  ///< columns of a row

  /// InputError (config) as require_own_terms().
  explicit StudyColumns(const Study& study);

  /// Names: "truth/eta_x", "corrected/0/nis", "corrected/0/estimate/eta_x",
  /// "corrected/0/sigma/eta_x".
  std::vector<Column> named() const;
};

/// What a number about an estimate as a whole is called; it has no unit.
struct StoredField {
  StudyColumns::Field value;
  const char* name;       ///< in the store and what is made of it
  const char* in_netcdf;  ///< where the status of a run has the name of this one
  const char* about;      ///< in netCDF
};

inline constexpr StoredField stored_fields[] = {
    {StudyColumns::status, "status", "fit", "how the fit ended: 0 ok, 1 not converged, 2 diverged"},
    {StudyColumns::nis, "nis", "nis", "sum of the normalised innovations squared"},
    {StudyColumns::nis_dof, "nis_dof", "nis_dof", "measured scalars that nis sums over"},
    {StudyColumns::lag1, "lag1", "lag1", "correlation of whitened innovations one sample apart"},
    {StudyColumns::nees, "nees", "nees", "normalised error squared in the observed directions"},
    {StudyColumns::nees_dof, "nees_dof", "nees_dof", "number of observed directions"},
    {StudyColumns::nees_all, "nees_all", "nees_all", "the same of all directions"}};
static_assert(
    [] {
      if (std::size(stored_fields) != StudyColumns::fields) return false;
      for (std::size_t k = 0; k < StudyColumns::fields; ++k) {
        const StoredField& f = stored_fields[k];
        if (f.value != k || !f.name || !f.in_netcdf || !f.about) return false;
      }
      return true;
    }(),
    "a row for every field, in the order of the enum, that says all of it");

}  // namespace drift::mc
