#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/alternatives.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::diagnosis {

/// A pair that added positions set apart.
struct Helped {
  Contest pair;
  double now = 0.0, after = 0.0;  ///< separation [1 sigma]
};

/// Labels of the alternatives in some pairs, in their order, the nominal model left out unless it
/// stands for an equation.
std::vector<std::string> labels_of(const Question& q, const std::vector<Contest>& pairs);

/// What a plan does. helped: closest first; asked: pairs of the question, told apart already or
/// not.
std::string helped_text(const Advice& a, const Question& q, const std::vector<Helped>& helped,
                        std::size_t asked, double wanted);
/// Pairs that no position tells apart, because their traces are the same.
std::string twins_text(const Question& q, const std::vector<Contest>& pairs);
/// Pairs that stay too near each other, and effects that stay unseen, with `most` additions of
/// `pool`.
std::string hidden_text(const Question& q, const std::vector<Contest>& pairs, std::size_t most,
                        std::size_t pool);
/// The recording tells all that was asked.
std::string told_text(const Question& q, const Contest& closest, double sigma);
/// Nothing looks like what is named.
std::string nothing_alike_text(const Question& q);
/// Nothing explains the misfit.
std::string unexplained_text(const Diagnosis& d, const TestPlan& plan);

/// A sentence without a plan.
Advice text_alone(std::string text);

}  // namespace drift::diagnosis
