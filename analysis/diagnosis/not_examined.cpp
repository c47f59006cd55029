#include "analysis/diagnosis/not_examined.hpp"

#include <algorithm>

namespace drift::diagnosis {
namespace {

using Why = NotExamined::Why;

/// Whether what a term does hangs on the specific force.
bool feels_force(const TermInfo& term) {
  TermMask mask;
  mask.set(*TermLibrary::find_term(term.key));
  Theta theta = Theta::Zero();
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const Prior prior = TermLibrary::specs[i].prior_si();
    theta[i] = prior.mean() + prior.sigma();
  }
  const std::vector<double> memory(TermLibrary::num_memory + 1, 0.5);
  const Mounting mounting;
  Surroundings<double> around{
      {5000.0, 1000.0, false, 0.3, Vec3(5e-5, 0.0, 5e-5), 0.7, Vec3(2e-5, 0.0, -4e-5)},
      Mat3::Identity(),
      Vec3(0.5, -0.4, 1.1),
      memory.data()};
  const auto added = [&](const Vec3& f_p) {
    const Inputs<double> in{&mounting, f_p, Vec3(3e-5, -5e-5, 4e-5), Vec3::Zero(), &around};
    RateAssembly<double> rates;
    ReadoutAssembly<double> readout{Vec3::Zero()};
    TermLibrary::rates(mask, in, theta.data(), rates);
    TermLibrary::readout(mask, in, theta.data(), readout);
    Vec3 sum = rates.omega_drift_g + rates.omega_torque_g + rates.omega_ip_p + readout.acc;
    return sum;
  };
  return added(Vec3(0.48, -0.36, 0.80)) != added(Vec3(-0.60, 0.64, 0.48));
}

/// Whether a term's trace in time is the clock's, on instruments of the same kind: what the other
/// follows may have moved in the same way. What grows with the specific force in one must do so in
/// the other.
bool by_the_clock(const TermInfo& cause, const TermInfo& unseen) {
  return cause.needs.clock && cause.subsystem == unseen.subsystem &&
         cause.in_rates == unseen.in_rates && cause.in_readout == unseen.in_readout &&
         feels_force(cause) == feels_force(unseen);
}

std::vector<NamedEffect> twins_of(const TermInfo& unseen,
                                  const std::vector<search::Cause>& causes) {
  std::vector<NamedEffect> twins;
  for (const search::Cause& c : causes)
    if (by_the_clock(TermLibrary::terms[*TermLibrary::find_term(c.term)], unseen))
      twins.push_back({c.term, c.axis, search::keyed(c.term, c.axis)});
  return twins;
}

}  // namespace

std::vector<NotExamined> not_examined(const search::Fitted& nominal,
                                      const std::vector<search::Cause>& causes) {
  std::vector<NotExamined> out;
  for (const std::size_t t : nominal.set.without_covariate) {
    const TermInfo& term = TermLibrary::terms[t];
    const Why why = term.needs.temperature ? Why::no_temperature
                    : term.needs.field     ? Why::no_field
                                           : Why::no_covariate;
    out.push_back({std::string(term.key), why, twins_of(term, causes)});
  }
  for (const TermInfo& term : TermLibrary::terms) {
    if (term.key == closure_term) continue;  // judged by the jump to the other equation
    bool tried = false, seen = false;
    for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k)
      if (nominal.set.candidates[k].term == term.key) {
        tried = true;
        seen = seen || nominal.scores[k].dof > 0;
      }
    if (tried && !seen) out.push_back({std::string(term.key), Why::beyond_reach, {}});
  }
  return out;
}

}  // namespace drift::diagnosis
