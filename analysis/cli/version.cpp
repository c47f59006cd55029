#include <nlohmann/json.hpp>

#include "analysis/cli/commands.hpp"
#include "core/base/rng.hpp"

namespace drift::cli {
namespace {

/// The widest instruction set this program was compiled for.
const char* instruction_set() {
#if defined(__AVX512F__)
  return "x86-64 with AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  return "x86-64 with AVX2 and FMA";
#elif defined(__x86_64__)
  return "x86-64";
#else
  return "generic";
#endif
}

nlohmann::ordered_json facts() {
  nlohmann::ordered_json j;
  j["driftscope"] = DRIFT_VERSION;
  j["commit"] = DRIFT_COMMIT;
  j["build"] = DRIFT_BUILD_TYPE;
  j["compiler"] = fmt::format("{} {}", DRIFT_COMPILER, __VERSION__);
  j["instruction_set"] = instruction_set();
  j["random_numbers"] = Stream::scheme;
  j["libraries"] = nlohmann::ordered_json::parse(DRIFT_LIBRARIES);
  return j;
}

}  // namespace

ExitCode version(bool json) {
  const auto j = facts();
  if (json) {
    fmt::print("{}\n", j.dump(2));
    return ExitCode::ok;
  }
  const auto print = [](const nlohmann::ordered_json& table) {
    for (const auto& [key, value] : table.items())
      if (value.is_string()) fmt::print("{:<16} {}\n", key, value.get<std::string>());
  };
  print(j);
  print(j["libraries"]);
  return ExitCode::ok;
}

}  // namespace drift::cli
