#include "analysis/report/page/wording.hpp"

#include "core/recording/recording_channels.hpp"

namespace drift::report {
namespace {

/// " of b.csv" of a recording by its number, from 1.
std::string of_named_recording(const RecordingNames& recordings, std::size_t number) {
  return number == 0 || number > recordings.size() ? "" : " of " + recordings[number - 1];
}

/// What hangs on when the platform was turned, two sentences.
std::string gap_text(const identification::MemoryGaps& gaps, const RecordingNames& recordings) {
  constexpr double beyond_words = 0.01;  // a factor that says no more than "nothing is known"
  const MemoryOverGap& g = gaps.widest;
  const std::string more =
      gaps.count > 1 ? fmt::format(" (and before {} more)", gaps.count - 1) : "";
  const std::string factor =
      g.left < beyond_words ? "more than 100" : fmt::format("{:.3g}", 1.0 / g.left);
  return fmt::format(
      "Between positions {} and {}{}{}, {:.3g} min are not recorded; that the platform was turned "
      "at "
      "their beginning is assumed. If at their end, {} would be {} times smaller, and what is "
      "found beside it may be none.",
      g.from + 1, g.to + 1, of_named_recording(recordings, g.recording), more, g.length / 60.0,
      g.term, factor);
}

}  // namespace

std::string parameter_key(std::size_t param) {
  return std::string(TermLibrary::specs[param].key.view());
}

std::string parameter_key(const Layout& layout, std::size_t state) {
  return parameter_key(layout.params[state]);
}

std::string parameter_unit(std::size_t param) {
  return std::string(TermLibrary::specs[param].unit.symbol.view());
}

double unit_of(std::size_t param) {
  return TermLibrary::specs[param].unit.to_si;
}

Cell parameter_cell(std::size_t param) {
  return {parameter_key(param),
          fmt::format("{} [{}]", parameter_key(param), parameter_unit(param))};
}

std::string spike_channel(const identification::Spike& spike) {
  const ChannelTriple& triple = spike.channel < 3 ? accelerometer_channels : gimbal_channels;
  return std::string(triple.names[static_cast<std::size_t>(spike.channel % 3)]);
}

std::string spikes_text(const std::vector<identification::Spike>& spikes,
                        const RecordingNames& recordings) {
  constexpr std::size_t most = 2;
  std::vector<std::string> places;
  for (const identification::Spike& s : spikes)
    places.push_back(fmt::format("{} in position {} at {:.6g} s{}", spike_channel(s), s.position,
                                 s.t, of_named_recording(recordings, s.recording)));
  return places.empty() ? "" : fmt::format(" ({})", listed_up_to(places, most));
}

std::string late_labels_text(const std::vector<identification::Spike>& spikes,
                             const RecordingNames& recordings) {
  const std::size_t positions = identification::late_labels(spikes);
  return positions == 0
             ? ""
             : fmt::format(
                   "In the last row of {} positions, and in no other, readings stand out{}, as "
                   "they "
                   "do where the numbers of the positions change a row too late. Put them a row "
                   "earlier, or leave these rows out.",
                   positions, spikes_text(spikes, recordings));
}

std::string common_scale_text(const identification::CommonScale& common) {
  const bool larger = common.value > 0.0;
  return fmt::format(
      "K1_x, K1_y and K1_z are {} alike: of readings in m/s^2 a site.gravity that is {} % too {} "
      "does that.",
      larger ? "larger" : "smaller", with_sigma(std::abs(common.value) * 1e2, common.sigma * 1e2),
      larger ? "small" : "large");
}

std::string gravity_next(std::string_view command) {
  return fmt::format("Next: correct site.gravity, or the unit of the accelerometers, and {} again.",
                     command);
}

std::string field_assumed_text(const Vec3& field_l) {
  const Vec3 gauss = field_l / "gauss"_unit.to_si;
  return fmt::format(
      "The magnetic field was neither recorded nor declared: that of a dipole is taken, {:.3f} "
      "gauss North and {:.3f} gauss Up. Declare field_n, field_w, field_u in [environment] if a "
      "magnetic effect is in question",
      gauss.x(), gauss.z());
}

std::string memory_text(const std::vector<MemoryLeftOut>& doubt) {
  std::vector<std::string> terms;
  for (const MemoryLeftOut& one : doubt)
    terms.push_back(fmt::format("{} ({:.0f} %)", one.term, 1e2 * one.part));
  return fmt::format(
      "memory of {} is that of the nominal path: on the platform's own, where drift turns it, it "
      "differs by so much (rms), and amplitudes of it are wrong by up to as much. It is less where "
      "commands take the drift away",
      listed(terms, "and"));
}

std::string memory_sentences(const std::vector<MemoryLeftOut>& doubt,
                             const std::vector<identification::MemoryGaps>& gaps,
                             const RecordingNames& recordings) {
  std::vector<std::string> all;
  if (!doubt.empty()) all.push_back("The " + memory_text(doubt) + ".");
  for (const identification::MemoryGaps& g : gaps) all.push_back(gap_text(g, recordings));
  return fmt::format("{}", fmt::join(all, " "));
}

std::string_view plural(std::size_t count) {
  return count == 1 ? "" : "s";
}

}  // namespace drift::report
