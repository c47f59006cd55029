#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/store/manifest.hpp"

namespace drift::mc {

/// Label and columns of study points.
std::vector<PointInfo> infos_of(std::span<const TaskPoint> points);

/// InputError (store) if the manifest of a folder is of another study, program, compiler or
/// arithmetic than `wanted`, with what differs.
void require_same_study(const std::string& folder, const Manifest& wanted);

/// InputError (store) if this program on this processor does not compute what a folder holds bit
/// for bit: another version, compiler, instruction set or arithmetic. manifest: that of the folder.
void require_same_arithmetic(const std::string& folder, const Manifest& manifest);

/// InputError (store) if the labels and columns of the manifest are not those of the study's
/// points: what readers show would be named or scaled wrongly.
void require_columns(const std::string& folder, const Manifest& manifest,
                     std::span<const TaskPoint> points);

}  // namespace drift::mc
