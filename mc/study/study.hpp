#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/physics/earth.hpp"
#include "core/physics/model_spec.hpp"
#include "core/physics/own/own_term.hpp"
#include "core/plan/environment.hpp"
#include "core/plan/readout.hpp"
#include "core/plan/test_plan.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"
#include "mc/study/blind_spec.hpp"
#include "mc/study/monte_carlo.hpp"

namespace drift::mc {

/// One line of [sweep]: a dotted key of the study file and the values it takes, as TOML text.
struct SweepAxis {
  std::string key;
  std::vector<std::string> values;
};

/// Results from elsewhere, printed beside ours: [[published]] of a study file.
struct Published {
  struct Value {
    std::size_t param = 0;
    std::vector<double> values, sigmas;  ///< SI; sigmas may be empty
  };
  std::string name;    ///< "Table 1 of the paper"
  std::string filter;  ///< the filter they are compared with; empty: with all (an independent test)
  std::vector<Value> values;
};

/// A value of the resolved study, for `check`: where it stands, what it is, where it came from.
struct Resolved {
  std::string key;     ///< "truth.parameters.eta_x"
  std::string value;   ///< "normal(112, 20) arcsec"
  std::string origin;  ///< "study.toml:12", "--set", both ("study.toml:12 and --set"), "default",
                       ///< "default prior"
};

/// `--set key=value` of the command line.
using Overrides = std::vector<std::pair<std::string, std::string>>;

/// A study file, read, checked and converted to internal units.
struct Study {
  std::string path;
  Overrides overrides;  ///< with which it was read
  std::string text;     ///< the file as TOML with the overrides of the command line in it
  std::string title;
  Site site;
  RecordingKind kind = RecordingKind::platform;
  TestPlan plan;            ///< of a platform test
  double static_min = 2.0;  ///< strapdown: shortest dwell that counts, as DwellOptions has it [s]
  bool accelerometers_in_turns = false;  ///< strapdown: what they read in turns counts, too
  Readout readout;
  RecordingFormat recording;  ///< how files are read that do not have the canonical columns
  Environment environment;
  TruthSpec truth;
  bool has_truth = false;  ///< [truth] is in the file; without it there is nothing to simulate
  std::vector<FilterSpec> filters;
  MonteCarlo monte_carlo;
  std::vector<SweepAxis> sweep;
  std::vector<Published> published;
  BlindSpec blind;
  bool has_blind = false;  ///< [blind] is in the file
  std::vector<Resolved> resolved;
  /// Its [[term]], as they were put into the library when it was read; null: made by hand, with
  /// those that are there.
  std::shared_ptr<const OwnTermSet> own_terms = {};
};

/// Whether lines of [sweep] that change nothing are mistakes: results that were made with one, by
/// an earlier version, stay what they are.
enum class IdleAxes { refused, taken };

/// Reads a study file. InputError (config) lists every mistake in it, each with file:line:col, what
/// is wrong, what was expected, and the nearest valid key where one was meant.
///
/// A process holds one set of own terms, [[term]]: those of a study take the places of those of the
/// study read before, with which nothing is computed from then on (require_own_terms()): it is read
/// again, or the others are read while its terms are kept (KeptOwnTerms). No study is read while
/// another thread computes. Where an error is thrown the terms are as they were.
Study read_study(const std::string& path, const Overrides& overrides = {},
                 IdleAxes idle = IdleAxes::refused);
/// The same of a text that stands elsewhere; `path` is what errors name.
Study read_study_text(std::string_view text, const std::string& path,
                      const Overrides& overrides = {}, IdleAxes idle = IdleAxes::refused);

/// Reads a study from a tree without trying its sweep; `text` is left empty. The same errors.
Study read_study_tree(const config::Node& root, const std::string& path);

/// Puts one value of a sweep in its place; of a table its keys, what else is in the section stays
/// (apply_overlay). Where it is of truth.coupling, what only other couplings use goes:
/// [truth.servo], [truth.loop] and truth.parameters.lambda. InputError (config) as apply_override.
void apply_sweep_value(config::Node& root, const std::string& key, const std::string& value);

}  // namespace drift::mc
