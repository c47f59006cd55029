#include "analysis/blind/rivals/score_rivals.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "analysis/blind/key.hpp"
#include "analysis/blind/rivals/rival.hpp"
#include "analysis/blind/session/seal.hpp"
#include "mc/task/campaign.hpp"

namespace drift::blind {
namespace {

namespace fs = std::filesystem;

Answer answer_of(const RivalAnswer& said, const RivalTest& test, std::size_t number) {
  Answer out;
  out.number = number;
  out.verdict = !said.alarm          ? diagnosis::Verdict::consistent
                : said.named.empty() ? diagnosis::Verdict::unexplained
                                     : diagnosis::Verdict::named;
  for (const std::size_t k : said.named) {
    const inference::Candidate& c = test.examined.set.candidates[k];
    out.causes.push_back({c.term, c.axis, 0, 1.0, {}});
  }
  return out;
}

/// What every rival says to one trial.
std::vector<Answer> answers_to(const fs::path& trial, std::size_t number, double alpha) {
  const RivalTest test =
      rival_test((trial / "study.toml").string(), (trial / "recording.csv").string());
  std::vector<Answer> out;
  for (const Rival& rival : rivals())
    out.push_back(answer_of(rival.answer(test, alpha), test, number));
  return out;
}

}  // namespace

RivalScore rival_score(std::string name, const std::vector<TrialScore>& scores) {
  struct Count {
    std::size_t k = 0, n = 0;
    void add(bool hit) {
      k += hit;
      ++n;
    }
    stats::Proportion share() const { return stats::proportion(k, n); }
  };
  Count nothing, noise, detected, right, among, wrong;
  for (const TrialScore& s : scores) {
    const Stratum stratum = s.key.plan.stratum;
    if (stratum == Stratum::null) {
      nothing.add(s.false_alarm);
    } else if (stratum == Stratum::wrong_noise) {
      noise.add(s.false_alarm);
    } else {
      detected.add(s.detected);
    }
    if (stratum != Stratum::single) continue;
    right.add(s.exact);
    among.add(s.extra);
    wrong.add(s.confidently_wrong);
  }
  return {std::move(name), nothing.share(), noise.share(), detected.share(),
          right.share(),   among.share(),   wrong.share()};
}

std::vector<RivalScore> score_rivals(const std::string& folder, double alpha, int threads) {
  const std::vector<KeyEntry> keys = read_key(open_sealed(folder, "key.json")).entries;
  const auto answers = mc::run_campaign(
      keys.size(),
      [&](std::size_t k) {
        const std::size_t number = keys[k].plan.number;
        return answers_to(fs::path(folder) / fmt::format("trials/{:04}", number), number, alpha);
      },
      threads);
  std::vector<RivalScore> out;
  const std::vector<Rival> all = rivals();
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::vector<TrialScore> scores;
    for (std::size_t k = 0; k < keys.size(); ++k)
      scores.push_back(score_trial(keys[k], answers[k][r]));
    out.push_back(rival_score(all[r].name, scores));
  }
  return out;
}

}  // namespace drift::blind
