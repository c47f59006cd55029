#include <fmt/format.h>

#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/words.hpp"

namespace drift::report {
namespace {

using diagnosis::RecordingSpan;

/// "recording 2 (b.csv)" of number 2, and "recording 2" where that is all it is called.
std::string numbered(const std::vector<RecordingSpan>& recordings, std::size_t number) {
  const std::string plain = fmt::format("recording {}", number);
  const bool named = number <= recordings.size() && recordings[number - 1].name != plain;
  return named ? fmt::format("{} ({})", plain, recordings[number - 1].name) : plain;
}

std::string bare(const diagnosis::Shape& s, const std::vector<RecordingSpan>& recordings) {
  using Kind = diagnosis::Shape::Kind;
  switch (s.kind) {
    case Kind::unknown:
      return "";
    case Kind::nothing:
      return "nothing above the noise";
    case Kind::none_simple:
      return "of no simple shape: several effects, or many parameters, may be missing at once";
    case Kind::ramp:
      return recordings.empty() ? "grows evenly with time"
                                : "grows evenly with time in each recording";
    case Kind::decay_from_start:
      return fmt::format("dies away from the start of {} with a time constant of about {:.0f} min",
                         recordings.empty() ? "the test" : "each recording", s.seconds / 60.0);
    case Kind::decay_in_position:
      return fmt::format("dies away within every position with a time constant of about {:.0f} min",
                         s.seconds / 60.0);
    case Kind::onset:
      return onset_text(s.seconds, recordings);
    case Kind::period:
      return s.seconds < 7200.0
                 ? fmt::format("swings with a period of about {:.3g} min", s.seconds / 60.0)
                 : fmt::format("swings with a period of about {:.1f} h", s.seconds / 3600.0);
    case Kind::specific_force:
      return fmt::format("goes with the specific force along {}", "xyz"[s.axis]);
    case Kind::specific_force_square:
      if (s.axis == s.other_axis)
        return fmt::format("goes with the square of the specific force along {}", "xyz"[s.axis]);
      return fmt::format("goes with the product of specific forces along {} and {}", "xyz"[s.axis],
                         "xyz"[s.other_axis]);
    case Kind::one_position:
      return fmt::format("is present in position {} alone", s.position);
    case Kind::one_recording:
      return fmt::format("is present in {} alone",
                         numbered(recordings, static_cast<std::size_t>(s.recording)));
    case Kind::covariate:
      return fmt::format("goes with the recorded {}", s.covariate);
    case Kind::of_cause:
      return "as the cause that is named makes it";
    case Kind::of_alternative:
      return "as the most probable cause makes it";
    case Kind::of_form:
      return "as the form that is proposed";
    case Kind::follows:
      return fmt::format("follows {}", s.covariate);
    case Kind::follows_nothing:
      return "follows neither specific force nor time";
  }
  return "";
}

}  // namespace

TimeUnit time_unit(const std::vector<double>& t) {
  return t.empty() || t.back() - t.front() > 7200.0 ? TimeUnit::hours : TimeUnit::seconds;
}

TimeUnit time_unit(const diagnosis::Diagnosis& d) {
  if (!d.fit.residual_t.empty()) return time_unit(d.fit.residual_t);
  return d.signals.empty() ? TimeUnit::seconds : time_unit(d.signals.front().t);
}

std::string onset_text(double t, const std::vector<RecordingSpan>& recordings, TimeUnit axes) {
  std::size_t k = recordings.size();
  while (k > 0 && t < recordings[k - 1].start_s) --k;
  if (k == 0)
    return fmt::format("sets in at {:.0f} s{} and stays", t,
                       axes == TimeUnit::hours ? fmt::format(" ({:.2f} h)", t / 3600.0) : "");
  const RecordingSpan& r = recordings[k - 1];
  if (k == 1 || t > r.start_s)
    return fmt::format("sets in at {:.0f} s of {} and stays", t - r.offset_s, r.name);
  return fmt::format("is another from {} on", numbered(recordings, k));
}

std::string shape_text(const diagnosis::RecoveredSignal& signal,
                       const std::vector<RecordingSpan>& recordings) {
  using Kind = diagnosis::Shape::Kind;
  const Kind kind = signal.shape.kind;
  const bool by_itself = kind == Kind::period && signal.correlation == 0.0;  // seen by its spectrum
  std::string words = bare(signal.shape, recordings);
  if (kind == Kind::unknown || kind == Kind::nothing || kind == Kind::none_simple ||
      kind == Kind::of_form || kind == Kind::follows_nothing || by_itself)
    return words;
  return kind == Kind::follows ? fmt::format("{} (correlation {:+.2f})", words, signal.correlation)
                               : fmt::format("{} (correlation {:.2f})", words, signal.correlation);
}

}  // namespace drift::report
