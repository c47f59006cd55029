#include "analysis/cli/run_options.hpp"

#include <charconv>
#include <string_view>

#include "core/base/check.hpp"
#include "mc/engine/batch_system.hpp"

namespace drift::cli {
namespace {

/// Takes a number off the front of a text; nothing if there is none.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

void skip_blanks(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
}

double unit_seconds(std::string_view& text) {
  using namespace std::literals;
  for (const auto& [name, seconds] :
       {std::pair{"min"sv, 60.0}, {"h"sv, 3600.0}, {"m"sv, 60.0}, {"s"sv, 1.0}, {"d"sv, 86400.0}})
    if (text.starts_with(name)) {
      text.remove_prefix(name.size());
      return seconds;
    }
  return 0.0;
}

}  // namespace

mc::WorkerShare parse_share(const std::string& text) {
  if (text.starts_with("auto")) return mc::share_of_batch_system(text, mc::process_variable);
  std::string_view rest = text;
  const auto index = take_number<std::size_t>(rest);
  const bool slash = rest.starts_with('/');
  if (slash) rest.remove_prefix(1);
  const auto count = take_number<std::size_t>(rest);
  if (!index || !slash || !count || !rest.empty() || *count == 0 || *index >= *count)
    throw InputError(
        ExitCode::usage,
        fmt::format(
            "--worker {}: expected i/n with i from 0 to n - 1, or auto in an array of Slurm, SGE "
            "or PBS. For a Slurm array 0-15: --worker $SLURM_ARRAY_TASK_ID/16",
            text));
  return {*index, *count};
}

double parse_duration(const std::string& option, const std::string& text) {
  std::string_view rest = text;
  double total = 0.0;
  bool good = !rest.empty(), only = true;
  while (good && !rest.empty()) {
    const auto value = take_number<double>(rest);
    skip_blanks(rest);
    const double unit = rest.empty() && only ? 1.0 : unit_seconds(rest);
    good = value && *value >= 0.0 && *value < 1e9 && unit > 0.0;
    if (good) total += *value * unit;
    only = false;
    skip_blanks(rest);
  }
  if (!good || !(total > 0.0))
    throw InputError(
        ExitCode::usage,
        fmt::format("{} {}: expected a time such as 55m, 1h30m or 90s. Give one", option, text));
  return total;
}

double parse_fraction(const std::string& option, const std::string& text) {
  std::string_view rest = text;
  const auto value = take_number<double>(rest);
  const bool percent = rest == "%";
  const double fraction = value ? *value * (percent ? 0.01 : 1.0) : -1.0;
  if ((!rest.empty() && !percent) || !(fraction >= 0.0 && fraction <= 1.0))
    throw InputError(
        ExitCode::usage,
        fmt::format("{} {}: expected a share from 0% to 100%. Write 1% or 0.01", option, text));
  return fraction;
}

}  // namespace drift::cli
