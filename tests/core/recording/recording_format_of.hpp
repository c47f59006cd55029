#pragma once

#include "core/config/load.hpp"
#include "core/recording/own/format_config.hpp"

namespace drift::test {

/// What [recording] says, read as a study file's section; the mistakes in it are thrown.
inline RecordingFormat format_of(const std::string& text,
                                 RecordingKind kind = RecordingKind::strapdown) {
  const config::Node root = config::parse_document(text, "study.toml");
  config::Report report("study.toml");
  const auto format = read_recording_format(
      config::Section(report, &root, config::Place{}, "recording"), kind, {"z up", "x up"});
  report.throw_if_wrong();
  return format;
}

}  // namespace drift::test
