#include "analysis/diagnosis/diagnose_recordings.hpp"

#include <chrono>

#include "analysis/diagnosis/advice/advise.hpp"
#include "analysis/diagnosis/recording_spans.hpp"
#include "analysis/diagnosis/site_doubt.hpp"
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

}  // namespace

Diagnosis diagnose_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                              const RecordingsOptions& options) {
  const preparation::Prepared test = preparation::prepare(study, recordings);
  Diagnosis d = diagnose(test.study, test.recordings, options.diagnose);
  d.site_doubt = site_doubt(test.study, test.recordings, d);
  d = advised(std::move(d), test, options);
  std::vector<Remark> remarks;
  for (const std::string& text : test.remarks) remarks.emplace_back(remark::Input{text});
  d.remarks.insert(d.remarks.begin(), remarks.begin(), remarks.end());
  d.where.recordings = recording_spans(test.study, test.recordings);
  return d;
}

}  // namespace drift::diagnosis
