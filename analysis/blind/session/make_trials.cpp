#include "analysis/blind/session/make_trials.hpp"

#include <fmt/format.h>

#include "analysis/blind/key.hpp"
#include "analysis/blind/session/counter.hpp"
#include "analysis/blind/session/seal.hpp"
#include "core/base/check.hpp"
#include "core/base/file_text.hpp"
#include "core/base/results/register.hpp"
#include "core/base/sha256.hpp"
#include "core/recording/recording_output.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

std::string part_name(std::size_t number) {
  return fmt::format("making/{:04}.json", number);
}

bool is_sealed(const std::string& folder) {
  return !published_hash(folder, "key.json").empty();
}

/// What the key says of a trial that is made, noted when the trial was complete.
std::optional<KeyEntry> kept_entry(const std::string& folder, std::size_t number) {
  const auto text = file_text(fs::path(folder) / part_name(number));
  if (!text || !ResultsRegister(folder).has(part_name(number), sha256_hex(*text)))
    return std::nullopt;
  return read_key(*text).entries.at(0);
}

/// What the solver gets. Two workers may write the same trial: they write the same bytes. Returns
/// what the key says of it.
std::string write_trial(const TrialSource& source, const TrialPlan& plan,
                        const std::string& folder) {
  const std::string name = trial_name(plan.number);
  const fs::path here = fs::path(folder) / name;
  const ResultsFolder results = results_in(folder);
  write_files(results, {{name + "/study.toml", source.nominal_text(plan)}});
  const MadeTrial made = source.make(mc::read_study((here / "study.toml").string()), plan);
  write_result(results, name + "/recording.csv", [&](const std::string& temporary) {
    write_recording_to(made.recording, (here / "recording.csv").string(), temporary);
  });
  return to_json(Key{"", {made.key}});
}

void make_one(const TrialSource& source, const TrialPlan& plan, const std::string& folder) {
  const std::string name = trial_name(plan.number);
  remove_result(results_in(folder), name + "/answer.json");  // to a key that is there no more
  fs::remove(fs::path(folder) / name / "crashes");
  write_files(results_in(folder), {{part_name(plan.number), write_trial(source, plan, folder)}});
}

void make_missing(const TrialSource& source, const std::string& folder,
                  const std::vector<TrialPlan>& plans, const mc::WorkSession& session,
                  const Progress& progress) {
  std::vector<std::size_t> missing;
  for (const std::size_t k : mc::own_part_first(plans.size(), session.share))
    if (!kept_entry(folder, plans[k].number)) missing.push_back(k);
  Counter counter(plans.size() - missing.size(), plans.size(), progress);
  mc::work_through(missing, session, [&](std::size_t k) {
    // Another worker may have come here first.
    if (!is_sealed(folder) && !kept_entry(folder, plans[k].number))
      make_one(source, plans[k], folder);
    counter.step();
  });
}

/// The key of all trials, or nothing while one is missing.
std::optional<Key> whole_key(const mc::Study& study, const std::string& folder,
                             const std::vector<TrialPlan>& plans) {
  Key key{salt_of(study.monte_carlo.seed), {}};
  for (const TrialPlan& plan : plans) {
    auto entry = kept_entry(folder, plan.number);
    if (!entry) return std::nullopt;
    key.entries.push_back(std::move(*entry));
  }
  return key;
}

/// Takes away the parts that the key was made of, and their folder unless somebody else put
/// something there.
void remove_parts(const mc::Study& study, const std::string& folder) {
  const ResultsRegister known(folder);
  std::error_code none;
  for (std::size_t number = 1; number <= study.blind.all_trials(); ++number) {
    const fs::path part = fs::path(folder) / part_name(number);
    if (known.has(part_name(number), sha256_hex_of_file(part.string()))) fs::remove(part, none);
  }
  fs::remove(fs::path(folder) / "making", none);
}

}  // namespace

std::optional<std::string> make_trials(const TrialSource& source, const std::string& folder,
                                       const mc::WorkSession& session, const Progress& progress) {
  const mc::Study& study = source.study();
  open_trials(source, folder);
  while (!is_sealed(folder)) {
    const std::vector<TrialPlan> plans = source.plans();
    make_missing(source, folder, plans, session, progress);
    if (const auto key = whole_key(study, folder, plans))
      write_sealed(folder, "key.json", to_json(*key));
    else if (session.time.is_over())
      return std::nullopt;
  }
  open_sealed(folder, "key.json");
  remove_parts(study, folder);
  return published_hash(folder, "key.json");
}

void restore_trials(const TrialSource& source, const std::string& folder, bool answered_too) {
  const fs::path here(folder);
  std::vector<std::size_t> gone;
  for (std::size_t number = 1; number <= source.study().blind.all_trials(); ++number)
    if (!is_there(here, number) && (answered_too || !is_answered(here, number)))
      gone.push_back(number);
  if (gone.empty()) return;
  const std::vector<TrialPlan> plans = source.plans();
  const Key key = read_key(open_sealed(folder, "key.json"));
  for (const std::size_t number : gone)
    if (write_trial(source, plans.at(number - 1), folder) !=
        to_json(Key{"", {key.entries.at(number - 1)}}))
      throw InputError(ExitCode::self_check,
                       fmt::format("{}: was gone, and what is made in its place is not what the "
                                   "key says (expected the same). Put it back, or make the trials "
                                   "anew in another folder",
                                   (here / trial_name(number)).string()));
}

}  // namespace drift::blind
