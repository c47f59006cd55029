#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/identification/delay_doubt.hpp"
#include "analysis/identification/heading_doubt.hpp"
#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/identification/memory_doubt.hpp"
#include "analysis/identification/spikes.hpp"
#include "analysis/identification/stated_loop.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/plan/excitation.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// One filter from one start, by both estimators.
struct FilterRun {
  std::size_t filter = 0;  ///< index in the study
  std::size_t start = 0;   ///< start_count() of the filter: the prior mean, tried after the drawn
  EstimateResult ekf;
  EkfHistory history;
  BatchResult batch;
  std::vector<MemoryLeftOut> memory_doubt;  ///< along the path of the batch fit
  std::vector<MemoryGaps> memory_gaps;      ///< with its parameters
};

/// How the starts of one filter agree on one parameter.
struct StartSpread {
  std::size_t param = 0;
  double ekf = 0.0, batch = 0.0;  ///< start-consistency ratios
  /// Of the estimator that counts (judged()); of a batch fit, of the starts that fit as well.
  double counted = std::numeric_limits<double>::quiet_NaN();
};

/// All starts of one filter.
struct FilterSummary {
  std::size_t filter = 0;
  std::string name;
  Coupling coupling = Coupling::eq5;
  Layout layout;
  std::vector<StartSpread> spread;    ///< layout order; NaN ratios with one start
  std::vector<WeakDirection> unseen;  ///< directions below unseen_information, weakest first
  std::size_t counted_start = 0;      ///< which is believed (counted_start()), among its runs
  std::size_t agreeing_starts = 0;    ///< with it, itself with them
  std::size_t weak = 0;               ///< directions of which the prior says more than the data
  bool field_considered = false;  ///< sigmas hold the error of an assumed field (consider_field())
  std::optional<HeadingDoubt> heading_doubt;    ///< behind its misfit
  std::optional<LatitudeDoubt> latitude_doubt;  ///< behind it; not asked beside the other
};

/// One sample interval of the test.
struct SampleOfTest {
  double t = 0.0;    ///< its end [s]
  int position = 1;  ///< number of the plan position, from 1
  bool slew = false;
  double accelerometer_noise = 0.0;  ///< of their means, 1 sigma [g]
  double gimbal_noise = 0.0;         ///< 1 sigma [rad]
  std::size_t recording = 1;         ///< its number, from 1
};

/// Parameters of a platform, estimated from one test by every filter and start of a study.
struct Identification {
  bool simulated = false;
  bool test_of_each_start = false;    ///< in a loop that is fed back; else one test for all
  std::optional<TruthDraw> truth;     ///< of a simulated recording
  std::vector<Recording> recordings;  ///< as they were used; of a simulation the one
  std::vector<std::string> sources;
  std::vector<std::string> names;    ///< how each of several recordings is called; empty of one
  std::vector<std::string> remarks;  ///< what was left out or changed (prepare())
  std::optional<DelayDoubt> delay;   ///< of accelerometers against gimbals, behind a misfit
  std::string off_zero;              ///< a gimbal that reads a constant too much (prepare()); or ""
  std::vector<int> absent_positions;  ///< of the plan, in no recording (prepare())
  std::vector<std::string> absent;    ///< channels of [readout] that no recording measured
  /// What recordings state of a loop, whether or not filters know of it (coupling "compensated").
  std::optional<StatedLoop> loop;
  std::vector<SampleOfTest> samples;
  Excitation excitation;        ///< of the plan or of the recordings
  std::vector<Spike> spikes;    ///< of recordings: as the first filter's batch fit shows them
  std::vector<FilterRun> runs;  ///< by filter, then start
  std::vector<FilterSummary> summaries;

  std::vector<const FilterRun*> runs_of(std::size_t filter) const;

  /// Whether recordings state a loop and the filter has another coupling than that of one.
  bool leaves_out_loop(const FilterSpec& filter) const {
    return loop && filter.coupling != Coupling::compensated;
  }

  /// The run that a filter is judged by: whatever is said of the filter is said of this one.
  const FilterRun& counted(const FilterSummary& filter) const;
};

/// What is believed of a run of a filter: where its drift varies, which the batch fit does not
/// model, the EKF.
const EstimateResult& judged(const FilterSpec& filter, const FilterRun& run);

/// Chi-square over its degrees of freedom is above where any right model has it
/// (FitLimits::misfit).
bool misfit(const EstimateResult& result);

/// It is as far below 1, and the declared noise is no upper bound: the rows scatter less than it
/// says. What was estimated stands, with sigmas that are too wide. (Rows that were joined scatter
/// less, too, where their noise is not white.)
bool less_noise(const EstimateResult& result);

/// How large the noise is over the declared one, by what judged() leaves of all rows together. Of
/// a batch fit by the data alone, less what the parameters took of them.
double noise_of_declared(const FilterSpec& filter, const FilterRun& run);

/// Called as runs are completed, from any thread: done, total.
using Progress = std::function<void(std::size_t, std::size_t)>;

/// Simulates one recording from [truth] (run number `run`) and estimates. With a compensated loop
/// that is fed back, every filter and start watches a test of its own, driven by its estimates.
/// InputError (config) if the study has no filter or no truth, or as mc::require_own_terms().
/// Failed integration: InputError (self_check).
Identification identify_simulated(const mc::Study& study, std::uint64_t run, int threads,
                                  const Progress& progress = {});

/// Estimates from recordings, made ready as for a diagnosis (prepare()); several are taken as one
/// test, each starting with a caging. InputError (recording, config) as prepare() has it.
Identification identify_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                                   int threads, const Progress& progress = {});

}  // namespace drift::identification
