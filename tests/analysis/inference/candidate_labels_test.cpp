// What the candidates are called: what is told of one by its label is told of no other.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "analysis/inference/candidate.hpp"
#include "core/estimate/layout.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::inference::candidate_labels_test {
namespace {

using namespace drift::test;

CandidateSet candidates() {
  const FilterSpec filter = base_filter(Coupling::eq5);
  return library_candidates(filter, make_layout(filter).theta, scene("twelve", CommandLaw::level));
}

std::vector<std::string> labels_of(const CandidateSet& set, std::string_view term) {
  std::vector<std::string> labels;
  for (const Candidate& c : set.candidates)
    if (c.term == term) labels.push_back(c.label);
  std::ranges::sort(labels);
  return labels;
}

TEST(CandidateLabels, NoTwoAreTheSame) {
  const CandidateSet set = candidates();
  EXPECT_GT(set.candidates.size(), 100u);
  std::set<std::string> labels;
  for (const Candidate& c : set.candidates) EXPECT_TRUE(labels.insert(c.label).second) << c.label;
}

TEST(CandidateLabels, NameThePartOfATermThatNoAxisTellsApart) {
  EXPECT_EQ(
      labels_of(candidates(), "pier_azimuth"),
      (std::vector<std::string>{"pier_azimuth", "pier_azimuth turn_c", "pier_azimuth turn_s"}));
}

TEST(CandidateLabels, NameThePartOfATermOfTheStudyToo) {
  const OwnTermsHeld own(own_term("twin", "drift.x", "A*t + B*f_S",
                                  "A = { unit = 'deg/h/h', prior = 0.01 }, B = { unit = "
                                  "'deg/h/g', prior = 2 }"));
  EXPECT_EQ(labels_of(candidates(), "twin"),
            (std::vector<std::string>{"twin", "twin twin_A", "twin twin_B"}));
}

}  // namespace
}  // namespace drift::inference::candidate_labels_test
