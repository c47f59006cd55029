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

void add_version(CLI::App& app, Action& chosen) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("version", "program, libraries, compiler, instruction set");
  command->add_flag("--json", *json, "as JSON");
  command->callback([&chosen, json] {
    chosen = [json] {
      const auto j = facts();
      if (*json) {
        fmt::print("{}\n", j.dump(2));
        return ExitCode::ok;
      }
      for (const auto& [key, value] : j.items()) {
        if (value.is_string()) fmt::print("{:<16} {}\n", key, value.get<std::string>());
      }
      for (const auto& [key, value] : j["libraries"].items())
        fmt::print("{:<16} {}\n", key, value.get<std::string>());
      return ExitCode::ok;
    };
  });
}

}  // namespace drift::cli
