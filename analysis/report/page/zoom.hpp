#pragma once

#include <string>
#include <string_view>

namespace drift::report {

/// What makes figures of a page zoomable: dygraphs of the machine it was built on, and ours. Empty
/// where dygraphs was not installed.
std::string_view zoom_script();
std::string_view zoom_style();

/// "sha256-..." of a script, by which a page's policy lets it and no other run.
std::string policy_of(std::string_view script);

}  // namespace drift::report
