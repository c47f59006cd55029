#include "core/estimate/sequential/reference_path.hpp"

#include <gtest/gtest.h>

#include "tests/support/term_scenes.hpp"

namespace drift::reference_path_test {
namespace {

using namespace drift::test;

/// The motion with one term, forward; and taken back from its ends.
double worst_way_back(const Timeline& timeline, std::size_t term) {
  ModelSpec spec =
      base_spec(TermLibrary::terms[term].key == "frame_closure" ? Coupling::lambda : Coupling::eq6);
  spec.active = only({"D_F", "eta"}) | term_params(term);
  const DriftModel model = spec.model();
  Theta theta = Theta::Zero();
  theta[param("D_F_y")] = 0.4 * deg_per_h;
  theta[param("eta_z")] = 70.0 * arcsec;
  set_term(theta, term);
  const Trajectory forward = integrate_fixed(
      timeline, model, theta, std::vector<Vec3>(timeline.chains, Vec3(4e-4, -3e-4, 5e-4)));
  ReferencePath path(timeline, model);
  for (const Interval& i : timeline.intervals) path.end_chain(i, forward[i.last_node()]);
  double worst = 0.0;
  for (int again = 0; again < 2; ++again) {  // the second time without a trace of the first
    path.place(again ? theta : Theta(0.5 * theta));
    if (!again) continue;
    for (const Interval& i : timeline.intervals)
      for (std::size_t k = 0; k < i.node_count(); ++k)
        worst = std::max(worst, (path.nodes(i)[k] - forward[i.first_node + k]).norm());
  }
  return worst;
}

TEST(ReferencePath, LeadsBackToWhereTheChainBeganWithEveryTerm) {
  // There and back by steps of the same size and order: what is left is the error of the steps,
  // 1e-3 arcsec in slews (core/README.md), for half a day of them.
  for (const auto& [preset, mode] :
       {std::pair("slew12", CommandLaw::level), std::pair("six", CommandLaw::free)}) {
    const Timeline timeline = scene(preset, mode, 1800.0, 180.0);
    for (const std::size_t term : visible_terms())
      EXPECT_LT(worst_way_back(timeline, term), 1e-3 * arcsec)
          << TermLibrary::terms[term].key << " in " << preset;
  }
}

}  // namespace
}  // namespace drift::reference_path_test
