#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/identification/identify.hpp"
#include "analysis/report/page/json.hpp"
#include "core/base/weighed_texts.hpp"

namespace drift::report {

/// What is the matter with the input of an estimate, a sentence, and the word that heads it.
struct InputDoubt {
  Weight weight = Weight::wrong;
  std::string_view head;
  std::string text;
};

/// Of a gimbal's zero, instruments of different instants, a loop that filters leave out, numbers of
/// positions that are late or isolated samples. fits: some filter does.
std::vector<InputDoubt> input_doubts(const mc::Study& study,
                                     const identification::Identification& id, bool fits);

/// The same for machines, alike in identification.json and diagnosis.json: `gimbal_zero`, what was
/// said where it was read, or null; `outliers`, a list of isolated samples; `late_labels`, the
/// positions whose numbers are late.
void add_input(Json& document, const std::string& gimbal_zero,
               const std::vector<identification::Spike>& spikes);

}  // namespace drift::report
