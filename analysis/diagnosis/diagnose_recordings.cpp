#include "analysis/diagnosis/diagnose_recordings.hpp"

#include <algorithm>
#include <chrono>

#include "analysis/diagnosis/advice/advise.hpp"
#include "analysis/diagnosis/advice/alternatives.hpp"
#include "analysis/diagnosis/doubts/delay_instead.hpp"
#include "analysis/diagnosis/doubts/site_doubt.hpp"
#include "analysis/diagnosis/doubts/unknown_field.hpp"
#include "analysis/diagnosis/recording_spans.hpp"
#include "analysis/identification/absent_channels.hpp"
#include "analysis/identification/stated_loop.hpp"
#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"

namespace drift::diagnosis {
namespace {

/// Adds the advice, or why there is none.
Diagnosis advised(Diagnosis d, const preparation::Prepared& test,
                  const RecordingsOptions& options) {
  if (options.advising == Advising::left_out) return d;
  const auto began = std::chrono::steady_clock::now();
  std::optional<std::vector<std::string>> asked;
  if (options.advising == Advising::on_request) asked = options.asked;
  try {
    d.advice = advise(test.study, test.recordings, d,
                      {.seed = test.study.monte_carlo.seed, .asked = asked});
  } catch (const InputError& e) {
    if (e.code() == ExitCode::usage) throw;  // what was asked for is wrong
    d.remarks.emplace_back(remark::NoAdvice{e.what()});
  }
  d.seconds.emplace_back(
      "advice", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  return d;
}

/// What was read and is not used is told with the terms that would follow it: a covariate that is
/// mostly unknown, a temperature that is mapped as nothing.
void name_what_was_read(const std::vector<Recording>& recordings, const preparation::Prepared& test,
                        std::vector<NotExamined>& left_out) {
  for (NotExamined& n : left_out) {
    for (const preparation::UnusedCovariate& unused : test.unused)
      if ((n.missing & unused.set) != 0 && n.instead.empty()) n.instead = unused.why;
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      const bool has_it = !n.lacking.empty() && std::ranges::count(n.lacking, k) == 0;
      if ((n.missing & covariate("temperature").set()) != 0 && n.instead.empty() && !has_it)
        n.instead = recordings[k].unmapped_temperature;
    }
  }
}

}  // namespace

Diagnosis of_another_study(Diagnosis d) {
  d.probabilities = {};
  d.proposal.reset();
  for (RecoveredSignal& s : d.signals) s.say_no_shape();
  std::erase_if(d.remarks, [](const Remark& r) {
    return std::holds_alternative<remark::StrongestLeft>(r) ||
           std::holds_alternative<remark::FreeInputExplains>(r) ||
           std::holds_alternative<remark::PeriodExplains>(r) ||
           std::holds_alternative<remark::MemoryOff>(r) ||
           std::holds_alternative<remark::BeyondPrior>(r);
  });
  return d;
}

Diagnosis diagnose_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                              const RecordingsOptions& options) {
  if (options.advising == Advising::on_request && !study.filters.empty())
    require_askable(study.filters.front(), options.asked);
  preparation::Prepared test = preparation::prepare(
      study, recordings, preparation::RecordingLimits::most_rows, preparation::Following::library);
  const StageReport& progress = options.diagnose.progress;
  // Where nothing is advised the rest takes a moment.
  const double of_diagnosis = options.advising == Advising::left_out ? 0.99 : 0.8;
  DiagnoseOptions first = options.diagnose;
  if (progress)
    first.progress = [&](const std::string& stage, double done) {
      progress(stage, of_diagnosis * done);
    };
  DiagnoseOptions second = options.diagnose;
  if (progress)
    second.progress = [&](const std::string& stage, double) { progress(stage, of_diagnosis); };
  Diagnosis d = with_error_of_field(diagnose(test.study, test.recordings, first), test.study,
                                    test.recordings, second);
  if (d.field && d.field->another())
    test.study = with_field(std::move(test.study), d.field->field_l);
  name_what_was_read(recordings, test, d.not_examined);
  if (progress) progress("latitude and advice", of_diagnosis);
  // A delay that leaves nothing is no other study.
  const auto delay = delay_instead(test.study, test.recordings, recordings, d);
  const bool delay_alone = delay && delay->delay.alone();
  if (!d.of_case && !delay_alone)
    d.heading_doubt = identification::heading_doubt(test.study, test.recordings, d.nominal);
  if (!d.heading_doubt && !delay_alone) {
    SiteFinding site = site_doubt(test.study, test.recordings, d, second);
    // What mends a part of a misfit that has another cause is no latitude.
    if (site.doubt && !site.doubt->alone() && !test.off_zero.empty()) site = {};
    const bool less_likely = site.doubt && site.doubt->less_likely;
    (less_likely ? d.other_latitude : d.site_doubt) = site.doubt;
    d.there = std::move(site.there);
  }
  if (d.wrong_study())
    d = of_another_study(std::move(d));
  else if (delay)
    d = with_delay(std::move(d), *delay);
  else if (const auto times = times_instead(test.study, test.recordings, d))
    d.remarks.emplace_back(*times);
  d.absent_positions = test.absent_positions;
  if (!d.of_case) d.absent = identification::absent_channels(test.recordings, test.study.readout);
  d = advised(std::move(d), test, options);
  if (progress) progress("done", 1.0);
  std::vector<Remark> remarks;
  if (const auto loop = identification::stated_loop(test.recordings);
      loop && !d.of_case && d.nominal.coupling != Coupling::compensated)
    remarks.emplace_back(remark::LoopLeftOut{*loop, d.nominal.name});
  if (!test.off_zero.empty()) remarks.emplace_back(remark::GimbalOffZero{test.off_zero});
  for (const std::string& text : test.remarks) remarks.emplace_back(remark::Input{text});
  d.remarks.insert(d.remarks.begin(), remarks.begin(), remarks.end());
  d.where.recordings = recording_spans(test.study, test.recordings);
  return d;
}

}  // namespace drift::diagnosis
