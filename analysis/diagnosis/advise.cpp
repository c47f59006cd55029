#include "analysis/diagnosis/advise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/advice_text.hpp"
#include "analysis/diagnosis/alternatives.hpp"
#include "analysis/diagnosis/choose_additions.hpp"
#include "analysis/diagnosis/patched_study.hpp"
#include "analysis/diagnosis/separation.hpp"
#include "analysis/identification/recorded_test.hpp"
#include "analysis/inference/signatures.hpp"
#include "analysis/planning/position_pool.hpp"
#include "analysis/search/adequacy.hpp"
#include "core/sim/simulate.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

constexpr double told = 2.0;    // sigmas below which nobody would decide
constexpr double alike = 1e-3;  // 1 - cosine^2 of traces that are taken as the same
constexpr double same = 1e-6;   // and of those that are, whatever their size

inference::NoiseModel noise_of(const Diagnosis& d) {
  inference::NoiseModel m;
  m.angle_random_walk = d.nominal.noise.angle_random_walk;
  m.drift_random_walk = d.nominal.noise.drift_random_walk;
  for (const inference::NoiseFinding& f : d.noise) {
    if (!f.significant || !std::isfinite(f.factor)) continue;
    if (f.component == "gimbal_white") m.gimbal_factor = f.factor;
    if (f.component == "accelerometer_white") m.acc_factor = f.factor;
  }
  return m;
}

class Adviser {
 public:
  Adviser(const mc::Study& study, const std::vector<Recording>& recordings, const Diagnosis& d,
          const AdviseOptions& options)
      : study_(study),
        d_(d),
        options_(options),
        noise_(noise_of(d)),
        test_(identification::recorded_test(study, recordings)),
        fit_(fit_batch(d.nominal, test_.timeline, study.readout, test_.measured,
                       make_layout(d.nominal).theta)) {}

  inference::CandidateSet candidates() const {
    return inference::library_candidates(d_.nominal, inference::theta_of(d_.nominal, fit_),
                                         test_.timeline);
  }

  /// What looks most like a named cause, of each term and axis that it can be confused with.
  std::vector<Rival> rivals(const inference::CandidateSet& set) const {
    std::vector<Rival> all;
    Question named = named_question(d_, set, {});
    std::vector<inference::SignatureSpec> specs =
        number_signatures(named.alternatives, d_.nominal, inference::theta_of(d_.nominal, fit_));
    const std::vector<int> own = named.alternatives.front().columns;
    for (std::size_t cause = 0; cause < d_.causes.size(); ++cause)
      for (const search::Confusable& like : d_.causes[cause].confusable_with) {
        inference::CandidateSet few;  // of this term and axis, with their columns numbered anew
        std::vector<Rival> whose;
        std::vector<inference::SignatureSpec> columns = specs;
        for (std::size_t c = 0; c < set.candidates.size(); ++c) {
          if (set.candidates[c].term != like.term || set.candidates[c].axis != like.axis) continue;
          for (std::size_t v = 0; v < set.candidates[c].variants.size(); ++v) {
            inference::Variant variant = set.candidates[c].variants[v];
            for (int& column : variant.columns) {
              columns.push_back(set.signatures[static_cast<std::size_t>(column)]);
              column = static_cast<int>(columns.size()) - 1;
            }
            few.candidates.push_back({set.candidates[c].term, {}, {}, {}, {variant}});
            whose.push_back({cause, c, v});
          }
        }
        const inference::Projector p(problem(test_.timeline, test_.measured, fit_, columns),
                                     noise_);
        double most = -1.0;
        std::optional<Rival> nearest;
        for (std::size_t k = 0; k < whose.size(); ++k)
          if (const double c = std::abs(
                  search::cosine(p.candidates(), own, few.candidates[k].variants.front().columns));
              c > most) {
            most = c;
            nearest = whose[k];
          }
        if (nearest) all.push_back(*nearest);
      }
    return all;
  }

  /// Advice on a question. always: also where there is nothing to add.
  std::vector<Advice> answer(Question q, bool always) {
    if (q.empty()) return {};
    BatchResult at = fit_;
    if (std::ranges::any_of(q.alternatives, holds_lambda)) widen_misalignments(at);
    const Theta theta = inference::theta_of(d_.nominal, at);
    std::vector<inference::SignatureSpec> specs =
        number_signatures(q.alternatives, d_.nominal, theta);
    const auto as_recorded = [&] {
      return information_of(problem(test_.timeline, test_.measured, at, specs), noise_);
    };
    std::vector<Separation> before = separations(as_recorded(), q.alternatives, q.pairs);
    if (std::ranges::none_of(before,
                             [&](const Separation& s) { return s.sigma < options_.wanted; }))
      return always ? std::vector<Advice>{nothing_to_add(q, before)} : std::vector<Advice>{};
    const auto asked =
        static_cast<std::size_t>(std::ranges::count_if(q.pairs, [&](const Contest& p) {
          return p.truth < p.rival || std::ranges::find(q.pairs, Contest{p.rival, p.truth}) ==
                                          q.pairs.end();  // either way round once
        }));
    std::vector<Contest> near;
    for (std::size_t k = 0; k < before.size(); ++k)
      if (before[k].sigma < options_.wanted) near.push_back(q.pairs[k]);
    q.pairs = near;
    prune(q);
    specs = number_signatures(q.alternatives, d_.nominal, theta);
    const Information recorded = as_recorded();

    const Position& first = study_.plan.positions.front();
    const std::vector<planning::Addition> pool =
        planning::position_pool(first.dwell, first.sample, study_.site);
    const auto gains =
        mc::run_campaign(pool.size(), [&](std::size_t k) { return gain_of(pool[k], at, specs); });
    Information whole = recorded;
    for (const Information& g : gains) whole += g;
    const auto most = separations(whole, q.alternatives, q.pairs);
    Sorted sorted;
    std::vector<Contest> open;
    for (std::size_t k = 0; k < q.pairs.size(); ++k) {
      const bool nominal = q.alternatives[q.pairs[k].rival].causes.empty();
      const double by_shape = nominal ? most[k].sigma : std::sqrt(most[k].unlike) * most[k].alone;
      if (!nominal &&
          (most[k].unlike < same || (most[k].unlike < alike && by_shape < options_.wanted)))
        sorted.twins.push_back(q.pairs[k]);
      else if (by_shape < told)
        sorted.hidden.push_back(q.pairs[k]);
      else
        open.push_back(q.pairs[k]);
    }
    const std::vector<std::size_t> chosen = choose_additions(
        recorded, pool, gains, {q.alternatives, open}, {options_.most, options_.wanted});
    // In their order: what changes with time goes on from one to the next.
    planning::Addition in_turn;
    for (const std::size_t k : chosen)
      in_turn.insert(in_turn.end(), pool[k].begin(), pool[k].end());
    Information with = recorded;
    if (!in_turn.empty()) with += gain_of(in_turn, at, specs);
    const auto after = separations(with, q.alternatives, open);
    const auto now = separations(recorded, q.alternatives, open);
    for (std::size_t k = 0; k < open.size(); ++k)
      if (after[k].sigma >= told && after[k].sigma > now[k].sigma)
        sorted.helped.push_back({open[k], now[k].sigma, after[k].sigma});
      else
        sorted.hidden.push_back(open[k]);

    std::vector<Advice> all;
    if (!sorted.helped.empty()) {
      std::ranges::stable_sort(sorted.helped, {}, &Helped::after);
      Advice a;
      for (Position p : in_turn) {
        p.name = fmt::format("advised {}: {}", a.plan.size() + 1, p.name);
        a.plan.push_back(std::move(p));
      }
      std::vector<Contest> pairs;
      for (const Helped& h : sorted.helped) pairs.push_back(h.pair);
      a.separates = labels_of(q, pairs);
      const Helped& closest = sorted.helped.front();
      a.now_sigma = std::ranges::min(sorted.helped, {}, &Helped::now).now;
      a.expected_sigma = closest.after;
      a.verified_sigma = verify(a.plan, q, closest.pair, theta);
      a.text = helped_text(a, q, sorted.helped, asked, options_.wanted);
      all.push_back(std::move(a));
    }
    for (const bool twins : {true, false}) {
      const auto& pairs = twins ? sorted.twins : sorted.hidden;
      if (pairs.empty()) continue;
      Advice a;
      a.separates = labels_of(q, pairs);
      a.now_sigma = HUGE_VAL;
      for (const Separation& s : separations(recorded, q.alternatives, pairs))
        a.now_sigma = std::min(a.now_sigma, s.sigma);
      a.expected_sigma = a.now_sigma;
      a.verified_sigma = std::nan("");
      a.text = twins ? twins_text(q, pairs) : hidden_text(q, pairs, options_.most, pool.size());
      all.push_back(std::move(a));
    }
    return all;
  }

 private:
  struct Sorted {
    std::vector<Helped> helped;
    std::vector<Contest> twins, hidden;
  };

  inference::LinearProblem problem(const Timeline& timeline, const Measurements& measured,
                                   const BatchResult& fit,
                                   const std::vector<inference::SignatureSpec>& specs) const {
    return inference::linear_problem(d_.nominal, {timeline, study_.readout, measured}, fit, specs);
  }

  /// What lambda does goes with the misalignments: where the test has not seen them they stand near
  /// zero, yet may be as large as their sigma. Their root mean square size is what is to be
  /// expected.
  static void widen_misalignments(BatchResult& fit) {
    for (ParameterEstimate& p : fit.estimate.parameters) {
      const auto group = TermLibrary::specs[p.param].group.view();
      if (group == "eta" || group == "xi")
        p.value = std::copysign(std::hypot(p.value, p.sigma), p.value);
    }
  }

  /// A plan in the surroundings of the recording: its mean field.
  Timeline planned(const std::vector<Position>& positions) const {
    TestPlan plan = study_.plan;
    plan.preset.clear();
    plan.positions = positions;
    Timeline timeline = identification::planned_test(study_, plan);
    if (!test_.timeline.has_field || timeline.has_field) return timeline;
    Vec3 mean = Vec3::Zero();
    for (const Interval& i : test_.timeline.intervals)
      mean += i.around1.field_l / static_cast<double>(test_.timeline.intervals.size());
    for (Interval& i : timeline.intervals) i.around0.field_l = i.around1.field_l = mean;
    timeline.has_field = true;
    return timeline;
  }

  /// What an addition behind the recorded positions tells: what changes with time has gone on until
  /// then.
  Information gain_of(const planning::Addition& addition, const BatchResult& at,
                      const std::vector<inference::SignatureSpec>& specs) const {
    Timeline timeline = planned(addition);
    const Interval& last = test_.timeline.intervals.back();
    const double later = last.t1 - last.t_begin;
    for (Interval& i : timeline.intervals) {
      i.t0 += later;
      i.t1 += later;
      i.t_dwell += later;
    }
    for (Node& node : timeline.nodes) node.t += later;
    const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
    const Measurements anything{Mat3X::Zero(3, n),
                                Mat3X::Zero(3, n)};  // information does not ask for values
    BatchResult fit = at;
    fit.psi0_l.assign(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
    return information_of(problem(timeline, anything, fit, specs), noise_);
  }

  /// Simulates the extended test with the truth of a pair and fits truth and rival.
  double verify(const std::vector<Position>& added, const Question& q, const Contest& pair,
                const Theta& fitted) const {
    std::vector<Position> positions = study_.plan.positions;
    positions.insert(positions.end(), added.begin(), added.end());
    const Timeline timeline = planned(positions);
    const auto& causes = q.alternatives[pair.truth].causes;
    const FilterSpec right = patched_filter(d_.nominal, causes);
    const FilterSpec wrong = patched_filter(d_.nominal, q.alternatives[pair.rival].causes);
    Theta theta = fitted;
    for (const search::Cause& c : causes)
      for (const search::CauseParameter& p : c.parameters)
        theta[p.param] = p.value * TermLibrary::specs[p.param].unit.to_si;
    TruthSpec truth;
    static_cast<ModelSpec&>(truth) = right;
    TruthDraw draw = draw_truth(truth, timeline.chains, options_.seed, 0);
    draw.theta = theta;
    const Simulation sim = Simulator(truth, study_.readout).run(timeline, draw, options_.seed, 0);
    if (!sim.ode.ok()) return std::nan("");
    const auto cost = [&](const FilterSpec& f) {
      return fit_batch(f, timeline, study_.readout, sim.measured, make_layout(f).theta)
          .estimate.statistic;
    };
    const double gain = cost(wrong) - cost(right);
    return std::copysign(std::sqrt(std::abs(gain)), gain);
  }

  static Advice nothing_to_add(const Question& q, const std::vector<Separation>& found) {
    Advice a;
    const auto closest = std::ranges::min_element(found, {}, &Separation::sigma);
    a.separates = labels_of(q, q.pairs);
    a.now_sigma = a.expected_sigma = closest->sigma;
    a.verified_sigma = std::nan("");
    a.text =
        told_text(q, q.pairs[static_cast<std::size_t>(closest - found.begin())], closest->sigma);
    return a;
  }

  const mc::Study& study_;
  const Diagnosis& d_;
  AdviseOptions options_;
  inference::NoiseModel noise_;
  identification::RecordedTest test_;
  BatchResult fit_;
};

}  // namespace

std::vector<Advice> advise(const mc::Study& study, const std::vector<Recording>& recordings,
                           const Diagnosis& diagnosis, const AdviseOptions& options) {
  const Question open = open_question(diagnosis);
  if (!options.asked && open.empty()) return {};
  Adviser adviser(study, recordings, diagnosis, options);
  if (!options.asked) return adviser.answer(open, false);
  const inference::CandidateSet set = adviser.candidates();
  std::vector<Advice> all;
  if (!options.asked->empty()) {
    all = adviser.answer(asked_question(diagnosis, set, *options.asked), true);
  } else if (diagnosis.verdict == Verdict::consistent) {
    return adviser.answer(hidden_question(diagnosis, set), true);
  } else if (diagnosis.verdict == Verdict::named) {
    const Question q = named_question(diagnosis, set, adviser.rivals(set));
    return q.empty() ? std::vector<Advice>{text_alone(nothing_alike_text(q))}
                     : adviser.answer(q, true);
  } else if (diagnosis.verdict == Verdict::unexplained) {
    return {text_alone(unexplained_text(diagnosis, study.plan))};
  }
  for (Advice& a : adviser.answer(open, false)) all.push_back(std::move(a));
  std::ranges::stable_partition(all, [](const Advice& a) { return !a.plan.empty(); });
  return all;
}

}  // namespace drift::diagnosis
