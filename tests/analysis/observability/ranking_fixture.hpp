#pragma once

#include <limits>
#include <string_view>

#include "analysis/observability/ranking.hpp"
#include "tests/support/model_builders.hpp"

namespace drift {

using namespace drift::test;

inline TestPlan plan_of(std::string_view preset, CommandLaw mode, double dwell = 3600.0,
                        double sample = 60.0) {
  PlanDefaults defaults;
  defaults.mode = mode;
  defaults.dwell = dwell;
  defaults.sample = sample;
  return preset_plan(preset, defaults).value();
}

inline observability::RankedModel model_of(Coupling coupling,
                                           std::initializer_list<std::string_view> keys = {}) {
  ModelSpec spec = base_spec(coupling);
  if (keys.size() > 0) spec.active = only(keys);
  return observability::ranked_model(spec, nullptr, harbin, Readout{});
}

/// Three parameters, two chains, two position bins in the first.
inline observability::LinearisedPlan small_plan() {
  observability::LinearisedPlan plan;
  plan.layout.params = {param("D_F_x"), param("D_I_x"), param("eta_x")};
  plan.layout.mean = VecX::Zero(3);
  plan.layout.sigma = VecX::Constant(3, 2.0);
  plan.chains = 2;
  plan.positions = 3;
  Stream stream(7, 0, Purpose::test);
  for (int b = 0; b < 3; ++b) {
    observability::TimeBin bin;
    bin.position = b;
    bin.chain = b == 2 ? 1 : 0;
    bin.rows = MatX(8, 6);
    for (double& v : bin.rows.reshaped()) v = stream.normal();
    plan.bins.push_back(bin);
  }
  return plan;
}

}  // namespace drift
