#pragma once

// What sections are written with.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/identification/common_scale.hpp"
#include "analysis/identification/memory_doubt.hpp"
#include "analysis/identification/spikes.hpp"
#include "analysis/report/page/report.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/estimate/layout.hpp"
#include "core/physics/coupling.hpp"

namespace drift::report {

/// Key of a parameter of TermLibrary, or of the state of a layout: "D_I_z".
std::string parameter_key(std::size_t param);
std::string parameter_key(const Layout& layout, std::size_t state);

/// Symbol of a parameter's unit, "deg/h/g", and how much of SI it is.
std::string parameter_unit(std::size_t param);
double unit_of(std::size_t param);

/// "D_I_z [deg/h/g]"; for machines the key.
Cell parameter_cell(std::size_t param);

/// How each of several recordings is called, where something that is told lies in one of them;
/// empty of one recording, which needs no name.
using RecordingNames = std::vector<std::string>;

/// The channel of an isolated sample, "gimbal_outer".
std::string spike_channel(const identification::Spike& spike);
/// Where isolated samples are: " (acc_y in position 3 at 5400 s of b.csv, gimbal_outer ... and 2
/// more)". Empty of none.
std::string spikes_text(const std::vector<identification::Spike>& spikes,
                        const RecordingNames& recordings = {});
/// That they are those of late numbers of positions, a sentence; empty where they are not.
std::string late_labels_text(const std::vector<identification::Spike>& spikes,
                             const RecordingNames& recordings = {});
/// A sentence on what would move the three K1 alike.
std::string common_scale_text(const identification::CommonScale& common);
/// What to do about it, before the command is repeated.
std::string gravity_next(std::string_view command);

/// That the magnetic field is taken to be that of a dipole, a sentence. field_l: local axes [T].
std::string field_assumed_text(const Vec3& field_l);
/// "memory of stiction (154 %) is that of the nominal path: ...", without an article before it and
/// a full stop behind: of memory_doubt(), which is not empty.
std::string memory_text(const std::vector<MemoryLeftOut>& doubt);
/// The same and what gaps leave open, whole sentences; empty of nothing.
std::string memory_sentences(const std::vector<MemoryLeftOut>& doubt,
                             const std::vector<identification::MemoryGaps>& gaps,
                             const RecordingNames& recordings = {});

/// "" of 1, else "s".
std::string_view plural(std::size_t count);

}  // namespace drift::report
