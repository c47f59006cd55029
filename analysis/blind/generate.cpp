#include "analysis/blind/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "analysis/blind/library_effects.hpp"
#include "analysis/blind/nearest.hpp"
#include "analysis/blind/noise_faults.hpp"
#include "analysis/blind/outside_effects.hpp"
#include "analysis/blind/sizing.hpp"
#include "core/base/check.hpp"
#include "core/base/shuffle.hpp"
#include "core/recording/recording_output.hpp"
#include "core/stats/chi_square_band.hpp"
#include "mc/study/own_terms_check.hpp"
#include "mc/study/own_terms_on_plan.hpp"

namespace drift::blind {
namespace {

using Sized = SizingBench::Sized;

World make_world(const mc::Study& study, const mc::Study& nominal, const TrialPlan& plan) {
  World w;
  w.truth = study.truth;
  w.truth.coupling = plan.coupling;
  w.timeline = lay_out(nominal.plan, nominal.site);
  set_environment(w.timeline, nominal.environment, study.monte_carlo.seed, plan.number);
  mc::resolve_own_terms(w.timeline, study);
  w.readout = nominal.readout;
  w.draw = draw_truth(w.truth, w.timeline.chains, study.monte_carlo.seed, plan.number);
  return w;
}

/// The first effects of the library, at most `count`, that can have this size here.
std::vector<Sized> library_effects(const SizingBench& bench, const FilterSpec& nominal,
                                   const std::vector<std::size_t>& terms, double size, double most,
                                   std::size_t count, Stream& stream) {
  std::vector<Sized> found;
  for (const std::size_t t : terms) {
    if (found.size() == count) break;
    const auto source = library_source(t, bench.world(), nominal, most, stream);
    if (!source) continue;
    if (auto sized = bench.fit_strength(*source, size)) found.push_back(std::move(*sized));
  }
  return found;
}

[[noreturn]] void nothing_to_hide(const mc::Study& study, const TrialPlan& plan) {
  throw InputError(
      ExitCode::config,
      fmt::format(
          "{}: nothing can be hidden in trial {} as asked: {} of {:.3g} sigma on preset {} "
          "(expected effects of at most {:.3g} prior sigmas). Ask for smaller sizes, longer "
          "dwells, or a larger blind.most_prior_sigmas",
          study.path, plan.number, key_of(plan.stratum), plan.size, plan.plan,
          study.blind.most_prior_sigmas));
}

/// Two effects whose signatures are not too much alike. Every third trial looks for two that cancel
/// each other as far as that allows.
std::vector<Sized> pair_effects(const mc::Study& study, const SizingBench& bench,
                                const FilterSpec& nominal, const TrialPlan& plan, Stream& stream) {
  auto terms =
      in_turn(hideable_terms(nominal, bench.world().timeline), study.monte_carlo.seed, plan.index);
  const double most = study.blind.most_prior_sigmas;
  auto first = library_effects(bench, nominal, terms, plan.size, most, 1, stream);
  if (first.empty()) nothing_to_hide(study, plan);
  std::erase_if(terms, [&](std::size_t t) {
    return TermLibrary::terms[t].key == first[0].source.effect.term;
  });
  shuffle(terms, stream);
  const std::size_t tries = plan.index % 3 == 0 ? 6 : 1;
  std::optional<Sized> best;
  double best_cosine = 0.0;
  std::size_t seen = 0;
  for (const std::size_t t : terms) {
    if (seen == tries) break;
    auto second = library_effects(bench, nominal, {t}, plan.size, most, 1, stream);
    if (second.empty()) continue;
    const double cosine = bench.absorption().cosine(first[0].signal, second[0].signal);
    if (std::abs(cosine) > study.blind.pair_cosine) continue;
    ++seen;
    if (best && cosine >= best_cosine) continue;
    best = std::move(second[0]);
    best_cosine = cosine;
  }
  if (!best) nothing_to_hide(study, plan);
  first.push_back(std::move(*best));
  return first;
}

/// The nominal equation is the wrong one: what that is, and what it leaves of a test.
HiddenEffect other_equation(const FilterSpec& nominal, const World& world, std::uint64_t seed,
                            std::uint64_t run) {
  const double truth = *facts(facts(world.truth.coupling).settles_to).lambda;
  World as_nominal = world;
  as_nominal.truth.coupling = nominal.coupling;
  const SizingBench bench(as_nominal, nominal, seed, run);
  Source jump;
  jump.put = [truth](World& w, double) {
    w.truth.coupling = Coupling::lambda;
    w.truth.active.set(closure_param);
    w.draw.theta[closure_param] = truth;
  };
  const Absorption::Size size = bench.absorption().size_of(bench.signal(jump, 1.0));
  HiddenEffect e;
  e.term = closure_term;
  e.words = "the nominal equation is the wrong one";
  e.parameters = {{std::string(TermLibrary::specs[closure_param].key.view()), truth, "1"}};
  e.size = size.left;
  e.absorbed = size.absorbed;
  return e;
}

/// Terms that follow a covariate.
std::vector<std::size_t> following(std::vector<std::size_t> terms) {
  std::erase_if(terms, [](std::size_t t) {
    return (TermLibrary::terms[t].needs.covariates & every_known_covariate) == 0;
  });
  return terms;
}

/// What is hidden, and put into `world`.
void hide(const mc::Study& study, const FilterSpec& nominal, const TrialPlan& plan, World& world,
          KeyEntry& key) {
  const std::uint64_t seed = study.monte_carlo.seed;
  Stream stream(seed, plan.number, Purpose::design, choice_stream);
  if (plan.stratum == Stratum::null) return;
  if (plan.stratum == Stratum::wrong_noise) {
    key.effects = {spoil_noise(plan.index, world, stream)};
    return;
  }
  if (plan.stratum == Stratum::other_equation) {
    key.effects = {other_equation(nominal, world, seed, plan.number)};
    key.total_size = key.effects.front().size;
    return;
  }
  const SizingBench bench(world, nominal, seed, plan.number);
  std::vector<Sized> sized;
  const auto one_of = [&](const std::vector<std::size_t>& terms) {
    return library_effects(bench, nominal, terms, plan.size, study.blind.most_prior_sigmas, 1,
                           stream);
  };
  switch (plan.stratum) {
    case Stratum::single:
    case Stratum::noisy_single:
      sized = one_of(in_turn(hideable_terms(nominal, world.timeline), seed, plan.index));
      break;
    case Stratum::noisy_covariate:
      sized = one_of(following(in_turn(hideable_terms(nominal, world.timeline), seed, plan.index)));
      break;
    case Stratum::pair:
      sized = pair_effects(study, bench, nominal, plan, stream);
      key.cosine = bench.absorption().cosine(sized[0].signal, sized[1].signal);
      break;
    default: {
      // A place or pattern that leaves nothing is drawn again.
      for (std::size_t k = 0; k < 2 * num_outside && sized.empty(); ++k) {
        const Source source = plan.stratum == Stratum::local
                                  ? local_source(world, stream)
                                  : outside_source(plan.index + k, world, stream);
        if (auto s = bench.fit_strength(source, plan.size)) sized.push_back(std::move(*s));
      }
    }
  }
  if (sized.empty()) nothing_to_hide(study, plan);
  VecX total = VecX::Zero(sized[0].signal.size());
  for (const Sized& s : sized) {
    s.source.put(world, s.strength);
    key.effects.push_back(s.effect());
    total += s.signal;
  }
  if (plan.stratum == Stratum::noisy_single)
    key.effects[0].words += ", beside " + spoil_noise(plan.index, world, stream).words;
  if (plan.stratum == Stratum::outside) {
    const Nearest nearest = nearest_in_library(bench, nominal, sized[0].signal);
    key.effects[0].nearest = nearest.term + (nearest.axis.empty() ? "" : "." + nearest.axis);
    key.effects[0].nearest_cosine = nearest.cosine;
  }
  key.total_size = bench.absorption().size_of(total).left;
}

Certificate certify(const FilterSpec& nominal, const World& world, const Measurements& measured) {
  const Layout layout = make_layout(nominal);
  const BatchResult fit =
      fit_batch(nominal, {world.timeline, world.readout, measured}, layout.theta);
  Certificate c;
  const auto dof = static_cast<double>(fit.estimate.measured);
  const stats::Band band = stats::chi_square_band(dof);
  c.chi2_per_dof = fit.estimate.statistic / dof;
  c.band_low = band.low;
  c.band_high = band.high;
  c.concealed = band.holds(c.chi2_per_dof);
  for (const ParameterEstimate& p : fit.estimate.parameters)
    c.take_bias(std::abs(p.value - world.draw.theta[p.param]) / p.sigma,
                TermLibrary::specs[p.param].key.view());
  return c;
}

}  // namespace

MadeTrial make_trial(const mc::Study& study, const mc::Study& nominal, const TrialPlan& plan) {
  mc::require_own_terms(study);
  mc::require_own_terms(nominal);
  const auto started = std::chrono::steady_clock::now();
  const FilterSpec& filter = nominal.filters.front();
  MadeTrial made;
  made.key.plan = plan;
  made.key.nominal = key_of(filter.coupling);
  World world = make_world(study, nominal, plan);
  hide(study, filter, plan, world, made.key);
  const Simulation sim = simulate_recorded(world, study.monte_carlo.seed, plan.number);
  Timeline recorded = world.timeline;
  if (plan.stratum == Stratum::noisy_covariate)
    recorded = with_noisy_covariates(std::move(recorded), study.monte_carlo.seed, plan.number);
  made.recording = make_recording(recorded, sim.measured, world.readout);
  made.recording.facts = {{std::string(made_here), fmt::format("blind trial {}", plan.number)}};
  made.key.certificate = certify(filter, world, sim.measured);
  made.key.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return made;
}

}  // namespace drift::blind
