#include "mc/study/monte_carlo.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/nearest.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/physics/term_library.hpp"

namespace drift::mc {
namespace {

using config::Option;
using config::Section;

constexpr Named<DesignKind> design_kinds[] = {{"random", DesignKind::random},
                                              {"latin_hypercube", DesignKind::latin_hypercube},
                                              {"sobol", DesignKind::sobol}};

template <class Field>
void visit_fields(MonteCarlo& o, Field&& field) {
  constexpr double unbounded = 0x1p64;
  field(Option{"runs", unit::one, 1.0, 1e9, "number of runs"}, o.runs);
  field(Option{"seed", unit::one, 0.0, unbounded, "of all random numbers"}, o.seed);
  field(Option{"allowed_failures", unit::one, 0.0, 1e9, "runs that may fail"}, o.allowed_failures);
  field(Option{"healthy_sigma", unit::one, 1e-6, 1.0, "sigma over prior sigma that claims to know"},
        o.healthy_sigma);
}

/// "silent_failure_rate", or "rmse." and a parameter.
void check_quantity(Section& section, const std::string& quantity) {
  constexpr std::string_view rmse = "rmse.";
  if (quantity == "silent_failure_rate") return;
  const auto& at = section.take("quantity")->at;
  if (!quantity.starts_with(rmse)) {
    section.report().error(
        at, fmt::format("'{}' = \"{}\" is no quantity a study can wait for (expected "
                        "\"silent_failure_rate\" or \"rmse.\" and a parameter). Write "
                        "quantity = \"silent_failure_rate\"",
                        section.full("quantity"), quantity));
    return;
  }
  const std::string key = quantity.substr(rmse.size());
  if (!TermLibrary::find(key))
    section.report().error(
        at,
        fmt::format("'{}' = \"{}\": '{}' is no parameter (expected \"rmse.\" and a "
                    "parameter). {}",
                    section.full("quantity"), quantity, key,
                    config::suggestion(key, parameter_keys(), "`driftscope terms` lists them")));
}

}  // namespace

MonteCarlo read_monte_carlo(Section section) {
  MonteCarlo out;
  visit_fields(out, [&](const Option& option, auto& value) { section.read(option, value); });
  section.read(Option{.key = "design", .doc = "how truth parameters are spread"}, out.design,
               design_kinds);
  section.read(Option{.key = "estimator", .doc = "what makes the estimates"}, out.estimator,
               estimators);
  Section stop = section.section("stop");
  if (stop.present()) {
    StopSpec spec;
    if (stop.require("quantity", "quantity = \"silent_failure_rate\"") &&
        stop.read(
            Option{
                .key = "quantity",
                .doc =
                    "whose interval decides; of an estimated parameter, with design = \"random\""},
            spec.quantity))
      check_quantity(stop, spec.quantity);
    stop.read(Option{"half_width", unit::one, 1e-6, 1.0, "of the interval"}, spec.half_width);
    stop.read(Option{"confidence", unit::one, 0.5, 0.9999, "of the interval"}, spec.confidence);
    stop.finish();
    out.stop = spec;
  }
  section.finish();
  return out;
}

}  // namespace drift::mc
