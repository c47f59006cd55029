#pragma once

#include <string>
#include <vector>

#include "analysis/inference/candidate.hpp"
#include "analysis/diagnosis/diagnosis.hpp"

namespace drift::diagnosis {

/// A way the truth may be: what it adds to the nominal model, and by how much.
struct Alternative {
  std::string label;
  std::vector<search::Cause> causes;  ///< empty: the nominal model itself
  std::vector<int> columns;           ///< of its linear parameters among all signatures
  VecX amplitude;                     ///< in prior sigmas
};

/// Two alternatives to be told apart, by index: one is true, the other is taken for it.
struct Contest {
  std::size_t truth = 0, rival = 0;
  bool operator==(const Contest&) const = default;
};

/// What is to be told from what.
struct Question {
  std::vector<Alternative> alternatives;
  std::vector<Contest> pairs;
  std::string size;  ///< of the effects, in words: "at one prior sigma"; empty: as found

  bool empty() const { return pairs.empty(); }
};

/// What a diagnosis leaves open by itself: the alternatives of an ambiguous verdict, or, where the
/// nominal coupling is eq5 or eq6 and the test is blind to lambda, the two equations.
Question open_question(const Diagnosis& d);

/// Every parameter that a test may not show, one prior sigma large, against the nominal model. With
/// the other equation, where a consistent diagnosis leaves it open.
Question hidden_question(const Diagnosis& d, const inference::CandidateSet& set);

/// The named causes at the sizes found against what each can be taken for. rivals: (cause,
/// candidate, variant), the candidate in place of the cause.
struct Rival {
  std::size_t cause = 0, candidate = 0, variant = 0;
};
Question named_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<Rival>& rivals);

/// Terms that are asked for ("magnetic_drift", "magnetic_drift.y", "M_y"): every parameter of each,
/// at the size found (where the diagnosis names it) or at one prior sigma, against the nominal
/// model and against each other term as a whole. InputError (usage), all mistakes at once, if a
/// term does not exist, is in the nominal model, or leaves no trace in a test like this one.
Question asked_question(const Diagnosis& d, const inference::CandidateSet& set,
                        const std::vector<std::string>& terms);

/// Numbers the linear parameters of all alternatives and notes their amplitudes; the signatures, in
/// that order. theta: where they are evaluated.
std::vector<inference::SignatureSpec> number_signatures(std::vector<Alternative>& all,
                                                        const FilterSpec& nominal,
                                                        const Theta& theta);

/// Drops the alternatives that no pair needs; columns are to be numbered anew.
void prune(Question& q);

/// Whether lambda is part of it.
bool holds_lambda(const Alternative& a);

}  // namespace drift::diagnosis
