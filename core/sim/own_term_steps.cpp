#include "core/sim/own_term_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/sim/measurements.hpp"
#include "core/sim/own_course.hpp"

namespace drift {
namespace {

/// An own term within a row: between its nodes all that it reads is linear.
class RowCourse {
 public:
  RowCourse(const OwnCourse& course, const Timeline& timeline, const Interval& row)
      : course_(course) {
    for (std::size_t k = 0; k < row.node_count(); ++k)
      nodes_.push_back(course.reading(timeline, row, timeline.nodes[row.first_node + k]));
    for (const std::size_t i : course.inputs())
      if (i < own_inputs.size() && own_inputs[i].needs.gimbals)
        for (std::size_t k = 1; k < nodes_.size(); ++k)  // on from the other end of the circle
          nodes_[k][i] = nodes_[k - 1][i] + angle_difference(nodes_[k][i], nodes_[k - 1][i]);
  }

  double at(double share) const {
    const double k = share * static_cast<double>(nodes_.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(k), nodes_.size() - 2);
    const double on = k - static_cast<double>(before);
    return course_.evaluated<double>([&](std::size_t i) {
      return nodes_[before][i] + on * (nodes_[before + 1][i] - nodes_[before][i]);
    });
  }
  double largest() const {
    double most = 0.0;
    for (int k = 0; k < samples; ++k) most = std::max(most, std::abs(at((k + 0.5) / samples)));
    return most;
  }

  /// The mean over the row by the rule of the readings, or of the integrals of what drives the
  /// platform: Simpson's.
  enum class Rule { readings, integrals };
  double mean(Rule rule, int substeps) const {
    const std::size_t last = 2 * static_cast<std::size_t>(substeps);
    double sum = 0.0;
    for (std::size_t k = 0; k <= last; ++k) {
      sum += (rule == Rule::readings ? Timeline::mean_weight(substeps, k) : weight(k, last)) *
             at(static_cast<double>(k) / static_cast<double>(last));
    }
    return sum;
  }
  /// In two parts of which none is a fraction of the other: what repeats with the steps of a row
  /// does not repeat with these.
  double true_mean(int substeps) const {
    constexpr double part = 0.38196601125010515;  // golden section
    return part * simpson(0.0, part, substeps) + (1.0 - part) * simpson(part, 1.0, substeps);
  }
  double mean_square() const {
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) sum += std::pow(at((k + 0.5) / samples), 2) / samples;
    return sum;
  }
  /// Against finer steps than those in question, at least six times as many.
  double error(int substeps) const {
    const double truth = true_mean(std::max(11, 3 * substeps));
    return std::max(std::abs(mean(Rule::readings, substeps) - truth),
                    std::abs(mean(Rule::integrals, substeps) - truth));
  }

 private:
  /// Of Simpson's rule over `last` steps.
  static double weight(std::size_t k, std::size_t last) {
    return (k == 0 || k == last ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (3.0 * static_cast<double>(last));
  }
  /// The mean over a part of the row.
  double simpson(double from, double to, int substeps) const {
    const std::size_t last = 2 * static_cast<std::size_t>(substeps);
    double sum = 0.0;
    for (std::size_t k = 0; k <= last; ++k)
      sum += weight(k, last) *
             at(from + (to - from) * static_cast<double>(k) / static_cast<double>(last));
    return sum;
  }

  static constexpr int samples = 23;
  const OwnCourse& course_;
  std::vector<OwnCourse::Reading> nodes_;
};

/// Whether steps matter: an angle is read at the end of a row.
bool has_means(std::size_t own) {
  return own_terms().terms[own].target.slot != OwnSlot::gimbal;
}

/// Steps of each interval that own terms ask for, and where they do.
struct AskedSteps {
  std::vector<int> substeps;
  std::vector<bool> fine;
  bool finer = false;  ///< than those of the timeline, somewhere
};

AskedSteps asked_steps(const Timeline& timeline, const ModelSpec& model) {
  constexpr double tolerance = 1e-3;
  constexpr double nothing =
      1e-9;  // of an amplitude: what rounding leaves of a product that is zero
  constexpr int most_substeps = 32;
  AskedSteps asked;
  for (const Interval& i : timeline.intervals) asked.substeps.push_back(i.substeps);
  asked.fine.resize(timeline.intervals.size());
  for_each_own(timeline, model, [&](std::size_t own, const OwnCourse& course) {
    if (!has_means(own)) return;
    double largest = nothing / tolerance * course.amplitude();
    for (const Interval& i : timeline.intervals)
      largest = std::max(largest, RowCourse(course, timeline, i).largest());
    for (std::size_t n = 0; n < timeline.intervals.size(); ++n) {
      const RowCourse row(course, timeline, timeline.intervals[n]);
      while (row.error(asked.substeps[n]) > tolerance * largest) {
        asked.fine[n] = true;
        if (2 * asked.substeps[n] > most_substeps) break;
        asked.substeps[n] *= 2;
        asked.finer = true;
      }
    }
  });
  return asked;
}

bool drives_platform(const ModelSpec& model, std::size_t own) {
  const OwnSlot slot = own_terms().terms[own].target.slot;
  return model.model().terms[TermLibrary::num_known + own] && slot != OwnSlot::gimbal &&
         slot != OwnSlot::accelerometer;
}

}  // namespace

void resolve_own_terms(Timeline& timeline, const ModelSpec& model) {
  const AskedSteps asked = asked_steps(timeline, model);
  for (std::size_t n = 0; n < asked.fine.size(); ++n)
    if (asked.fine[n]) timeline.intervals[n].fine = true;
  if (!asked.finer) return;
  std::vector<Mat3> R_lp(static_cast<std::size_t>(timeline.chains));
  for (const Interval& i : timeline.intervals)
    if (i.cage) R_lp[static_cast<std::size_t>(i.chain)] = timeline.nodes[i.first_node].R_lr;
  for (std::size_t n = 0; n < asked.substeps.size(); ++n)
    timeline.intervals[n].substeps = asked.substeps[n];
  place_nodes(timeline, R_lp);
}

OwnTruthSteps::OwnTruthSteps(const ModelSpec& truth) : truth_(truth) {
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own)
    drives_ = drives_ || drives_platform(truth, own);
}

void OwnTruthSteps::of_run(const Timeline& timeline, const Theta& drawn) {
  substeps_.clear();
  if (!drives_) return;
  ModelSpec as_drawn = truth_;
  bool others = false;
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own) {
    if (!drives_platform(truth_, own)) continue;
    const std::size_t first = TermLibrary::terms[TermLibrary::num_known + own].first;
    for (std::size_t i = first; i < first + own_terms().terms[own].params.size(); ++i) {
      if (TermLibrary::specs[i].amplitude()) continue;
      const double value = drawn[static_cast<Eigen::Index>(i)];
      others = others || value != truth_.priors[i].mean();
      as_drawn.priors[i] = fixed(value);
    }
  }
  if (others) substeps_ = asked_steps(timeline, as_drawn).substeps;
}

double OwnTruthSteps::longest(const Timeline& timeline, std::size_t i) const {
  if (!drives_) return 0.0;
  constexpr int least = 4;  // steps of two nodes
  const Interval& row = timeline.intervals[i];
  return row.length() / (2.0 * std::max(least, substeps_.empty() ? row.substeps : substeps_[i]));
}

std::vector<UnresolvedOwnTerm> unresolved_own_terms(const Timeline& timeline,
                                                    const ModelSpec& model) {
  constexpr double too_far_off = 0.05;
  std::vector<UnresolvedOwnTerm> all;
  const TermMask terms = model.model().terms;
  for_each_own(timeline, model, [&](std::size_t own, const OwnCourse& course) {
    if (!terms[TermLibrary::num_known + own] || !has_means(own)) return;
    double errors = 0.0, values = 0.0;  // sums of squares
    UnresolvedOwnTerm one{own};
    for (const Interval& i : timeline.intervals) {
      const RowCourse row(course, timeline, i);
      // Where nothing asked for finer steps these are good to a thousandth.
      const double error = i.fine ? row.error(i.substeps) : 0.0;
      errors += error * error;
      values += row.mean_square();
      one.longest_row = std::max(one.longest_row, i.length());
    }
    one.off = errors > 0.0 ? std::sqrt(errors / values) : 0.0;
    if (one.off > too_far_off) all.push_back(one);
  });
  return all;
}

}  // namespace drift
