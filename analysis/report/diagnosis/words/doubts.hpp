#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/report/diagnosis/words/instrument.hpp"
#include "analysis/report/page/json.hpp"

namespace drift::report {

/// "The fit takes M_y 6.1 prior sigmas from its prior, ...: the prior is wrong, or ...".
std::string beyond_prior_text(const diagnosis::remark::BeyondPrior& beyond);

/// "the prior of K0_x", where with wider ones nothing is missing; empty where something is, or
/// nothing stands out.
std::string priors_at_fault_text(const diagnosis::Diagnosis& diagnosis);
/// The verdict's sentence where they are told, with the causes that it may be instead.
std::string wrong_priors_text(const diagnosis::Diagnosis& diagnosis);
/// What follows it of the noise, which is there besides, or in the place of wrong priors. noise: as
/// it is told, empty where it is as declared.
std::string beside_priors_text(const diagnosis::Diagnosis& diagnosis, const std::string& noise);
/// "the prior of K3_x", where the causes are told with room in it; else empty.
std::string priors_taken_text(const diagnosis::Diagnosis& diagnosis);
/// "the prior of eta_x is wrong, and hang-off of the platform (hang_off.outer) is missing".
std::string other_priors_text(const diagnosis::remark::OtherPriors& remark, Instrument instrument);

/// ", but the fit takes K1_x, K1_y, K1_z up to 20.0 prior sigmas from their priors: ...", for a
/// recording that is consistent otherwise; empty where no parameter lies too far from its prior.
std::string but_far_from_priors(const diagnosis::Diagnosis& diagnosis);

/// Columns of commands whose torquers' scale the fit takes to -2 within 5 sigma of fit and prior
/// together: a gain of -1, which is no scale but the sign of the column.
std::vector<std::string> reversed_commands(const diagnosis::Diagnosis& diagnosis);

/// A verdict of its own: nothing that is said of causes holds for another place on the Earth.
std::string site_text(const identification::LatitudeDoubt& doubt);
/// The same where the test was diagnosed at that latitude (Diagnosis::there).
std::string site_and_more_text(const identification::LatitudeDoubt& doubt);

/// The same of a plan whose positions headed otherwise.
std::string heading_text(const identification::HeadingDoubt& doubt);

/// Whether samples were left out because the numbers of their positions are late.
bool labels_are_late(const diagnosis::Diagnosis& diagnosis);

/// What a reader must hear with the verdict, whatever it is: a loop, parameters of the model far
/// from their priors, memory of another path than the platform's or of a gap, isolated samples that
/// were left out, and a magnetic field that was assumed where a cause or such a parameter hangs on
/// it. Sentences with the word that heads each. Parameters far from their priors are in the short
/// answer whatever the verdict is.
std::vector<std::pair<std::string, std::string>> doubts_of(const diagnosis::Diagnosis& diagnosis);
inline constexpr std::string_view beyond_its_prior = "Prior";  ///< heads that sentence
/// Heads the first of them, of a loop that the nominal model leaves out: whatever the verdict is.
inline constexpr std::string_view loop_left_out = "Loop";

/// Times that alone keep the only cause from being named: the verdict says so. Null otherwise.
const diagnosis::remark::TimesInstead* times_beside_cause(const diagnosis::Diagnosis& diagnosis);

/// What the input may be instead of the only cause that was found, "accelerometers and gimbals of
/// different instants leave as little"; "" if nothing is.
std::string input_instead_text(const diagnosis::Diagnosis& diagnosis);

/// `instants` of diagnosis.json, as of identification.json, with the odds against causes.
Json instants_json(const diagnosis::Diagnosis& diagnosis);

/// That accelerometers and gimbals are of different instants, with a blank behind it; or "".
std::string instants_text(const diagnosis::Diagnosis& diagnosis);

/// `beyond_prior` of diagnosis.json: one object for each such parameter.
Json beyond_prior_json(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
