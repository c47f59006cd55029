#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/inference/candidate.hpp"

namespace drift::diagnosis {

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

/// InputError (usage), all mistakes at once, if a term that is asked for does not exist, is in the
/// nominal model, or follows what no plan can foretell: what can be told before a diagnosis.
void require_askable(const FilterSpec& nominal, const std::vector<std::string>& terms);

/// The signatures that a question needs, and where each alternative's are among them.
struct Columns {
  std::vector<inference::SignatureSpec> signatures;
  std::vector<planning::Trace> traces;  ///< of each alternative
};

/// Numbers the linear parameters of all alternatives. theta: where they are evaluated.
Columns columns_of(const std::vector<Alternative>& all, const FilterSpec& nominal,
                   const Theta& theta);

/// Some pairs of a question, with the alternatives that they need.
Question restricted(const Question& q, const std::vector<planning::Contest>& pairs);

/// Whether lambda is part of it.
bool holds_lambda(const Alternative& a);

/// Whether a cause follows what varies while a test runs, such as the temperature. Positions are
/// planned at one temperature: it stays unseen in any of them.
bool follows_what_varies(const std::vector<search::Cause>& causes);

}  // namespace drift::diagnosis
