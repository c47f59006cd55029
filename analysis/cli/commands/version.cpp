#include <nlohmann/json.hpp>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "core/base/build_info.hpp"
#include "core/base/rng.hpp"

namespace drift::cli {
namespace {

nlohmann::ordered_json facts() {
  const BuildInfo& info = build_info();
  nlohmann::ordered_json j;
  j["driftscope"] = info.version;
  j["commit"] = info.commit;
  j["build"] = info.build_type;
  j["compiler"] = info.compiler;
  j["flags"] = info.flags;
  j["instruction_set"] = info.instruction_set;
  j["arithmetic"] = arithmetic_fingerprint();
  j["random_numbers"] = Stream::scheme;
  for (const auto& [name, number] : info.libraries) j["libraries"][name] = number;
  return j;
}

ExitCode version(bool json) {
  const auto j = facts();
  if (json) {
    show("{}\n", j.dump(2));
    return ExitCode::ok;
  }
  const auto list = [](const nlohmann::ordered_json& table) {
    for (const auto& [key, value] : table.items())
      if (value.is_string()) show("{:<16} {}\n", key, value.get<std::string>());
  };
  list(j);
  list(j["libraries"]);
  return ExitCode::ok;
}

}  // namespace

std::string version_line() {
  return fmt::format("driftscope {} ({})", build_info().version, build_info().commit);
}

Command version_command() {
  struct Arguments {
    bool json = false;
  };
  const auto add = [](CLI::App& app, Arguments& a) { app.add_flag("--json", a.json, "as JSON"); };
  return {"version", group::program, "program, libraries, compiler, instruction set",
          "driftscope version --json",
          with_arguments<Arguments>(add, [](const Arguments& a) { return version(a.json); })};
}

}  // namespace drift::cli
