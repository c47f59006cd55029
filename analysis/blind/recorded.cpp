#include "analysis/blind/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "analysis/blind/design.hpp"
#include "analysis/blind/library_effects.hpp"
#include "analysis/inference/signatures.hpp"
#include "analysis/search/fitted.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "core/base/check.hpp"
#include "core/estimate/layout.hpp"
#include "core/estimate/strapdown/reread.hpp"
#include "core/recording/recording_output.hpp"
#include "core/recording/sample_kind.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::blind {
namespace {

using strapdown::CaseStudy;

Recording rows_of(const Recording& all, std::size_t first, std::size_t last) {
  Recording out;
  out.source = all.source;
  if (holds_mean_rates(all)) say_mean_rates(out);
  for (const Channel& c : all.channels)
    out.channels.push_back({c.name,
                            c.unit,
                            {c.values.begin() + static_cast<std::ptrdiff_t>(first),
                             c.values.begin() + static_cast<std::ptrdiff_t>(last + 1)}});
  return out;
}

/// Neighbouring rests, and what lies between them.
Recording part_of(const Recording& recording, double static_min, Stream& stream) {
  const auto dwells =
      strapdown::find_dwells(strapdown::signals_of(recording), {.static_min = static_min}).dwells;
  if (dwells.empty()) return recording;  // what is wrong with it is said where it is laid out
  const auto up_to = [&](std::size_t n) {
    return static_cast<std::size_t>(stream.uniform() * static_cast<double>(n));
  };
  const std::size_t all = dwells.size();
  const auto least = static_cast<std::size_t>(std::ceil(least_part * static_cast<double>(all)));
  const std::size_t kept = least + up_to(all - least + 1), first = up_to(all - kept + 1);
  return rows_of(recording, dwells[first].first, dwells[first + kept - 1].last);
}

/// The readings of sensors, in the units that the program works in.
void put(const strapdown::Signals& signals, Recording& recording) {
  const auto write = [&](const char* name, const Unit& unit, auto&& value) {
    const auto channel = std::ranges::find(recording.channels, name, &Channel::name);
    DRIFT_DEMAND(channel != recording.channels.end());
    channel->unit = unit;
    for (std::size_t k = 0; k < signals.size(); ++k) channel->values[k] = value(k);
  };
  constexpr const char* gyros[] = {"gyro_x", "gyro_y", "gyro_z"};
  constexpr const char* accs[] = {"acc_x", "acc_y", "acc_z"};
  for (int a = 0; a < 3; ++a) {
    write(gyros[a], *parse_unit("rad/s"), [&](std::size_t k) { return signals.gyro[k][a]; });
    write(accs[a], unit::g, [&](std::size_t k) { return signals.acc[k][a]; });
  }
}

/// The nominal model on a recording.
struct Fit {
  CaseStudy of;
  FilterSpec filter;
  BatchResult fit;

  Fit(const mc::Study& nominal, const Recording& recording)
      : of(strapdown::case_study(nominal, recording)),
        filter(strapdown::case_filter(nominal.filters.front(), of)),
        fit(fit_batch(filter, of.measured(), strapdown::start_of(filter, of))) {}
  double chi2_per_dof() const { return fit.estimate.statistic_per_dof(); }
};

/// A part of a recording as it is.
class Bench {
 public:
  Bench(const mc::Study& nominal, const Recording& part)
      : is_(nominal, part),
        examined_(search::examine(is_.filter, is_.of.measured(), is_.fit)),
        left_out_(is_.filter) {
    for (const std::size_t p : strapdown::zero_by_definition) left_out_.active.set(p);
    world_.timeline = is_.of.test.timeline;
    world_.truth.coupling = is_.filter.coupling;
    world_.truth.active = is_.filter.active;
    world_.truth.mounting = is_.filter.mounting;
    world_.draw.theta = theta_of(is_.filter, is_.fit);
  }

  const Fit& is() const { return is_; }

  /// Numbers of the terms that can be missing here and act at once: no memory, no other equation.
  std::vector<std::size_t> terms() const {
    std::vector<std::size_t> all;
    for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t) {
      const TermInfo& term = TermLibrary::terms[t];
      const bool offered = std::ranges::any_of(examined_.set.candidates,
                                               [&](const auto& c) { return c.term == term.key; });
      if (offered && term.key != closure_term && !term.needs.memory && !term.needs.turning)
        all.push_back(t);
    }
    return all;
  }

  struct Sized {
    Source source;
    double strength = 0.0, size = 0.0, absorbed = 0.0;
  };
  /// An effect of a term at the strength that gives it a size. Empty if it would have to be
  /// implausibly strong, or does nothing here.
  std::optional<Sized> sized(std::size_t term, double size, double most, Stream& stream) const {
    const auto source = library_source(term, world_, left_out_, most, stream);
    if (!source) return std::nullopt;
    const World with = with_effect(*source, 1.0);
    std::vector<inference::SignatureSpec> specs;
    std::vector<double> share;
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (with.truth.active[i] && !world_.truth.active[i] && TermLibrary::specs[i].amplitude()) {
        specs.push_back({i, with.draw.theta, is_.filter.believed(i).sigma()});
        share.push_back(with.draw.theta[i] / specs.back().unit);
      }
    for (inference::SignatureSpec& spec : specs)
      for (const inference::SignatureSpec& other : specs) spec.theta[other.param] = 0.0;
    const inference::Projector projector(
        inference::linear_problem(is_.filter, is_.of.measured(), is_.fit, specs),
        examined_.noise.model);
    const VecX a = Eigen::Map<const VecX>(share.data(), static_cast<Eigen::Index>(share.size()));
    const double raw = (projector.extra() * a).squaredNorm(),
                 left = a.dot(projector.candidates().C * a);
    const double strength = size / std::sqrt(left);
    if (!std::isfinite(strength) || strength > source->most) return std::nullopt;
    return Sized{*source, strength, size, 1.0 - left / raw};
  }

  /// What the sensors would have read with an effect besides.
  Recording read_with(const Sized& sized, Recording part) const {
    const World with = with_effect(sized.source, sized.strength);
    put(strapdown::reread(strapdown::signals_of(part), is_.of.search.dwells, is_.of.test,
                          {world_.truth.model(), world_.draw.theta},
                          {with.truth.model(), with.draw.theta}),
        part);
    return part;
  }

  /// In the sensors' convention, as a diagnosis says it.
  HiddenEffect effect(const Sized& sized) const {
    HiddenEffect e = sized.source.effect;
    e.parameters = sized.source.parameters(sized.strength);
    const Vec3 scales = strapdown::scales_of(is_.fit.estimate);
    for (HiddenParameter& p : e.parameters) {
      const std::size_t param = *TermLibrary::find(p.key);
      const double unit = TermLibrary::specs[param].unit.to_si;
      p.value = strapdown::as_sensed(param, p.value * unit, scales) / unit;
    }
    e.size = sized.size;
    e.absorbed = sized.absorbed;
    return e;
  }

 private:
  World with_effect(const Source& source, double strength) const {
    World with = world_;
    source.put(with, strength);
    return with;
  }

  Fit is_;
  search::Fitted examined_;
  FilterSpec left_out_;  ///< the nominal filter, and what is zero by definition
  World world_;
};

/// Against the recording as it is: its noise is its own.
Certificate certify(const Fit& was, const Fit& now) {
  const stats::Band band = stats::chi_square_band(static_cast<double>(now.fit.estimate.measured));
  Certificate c;
  c.chi2_per_dof = now.chi2_per_dof();
  c.band_low = was.chi2_per_dof() * band.low;
  c.band_high = was.chi2_per_dof() * band.high;
  c.concealed = c.chi2_per_dof >= c.band_low && c.chi2_per_dof <= c.band_high;
  for (const ParameterEstimate& p : now.fit.estimate.parameters) {
    const ParameterEstimate* before = was.fit.estimate.find(p.param);
    if (before == nullptr || p.sigma <= 0.0) continue;
    c.take_bias(std::abs(p.value - before->value) / p.sigma,
                TermLibrary::specs[p.param].key.view());
  }
  return c;
}

}  // namespace

std::vector<TrialPlan> recorded_trials(const mc::Study& study, const Recording& recording) {
  const mc::BlindShares& shares = study.blind.shares;
  if (shares.null + shares.single != shares.sum() || study.blind.further.sum() > 0)
    throw InputError(
        ExitCode::config,
        fmt::format("{}: [blind.shares] asks for more than can be hidden in a recording (expected "
                    "null and single alone). Set wrong_noise, pair, outside and local to 0, and "
                    "leave [blind.further] out",
                    study.path));
  std::vector<TrialPlan> plans = design_trials(study.blind, study.monte_carlo.seed);
  for (TrialPlan& plan : plans) {
    plan.plan = std::filesystem::path(recording.source).stem().string();
    plan.mode = CommandLaw::free;
    plan.coupling = study.filters.front().coupling;
  }
  return plans;
}

MadeTrial hide_in(const Recording& recording, const mc::Study& study, const mc::Study& nominal,
                  const TrialPlan& plan) {
  const auto started = std::chrono::steady_clock::now();
  Stream stream(study.monte_carlo.seed, plan.number, Purpose::design, choice_stream);
  MadeTrial made;
  made.key.plan = plan;
  made.key.nominal = key_of(nominal.filters.front().coupling);
  Recording part = part_of(recording, nominal.static_min, stream);
  const Bench bench(nominal, part);
  put(strapdown::signals_of(part), part);
  made.recording = part;
  if (plan.stratum == Stratum::single) {
    std::optional<Bench::Sized> sized;
    for (const std::size_t t : in_turn(bench.terms(), study.monte_carlo.seed, plan.index))
      if ((sized = bench.sized(t, plan.size, study.blind.most_prior_sigmas, stream))) break;
    if (!sized)
      throw InputError(
          ExitCode::config,
          fmt::format("{}: nothing can be hidden in trial {} as asked: {:.3g} sigma in {} "
                      "(expected effects of at most {:.3g} prior sigmas). Ask for smaller sizes or "
                      "a larger blind.most_prior_sigmas",
                      study.path, plan.number, plan.size, recording.source,
                      study.blind.most_prior_sigmas));
    made.key.effects = {bench.effect(*sized)};
    made.key.total_size = sized->size;
    made.recording = bench.read_with(*sized, std::move(part));
  }
  made.key.certificate = certify(bench.is(), Fit(nominal, made.recording));
  made.recording.facts = {{std::string(made_here), fmt::format("blind trial {}", plan.number)}};
  made.key.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return made;
}

}  // namespace drift::blind
