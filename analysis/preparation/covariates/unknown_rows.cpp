#include "analysis/preparation/covariates/unknown_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/base/words.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/term_library.hpp"

namespace drift::preparation {
namespace {

/// Terms that follow a covariate.
struct Followers {
  std::vector<std::string> keys;
  bool drive = false;  ///< one of them acts on the platform's rate
};

Followers followers(const TermMask& terms, CovariateSet set) {
  Followers found;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (!terms[t] || (term.needs.covariates & set) == 0) continue;
    found.keys.emplace_back(term.key);
    found.drive = found.drive || term.in_rates;
  }
  return found;
}

using Rows = std::vector<bool>;

/// Rows of a recording that hang on a covariate where it is not known.
class Lost {
 public:
  Lost(const Recording& r, const TestPlan& plan, CovariateSet set) : r_(r), plan_(plan) {
    unknown_.assign(r.rows(), false);
    for (const FollowedColumn& column : followed_columns()) {
      const Channel* c = r.find(column.name);
      if ((column.set & set) == 0 || c == nullptr) continue;
      if (std::ranges::none_of(c->values, [](double x) { return std::isfinite(x); })) continue;
      for (std::size_t row = 0; row < r.rows(); ++row)
        if (!std::isfinite(c->values[row])) unknown_[row] = true;
    }
  }

  bool any() const { return std::ranges::find(unknown_, true) != unknown_.end(); }

  Rows rows(bool drive) const {
    Rows lost(unknown_.size());
    bool adrift = false;
    for (std::size_t row = 0; row < unknown_.size(); ++row) {
      adrift = unknown_[row] || (adrift && !caged(row));
      lost[row] = unknown_[row] || (row > 0 && unknown_[row - 1]) || (drive && adrift);
    }
    return lost;
  }

 private:
  bool caged(std::size_t row) const {
    const std::vector<double>& numbers = r_.find("position")->values;
    if (row > 0 && numbers[row] == numbers[row - 1]) return false;
    const auto number = static_cast<std::size_t>(std::max(1.0, numbers[row]));
    return number > plan_.positions.size() || plan_.positions[number - 1].entry == Entry::caged;
  }

  const Recording& r_;
  const TestPlan& plan_;
  Rows unknown_;
};

std::size_t how_many(const Rows& rows) {
  return static_cast<std::size_t>(std::ranges::count(rows, true));
}

void not_measured(Recording& r, const Rows& rows) {
  for (Channel& c : r.channels)
    if (c.name.starts_with("acc_") || c.name.starts_with("gimbal_"))
      for (std::size_t row = 0; row < rows.size(); ++row)
        if (rows[row]) c.values[row] = std::numeric_limits<double>::quiet_NaN();
}

bool anything_measured(const Recording& r) {
  return std::ranges::any_of(r.channels, [](const Channel& c) {
    return (c.name.starts_with("acc_") || c.name.starts_with("gimbal_")) &&
           std::ranges::any_of(c.values, [](double x) { return std::isfinite(x); });
  });
}

/// "temperature_drift follows it"
std::string follow_text(const std::vector<std::string>& keys) {
  if (keys.empty()) return "terms that are looked for follow it";
  return fmt::format("{} follow{} it", listed(keys, "and"), keys.size() == 1 ? "s" : "");
}

std::string missing_text(const std::string& source, const ColumnGaps& g) {
  return fmt::format(
      "{}: {} has no reading in {} of {} rows ({:.3g} min, at a stretch {:.3g} min from line {} "
      "on)",
      source.empty() ? "recording" : source, g.column.name, g.rows, g.of, g.seconds / 60.0,
      g.longest / 60.0, g.line);
}

/// What stands in the rows that have no reading.
std::string filled_text(const ColumnGaps& g) {
  const std::string line = "straight lines, at an end the nearest reading";
  if (g.unknown == 0) return fmt::format(": {}, no farther from one than is usual", line);
  const std::string far = "farther from one than is usual, so that it is not known there";
  if (g.unknown == g.rows) return fmt::format(": {}", far);
  return fmt::format(": in {} {}; {} are {}", g.rows - g.unknown, line, g.unknown, far);
}

/// One covariate, in all recordings.
class Unknown {
 public:
  Unknown(const mc::Study& study, std::vector<Recording>& recordings,
          const std::vector<std::vector<ColumnGaps>>& gaps, CovariateSet set)
      : recordings_(recordings), gaps_(gaps), set_(set) {
    for (const Recording& r : recordings) lost_.emplace_back(r, study.plan, set);
  }

  bool any() const {
    return std::ranges::any_of(lost_, [](const Lost& l) { return l.any(); });
  }

  /// Whether most rows are left.
  bool most_left(bool drive) const {
    std::size_t lost = 0, all = 0;
    for (std::size_t k = 0; k < lost_.size(); ++k) {
      lost += how_many(lost_[k].rows(drive));
      all += recordings_[k].rows();
    }
    return 2 * lost < all;
  }

  /// Says what is missing of every recording, its number's `what` behind it.
  template <class What>
  void say(std::vector<std::string>& remarks, What&& what) const {
    for (std::size_t k = 0; k < recordings_.size(); ++k)
      for (const ColumnGaps& g : gaps_[k])
        if ((g.column.set & set_) != 0)
          remarks.push_back(fmt::format("{}{}; {}", missing_text(recordings_[k].source, g),
                                        filled_text(g), what(k)));
  }

  void leave_out(const Followers& who, const std::vector<std::string>& named,
                 std::vector<std::string>& remarks) {
    std::vector<Rows> rows;
    for (const Lost& l : lost_) rows.push_back(l.rows(who.drive));
    say(remarks, [&](std::size_t k) {
      const std::size_t lost = how_many(rows[k]);
      if (lost == 0) return follow_text(named);
      return fmt::format(
          "{} of {} rows are left out of the fit{}, for {}", lost, recordings_[k].rows(),
          who.drive ? ", up to where the platform is caged anew" : "", follow_text(named));
    });
    for (std::size_t k = 0; k < rows.size(); ++k) not_measured(recordings_[k], rows[k]);
    if (std::ranges::none_of(recordings_, anything_measured))
      throw InputError(
          ExitCode::recording,
          fmt::format("{}{}: then no row is left (expected readings from the beginning, and "
                      "wherever the attitude is carried on). Give what is behind the gap as a "
                      "recording of its own, or leave the term out",
                      remarks.back(), recordings_.size() > 1 ? " (and so of the others)" : ""));
  }

  UnusedCovariate take_out(std::vector<std::string>& remarks) {
    say(remarks, [](std::size_t) {
      return std::string(
          "for what follows it most rows would have to be left out, so it is taken as not "
          "recorded");
    });
    std::vector<std::string> names;
    for (const FollowedColumn& column : followed_columns()) {
      if ((column.set & set_) == 0) continue;
      names.push_back(column.name);
      for (Recording& r : recordings_)
        std::erase_if(r.channels, [&](const Channel& c) { return c.name == column.name; });
    }
    return {set_, fmt::format("{} lacks readings in so many rows that it is not used",
                              listed(names, "and"))};
  }

 private:
  std::vector<Recording>& recordings_;
  const std::vector<std::vector<ColumnGaps>>& gaps_;
  CovariateSet set_ = 0;
  std::vector<Lost> lost_;
};

}  // namespace

std::vector<UnusedCovariate> leave_out_unknown(const mc::Study& study,
                                               std::vector<Recording>& recordings,
                                               const std::vector<std::vector<ColumnGaps>>& gaps,
                                               Following following,
                                               std::vector<std::string>& remarks) {
  TermMask fitted, all;
  for (const FilterSpec& filter : study.filters) {
    fitted |= filter.model().terms;
    if (following == Following::library) break;
  }
  all = fitted;
  if (following == Following::library) all.set();
  CovariateSet sets = 0;
  for (const std::vector<ColumnGaps>& of_one : gaps)
    for (const ColumnGaps& g : of_one) sets |= g.column.set;
  std::vector<UnusedCovariate> unused;
  for (CovariateSet set = 1; set != 0 && set <= sets; set <<= 1) {
    const Followers who = followers(fitted, set), any = followers(all, set);
    if ((sets & set) == 0 || any.keys.empty()) continue;
    Unknown unknown(study, recordings, gaps, set);
    if (!unknown.any() || unknown.most_left(any.drive))
      unknown.leave_out(any, who.keys, remarks);
    else if (!who.keys.empty())
      unknown.leave_out(who, who.keys, remarks);
    else
      unused.push_back(unknown.take_out(remarks));
  }
  return unused;
}

}  // namespace drift::preparation
