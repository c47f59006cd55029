#include "mc/store/same_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "mc/store/origin.hpp"
#include "mc/store/text_difference.hpp"

namespace drift::mc {
namespace {

std::vector<std::string> other_points(const std::vector<PointInfo>& is,
                                      const std::vector<PointInfo>& wanted) {
  std::vector<std::string> out;
  const auto same = [](const Column& a, const Column& b) {
    return a.name == b.name && a.unit.symbol.view() == b.unit.symbol.view();
  };
  if (is.size() != wanted.size())
    out.push_back(fmt::format("number of study points: {} in the folder, {} asked for", is.size(),
                              wanted.size()));
  for (std::size_t p = 0; p < std::min(is.size(), wanted.size()); ++p)
    if (is[p].label != wanted[p].label ||
        !std::ranges::equal(is[p].columns, wanted[p].columns, same))
      out.push_back(fmt::format("study point {} has other columns or another label", p));
  return out;
}

template <class T>
void note(std::vector<std::string>& out, const char* what, const T& is, const T& wanted) {
  if (is != wanted)
    out.push_back(fmt::format("{}: {} in the folder, {} asked for", what, is, wanted));
}

/// By what results of the same study are not the same bits.
std::vector<std::string> other_arithmetic(const Manifest& is, const Manifest& wanted) {
  std::vector<std::string> out;
  note(out, "program", is.program, wanted.program);
  note(out, "instruction set", is.instruction_set, wanted.instruction_set);
  // What another compiler makes of the same source differs in the last bits.
  note(out, "compiler", compiler_of(is), compiler_of(wanted));
  note(out, "arithmetic of the C library on this processor", is.arithmetic, wanted.arithmetic);
  return out;
}

std::vector<std::string> differences(const Manifest& is, const Manifest& wanted) {
  std::vector<std::string> out = difference(is.identity.text, wanted.identity.text);
  note(out, "seed", is.identity.seed, wanted.identity.seed);
  note(out, "block size", is.identity.block_size, wanted.identity.block_size);
  for (std::string& line : other_arithmetic(is, wanted)) out.push_back(std::move(line));
  for (std::string& line : other_points(is.points, wanted.points)) out.push_back(std::move(line));
  return out;
}

}  // namespace

std::vector<PointInfo> infos_of(std::span<const TaskPoint> points) {
  std::vector<PointInfo> list;
  for (const TaskPoint& point : points) list.push_back({point.label, point.task->columns()});
  return list;
}

void require_same_study(const std::string& folder, const Manifest& wanted) {
  const std::vector<std::string> differ = differences(read_manifest(folder), wanted);
  if (differ.empty()) return;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: the folder holds another study (expected the one that is asked for). Choose "
                  "another folder with -o; what differs, - in the folder, + asked for:\n  {}",
                  folder, fmt::join(differ, "\n  ")));
}

void require_same_arithmetic(const std::string& folder, const Manifest& manifest) {
  const auto differ = other_arithmetic(manifest, make_manifest({}, "", {}));
  if (differ.empty()) return;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: its results were computed by another program or on another "
                  "arithmetic, and do not come out again bit by bit here (expected "
                  "those of this program on this processor). Do it where they were computed; "
                  "`driftscope verify --sample 0%` computes nothing\n  {}",
                  folder, fmt::join(differ, "\n  ")));
}

void require_columns(const std::string& folder, const Manifest& manifest,
                     std::span<const TaskPoint> points) {
  const auto differ = other_points(manifest.points, infos_of(points));
  if (differ.empty()) return;
  throw InputError(
      ExitCode::store,
      fmt::format(
          "{}/manifest.json: damaged, or made by another program: {} (expected the columns "
          "of the study). Move it away and run the same command again: it is made anew, and "
          "the results in the worker files are kept",
          folder, fmt::join(differ, "; ")));
}

}  // namespace drift::mc
