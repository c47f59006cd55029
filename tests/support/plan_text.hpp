#pragma once

#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/plan/plan_config.hpp"

namespace drift::test {

/// What came of reading a [plan].
struct PlanRead {
  std::vector<std::string> mistakes;
  PlanConfig config;
};

/// `text`: below the line [plan] of t.toml.
inline PlanRead read_plan_text(const std::string& text) {
  const config::Node root = config::parse_document("[plan]\n" + text, "t.toml");
  config::Report report("t.toml");
  config::Section top(report, &root, {}, "");
  PlanRead result;
  result.config = read_plan(top.section("plan"));
  top.finish();
  try {
    report.throw_if_wrong();
  } catch (const InputError& error) {
    result.mistakes = error.messages();
  }
  return result;
}

}  // namespace drift::test
