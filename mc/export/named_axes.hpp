#pragma once

#include <set>
#include <string>
#include <vector>

#include "mc/export/named_group.hpp"
#include "mc/export/swept_coordinates.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/study_columns.hpp"

namespace drift::mc {

/// The names along the dimensions of a study's results.
struct NamedAxes {
  std::vector<std::string> points;   ///< labels; of one point empty
  std::vector<std::string> filters;  ///< of all points, each once
  std::vector<std::size_t> params;   ///< library indices, in the order of the library
  std::size_t starts = 0;            ///< of the filter that has most
  std::vector<SweptCoordinate> swept;
  std::vector<std::string> coordinates;  ///< what each of these is called in a file
  std::vector<StudyColumns> columns;     ///< of each point

  /// others: names of what else the file holds, which no coordinate may have.
  explicit NamedAxes(const std::vector<StudyPoint>& study_points,
                     std::set<std::string> others = {});
  /// `dimensions`, behind `point` where the study has several.
  std::vector<std::string> with_point(std::vector<std::string> dimensions) const;
  /// Makes point, filter, start and parameter the dimensions of a group, with what belongs to them.
  void make_dimensions(NamedGroup& group) const;
  std::size_t filter(const std::string& name) const;       ///< its place
  std::size_t parameter(std::size_t library_index) const;  ///< its place
};

/// Makes the dimension `parameter` of a group, and `parameter_unit` along it.
void put_parameter_dimension(NamedGroup& group, const std::vector<std::size_t>& params);
/// What stands for the unit of an array whose numbers are those of several parameters.
inline const char* const unit_of_parameter = "as parameter_unit says";

}  // namespace drift::mc
