#pragma once

#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/inference/projector.hpp"
#include "analysis/inference/signatures.hpp"
#include "analysis/planning/position_pool.hpp"
#include "analysis/planning/separation.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// A recorded test with its nominal fit, and what positions behind it would tell.
class ExtendedTest {
 public:
  /// study and diagnosis must outlive it.
  ExtendedTest(const mc::Study& study, const std::vector<Recording>& recordings,
               const Diagnosis& diagnosis);

  const Timeline& timeline() const { return test_.timeline; }
  const BatchResult& fit() const { return fit_; }

  /// Signatures as the recordings show them, nominal parameters ready to be projected out.
  inference::Projector projector(const std::vector<inference::SignatureSpec>& signatures) const;

  /// What the recordings tell of signatures, the nominal parameters being those of a fit.
  planning::Information recorded(const BatchResult& at,
                                 const std::vector<inference::SignatureSpec>& signatures) const;

  /// What an addition behind the recorded positions tells: what changes with time has gone on until
  /// then. InputError if the gimbals do not allow it.
  planning::Information added(const planning::Addition& addition, const BatchResult& at,
                              const std::vector<inference::SignatureSpec>& signatures) const;

  /// Simulates the plan with positions added, a truth's causes in it beside the fitted parameters,
  /// and fits truth and rival: root of the difference of their costs. NaN: not integrable.
  double verified(const std::vector<Position>& added, const Alternative& truth,
                  const Alternative& rival, const Theta& fitted, std::uint64_t seed) const;

 private:
  Timeline planned(const std::vector<Position>& positions) const;

  const mc::Study& study_;
  const Diagnosis& d_;
  inference::NoiseModel noise_;
  preparation::RecordedTest test_;
  BatchResult fit_;
};

}  // namespace drift::diagnosis
