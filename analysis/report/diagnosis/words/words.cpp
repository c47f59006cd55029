#include "analysis/report/diagnosis/words/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/words/not_examined_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

std::string with_own_words(const Diagnosis& d, const std::string& term, std::string label) {
  const auto known = TermLibrary::find_term(term);
  if (!known) return label;
  const TermInfo& info = TermLibrary::terms[*known];
  const std::string_view title = title_of(info, instrument_of(d));
  return title == info.title ? label : fmt::format("{} ({})", title, label);
}

/// "gyro y and the accelerometer z" of several causes.
std::string equations_text(const Where& where) {
  if (where.equations.empty()) return equation_in_words(where.equation);
  std::vector<std::string> words;
  for (const std::string& e : where.equations)
    words.push_back((words.empty() ? "" : "the ") + equation_in_words(e));
  return listed(words, "and");
}

/// A tenth of the misfit and more, and none that noise makes.
bool is_told(const Share& s) {
  return s.share > 0.1 && s.share > 2.0 * s.sigma;
}

/// Of these the first three that are told.
std::vector<Share> told_of(const std::vector<Share>& positions) {
  std::vector<Share> told;
  for (const Share& s : positions)
    if (told.size() < 3 && is_told(s)) told.push_back(s);
  return told;
}

/// ", most of it at positions 3 (41 %) and 7 (20 %)"; fewer than half are no most.
std::string at_positions_text(const std::vector<Share>& positions) {
  std::vector<std::string> parts;
  double sum = 0.0;
  for (const Share& s : told_of(positions)) {
    parts.push_back(fmt::format("{} ({:.0f} %)", s.position, 100.0 * s.share));
    sum += s.share;
  }
  if (parts.empty()) return "";
  const std::string_view s = parts.size() > 1 ? "s" : "";
  return sum > 0.5 ? fmt::format(", most of it at position{} {}", s, listed(parts, "and"))
                   : fmt::format(", the largest part{0} of it at position{0} {1}", s,
                                 listed(parts, "and"));
}

/// "7.00 h to 7.50 h; ", on the axis of the page.
std::string on_axis_in_hours(const ScanHit& w, bool several_recordings) {
  constexpr double hour = 3600.0;
  const int decimals = w.end_s - w.start_s < 0.1 * hour ? 3 : 2;
  return fmt::format("{} h to {} h{}; ", decimal_text(w.start_s / hour, decimals),
                     decimal_text(w.end_s / hour, decimals),
                     several_recordings ? " through all recordings" : "");
}

/// "400 s to 1000 s of b.csv", in the time of the recording that holds it.
std::string window_text(const ScanHit& w, const std::vector<RecordingSpan>& recordings) {
  const RecordingSpan* r = recording_at(recordings, 0.5 * (w.start_s + w.end_s));
  const double offset = r ? r->offset_s : 0.0;
  return fmt::format("{:.0f} s to {:.0f} s{}", w.start_s - offset, w.end_s - offset,
                     r ? " of " + r->name : "");
}

}  // namespace

std::string label_of(const Cause& c) {
  return keyed(c.term, c.axis);
}

std::string label_of(const CandidateScore& c) {
  return c.label.empty() ? keyed(c.term, c.axis) : c.label;
}

std::string shown_label(const Diagnosis& d, const Cause& c) {
  return with_own_words(d, c.term, label_of(c));
}

std::string shown_label(const Diagnosis& d, const CandidateScore& c) {
  return with_own_words(d, c.term, label_of(c));
}

std::vector<ShownCandidate> shown_candidates(const Diagnosis& d, std::size_t most) {
  const bool labelled =
      d.cosines.labels.size() == d.causes.size();  // says which parameters are meant
  const auto is = [&](const CandidateScore& c, std::size_t k) {
    if (labelled && std::ranges::any_of(d.candidates, [&](const CandidateScore& o) {
          return label_of(o) == d.cosines.labels[k];
        }))
      return label_of(c) == d.cosines.labels[k];
    return c.term == d.causes[k].term && c.axis == d.causes[k].axis;
  };
  std::vector<ShownCandidate> shown;
  std::vector<bool> had(d.causes.size(), false);
  for (std::size_t i = 0; i < d.candidates.size(); ++i) {
    ShownCandidate s{&d.candidates[i], 0};
    for (std::size_t k = 0; k < d.causes.size(); ++k)
      if (!had[k] && is(*s.score, k)) {
        had[k] = true;
        if (s.alternative == 0) s.alternative = d.causes[k].set + 1;
      }
    if (i < most || s.alternative > 0) shown.push_back(s);
  }
  return shown;
}

std::vector<std::string> remarks_of(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const Remark& r : d.remarks)
    all.push_back(in_words(r, instrument_of(d), d.where.recordings));
  for (std::string& left_out : not_examined_sentences(d.not_examined, d.where.recordings))
    all.push_back(std::move(left_out));
  if (const auto& recordings = d.where.recordings; !recordings.empty()) {
    std::vector<std::string> begins;
    for (const RecordingSpan& r : recordings)
      begins.push_back(fmt::format("{} begins at {:.0f} s ({:.0f} s of its own time)", r.name,
                                   r.start_s, r.start_s - r.offset_s));
    all.push_back(
        fmt::format("Times in tables and figures run through all recordings, one after another: "
                    "{}. A number of a "
                    "position is that of the plan, whatever the recording.",
                    listed(begins, "and")));
  }
  if (std::string patch = patch_text(d); !patch.empty()) all.push_back(std::move(patch));
  return all;
}

const RecordingSpan* recording_at(const std::vector<RecordingSpan>& recordings, double t) {
  if (recordings.empty()) return nullptr;
  const auto at =
      std::ranges::find_if(recordings, [&](const RecordingSpan& r) { return t <= r.end_s; });
  return at == recordings.end() ? &recordings.back() : &*at;
}

RecordingNames names_of_recordings(const std::vector<RecordingSpan>& recordings) {
  RecordingNames names;
  for (const RecordingSpan& r : recordings) names.push_back(r.name);
  return names;
}

std::string channel_in_words(const std::string& name) {
  if (name == "acc") return "gravity in the dwells";
  if (name == "turn") return "the turns";
  const auto bar = name.find('_');
  const std::string kind = name.substr(0, bar),
                    axis = bar == std::string::npos ? "" : name.substr(bar + 1);
  if (kind == "acc") return fmt::format("accelerometer {}", axis);
  if (kind == "gimbal") return fmt::format("{} gimbal", axis);
  if (kind == "gyro") return fmt::format("gyro {}", axis);
  return name;
}

std::string fold_name(const Fold& fold, const std::vector<RecordingSpan>& recordings) {
  switch (fold.of) {
    case Fold::Of::position:
      return fmt::format("position {}", fold.number);
    case Fold::Of::dwell:
      return fmt::format("dwell {}", fold.number);
    case Fold::Of::recording:
      break;
  }
  const auto k = static_cast<std::size_t>(fold.number);
  const std::string plain = fmt::format("recording {}", k);
  const bool named = k >= 1 && k <= recordings.size() && recordings[k - 1].name != plain;
  return named ? fmt::format("{}, {}", plain, recordings[k - 1].name) : plain;
}

std::vector<std::string> twins_in_words(const std::vector<Twins>& twins, Instrument instrument) {
  std::vector<std::string> lines;
  for (const Twins& t : twins)
    lines.push_back(fmt::format("{} and {} leave the same trace on this plan",
                                in_words(t.one.term, t.one.axis, instrument),
                                in_words(t.other.term, t.other.axis, instrument)));
  return lines;
}

std::string where_sentence(const Where& where, TimeUnit axes) {
  if (where.equation.empty() && where.channels.empty()) return "";
  std::string out = where.equation.empty()
                        ? "The misfit is"
                        : fmt::format("The misfit is in the {}", equations_text(where));
  std::vector<std::string> parts;
  for (const Share& s : where.channels)
    if (parts.size() < 2 && is_told(s))
      parts.push_back(fmt::format("{} ({:.0f} %)", channel_in_words(s.name), 100.0 * s.share));
  if (!parts.empty()) out += fmt::format(", seen by {}", listed(parts, "and"));
  out += at_positions_text(where.positions);
  if (std::isfinite(where.onset_s)) {
    out += "; it " + onset_text(where.onset_s, where.recordings, axes);
  } else if (!where.windows.empty()) {
    const ScanHit& w = where.windows.front();
    out += fmt::format(
        "; the strongest window is {}{} ({}chance of a false alarm: {})",
        window_text(w, where.recordings),
        w.equation == where.equation ? ""
                                     : fmt::format(", as the {}", equation_in_words(w.equation)),
        axes == TimeUnit::hours
            ? on_axis_in_hours(
                  w, recording_at(where.recordings, 0.5 * (w.start_s + w.end_s)) != nullptr)
            : "",
        p_text(w.p_value));
  }
  return out + ".";
}

std::string place_text(const Where& where) {
  std::vector<std::string> positions;
  for (const Share& s : told_of(where.positions))
    positions.push_back(fmt::format("{}", s.position));
  if (!positions.empty())
    return fmt::format("above all at position{} {}", positions.size() > 1 ? "s" : "",
                       listed(positions, "and"));
  return where.windows.empty()
             ? ""
             : "above all from " + window_text(where.windows.front(), where.recordings);
}

std::string misfit_text(const diagnosis::Diagnosis& d) {
  const double band = d.fit.band_high;
  if (d.nearest_known || !(band > 0.0) || !(d.fit.chi2_per_dof_before > band)) return "";
  return fmt::format(
      ", chi-square per degree of freedom is {:.3g} where noise makes {:.3g} to {:.3g}",
      d.fit.chi2_per_dof_before, d.fit.band_low, band);
}

}  // namespace drift::report
