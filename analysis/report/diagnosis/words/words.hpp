#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/report/diagnosis/words/instrument.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

/// "magnetic_drift.y": the term and its axis.
std::string label_of(const search::Cause& cause);
std::string label_of(const search::CandidateScore& candidate);

/// The same as a table shows it. A key of which the instrument has no such part has the words of
/// what it has before it: "scale factor asymmetry of the gyros (torquer_asymmetry.x)".
std::string shown_label(const diagnosis::Diagnosis& diagnosis, const search::Cause& cause);
std::string shown_label(const diagnosis::Diagnosis& diagnosis,
                        const search::CandidateScore& candidate);

/// A candidate of the table or the figure, and the alternative that it belongs to: 1 for the first
/// set of causes, 0 for what is no cause.
struct ShownCandidate {
  const search::CandidateScore* score = nullptr;
  int alternative = 0;
};

/// The strongest candidates, and every cause of the verdict however weak its own score is (of two
/// that cancel each looks weak alone). In the order of the diagnosis; more than `most` only for
/// causes.
std::vector<ShownCandidate> shown_candidates(const diagnosis::Diagnosis& diagnosis,
                                             std::size_t most);

/// What a reader must know: the diagnosis' own remarks, and what patched.toml holds where several
/// causes remain possible.
std::vector<std::string> remarks_of(const diagnosis::Diagnosis& diagnosis);

/// The recording that a time of the timeline falls into; null where there is one recording only.
const diagnosis::RecordingSpan* recording_at(
    const std::vector<diagnosis::RecordingSpan>& recordings, double t_s);

/// How each of several recordings is called; empty of one.
RecordingNames names_of_recordings(const std::vector<diagnosis::RecordingSpan>& recordings);

/// What time axes of a page are in: short tests are shown in seconds, long ones in hours.
enum class TimeUnit { seconds, hours };
TimeUnit time_unit(const std::vector<double>& t);
/// Of the page of a diagnosis; seconds where it has no such axis.
TimeUnit time_unit(const diagnosis::Diagnosis& diagnosis);

/// When something set in that stays: "sets in at 400 s of b.csv and stays", "is another from
/// recording 2 (b.csv) on" where that is at its beginning. Beside axes in hours, of one recording,
/// "sets in at 25200 s (7.00 h) and stays".
std::string onset_text(double t_s, const std::vector<diagnosis::RecordingSpan>& recordings,
                       TimeUnit axes = TimeUnit::seconds);

/// A channel in words: "accelerometer y" of "acc_y", "outer gimbal" of "gimbal_outer".
std::string channel_in_words(const std::string& name);

/// What a fold holds out: "position 3", "recording 2, b.csv", "dwell 7".
std::string fold_name(const diagnosis::Fold& fold,
                      const std::vector<diagnosis::RecordingSpan>& recordings);

/// "sag, ... and accelerometer_cross, ... leave the same trace on this plan", a line each.
std::vector<std::string> twins_in_words(const std::vector<diagnosis::Twins>& twins,
                                        Instrument instrument = Instrument::platform);

/// Where the misfit is, in one sentence; empty if nothing is located. Beside axes in hours times
/// are told in both units.
std::string where_sentence(const diagnosis::Where& where, TimeUnit axes = TimeUnit::seconds);

/// The same for a sentence that has no room: "above all at positions 3, 15 and 4", else "above all
/// from 400 s to 1000 s of b.csv", the strongest window; empty where neither stands out.
std::string place_text(const diagnosis::Where& where);

/// Whether the cause made held-out prediction better; empty without held-out data.
std::string held_out_sentence(const diagnosis::HeldOut& held_out);

/// "with it, held-out positions are predicted better". That goes by the log score, which weighs
/// each error by how surely it was predicted: where errors_text() shows one that grows, so it says.
/// several: causes.
std::string held_out_text(const diagnosis::Diagnosis& diagnosis, bool several);

/// How a recording on a case is predicted, without the cause and with it.
std::string errors_text(const diagnosis::Diagnosis& diagnosis);

/// How badly the nominal model fits, where no effect says what it would become.
std::string misfit_text(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
