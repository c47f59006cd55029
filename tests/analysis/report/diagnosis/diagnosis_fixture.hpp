#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "mc/study/study.hpp"
#include "tests/support/program.hpp"

namespace drift::test {

/// A study file whose nominal filter leaves torquer_scale and part of the rest out.
inline constexpr const char* nominal_study = R"(schema = 1
title  = "six & <positions>"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "10 min"
sample = "60 s"
mode   = "free"
[[filter]]
name     = "nominal"
coupling = "eq5"
terms    = ["fixed_drift", "gyro_misalignment", "accelerometer"]
starts   = 2
[filter.parameters]
eta   = { normal = ["0 arcsec", "300 arcsec"] }
K2    = "12 ug/g^2"
[[filter]]
name     = "other"
coupling = "eq6"
[monte_carlo]
seed = 3
)";

inline mc::Study read_text(const test::ScratchFolder& folder, const std::string& name,
                           const std::string& text) {
  return mc::read_study(folder.write(name, text));
}

/// Its nominal filter.
inline FilterSpec nominal() {
  const ScratchFolder folder;
  return read_text(folder, "s.toml", nominal_study).filters.front();
}

/// A diagnosis made by hand: D_S_y was left out, found beside a confusable D_I_z; every list
/// filled, a text that must be escaped, and a number that is none.
inline diagnosis::Diagnosis diagnosis(const FilterSpec& nominal) {
  using namespace diagnosis;
  using namespace inference;
  using namespace search;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::named;
  d.p_value = 1e-30;
  d.where.channel_names = {"acc_x",        "acc_y",         "acc_z",
                           "gimbal_outer", "gimbal_middle", "gimbal_inner"};
  d.where.channels = {{.name = "acc_y", .share = 0.7, .sigma = 0.1},
                      {.name = "gimbal_outer", .share = 0.3}};
  d.where.positions = {{.position = 3, .share = 0.6}, {.position = 1, .share = 0.4}};
  for (int p = 1; p <= 6; ++p)
    for (int c = 0; c < 6; ++c) d.where.heat.push_back({p, c, c == 1 ? 0.1 * p : -0.01, 1.0});
  d.where.windows = {{"platform rate y", 3, 1200.0, 1800.0, 60.0, 1e-9, 1e-7, 1e-8}};
  d.where.equation = "platform rate y";
  search::Cause cause;
  cause.term = "g_drift";
  cause.axis = "y";
  const auto param = TermLibrary::find("D_S_y").value();
  cause.parameters = {{"D_S_y", param, 0.25, 0.01, "deg/h/g", false}};
  cause.T = 144.0;
  cause.p_value = 1e-20;
  cause.probability = 0.97;
  cause.size_sigma = none;
  cause.confusable_with = {{"g_drift", "z", 0.85}};
  d.causes = {cause};
  search::CandidateScore s;
  s.term = "g_drift";
  s.axis = "y";
  s.label = "g_drift D_S_y <&>";
  s.score = 144.0;
  s.p_value = 1e-20;
  s.absorbed = 0.93;
  s.amplitude = 0.25;
  s.sigma = 0.01;
  s.unit = "deg/h/g";
  s.adequate = true;
  d.candidates = {s, s};
  d.candidates[1].label = "other";
  d.candidates[1].p_value = 0.2;
  d.candidates[1].score = none;
  d.noise = {{.component = "gimbal_white",
              .factor = 1.3,
              .factor_sigma = 0.02,
              .value = 6.5,
              .unit = "arcsec",
              .significant = true}};
  d.fit.chi2_per_dof_before = 1.02;
  d.fit.held_out.chi2_per_dof_before = 9.1;
  d.fit.held_out.chi2_per_dof_after = 1.03;
  d.fit.held_out.log_score_gain = 812.0;
  d.fit.held_out.improves = true;
  for (int p = 1; p <= 6; ++p) {
    diagnosis::Fold fold;
    fold.number = p;
    fold.positions = {p};
    fold.chi2_before = 90.0 * p;
    fold.chi2_after = 10.0;
    fold.dof = 10;
    d.fit.held_out.folds.push_back(fold);
  }
  d.fit.start_spread_before = 10.6;
  d.fit.start_spread_after = none;
  d.fit.shifted = {
      {"eta_x", "arcsec", TermLibrary::find("eta_x").value(), 268.0, 15.0, 101.0, 5.0, -11.1}};
  d.fit.residual_before.setRandom(6, 60);
  d.fit.residual_after.setRandom(6, 60);
  diagnosis::RecoveredSignal signal;
  signal.equation = "platform rate y";
  signal.unit = "deg/h";
  signal.shape = {diagnosis::Shape::Kind::onset, 1200.0};
  signal.correlation = 0.9;
  for (int i = 0; i < 60; ++i) {
    signal.t.push_back(60.0 * (i + 1));
    signal.position.push_back(1 + i / 10);
    signal.value.push_back(i == 7 ? none : std::sin(0.1 * i));
    signal.sigma.push_back(0.1);
    signal.explained.push_back(std::sin(0.1 * i));
  }
  d.signals = {signal};
  d.cosines.labels = {"g_drift.y", "g_drift.z"};
  d.cosines.cosine = (MatX(2, 2) << 1.0, 0.85, 0.85, 1.0).finished();
  diagnosis::Advice advice;
  for (const char* axis : {"y", "z"}) {
    search::Cause one;
    one.term = "g_drift";
    one.axis = axis;
    advice.alternatives.push_back({diagnosis::Alternative::Kind::causes, {one}, Coupling::eq5, {}});
  }
  advice.pairs = {{{0, 1}, 1.5, 6.2}};
  Position position;
  position.name = "x up";
  position.axes = "x=U y=N z=W";
  position.dwell = 600.0;
  position.case_heading = 0.5 * unit::deg.to_si;
  std::string why;
  position.R_lp = parse_axes(position.axes, why).value();
  advice.plan = {position};
  advice.usual_dwell = 600.0;
  advice.wanted = 5.0;
  advice.now_sigma = 1.5;
  advice.expected_sigma = 6.2;
  d.advice = {advice};
  d.remarks = {diagnosis::remark::Input{"a <remark> & more"}};
  d.nominal = nominal;
  d.patched = diagnosis::patched_filter(nominal, d.causes);
  d.has_patch = true;
  d.seconds = {{"fit", 1.5}};
  return d;
}

}  // namespace drift::test
