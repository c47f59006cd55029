#pragma once

#include <string>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/own/own_terms_config.hpp"

namespace drift::test {

/// Own terms of a text like a study file's, in the library while the object lives.
class OwnTermsHeld {
 public:
  explicit OwnTermsHeld(const std::string& text) {
    const config::Node root = config::parse_document(text, "terms.toml");
    config::Report report("terms.toml");
    config::Section section(report, &root, config::Place{}, "");
    OwnTermSet set = read_own_terms(section);
    report.throw_if_wrong();
    set_own_terms(std::move(set));
  }
  OwnTermsHeld(const OwnTermsHeld&) = delete;
  OwnTermsHeld& operator=(const OwnTermsHeld&) = delete;

 private:
  KeptOwnTerms kept_;
};

/// One section [[term]].
inline std::string own_term(const std::string& key, const std::string& acts_on,
                            const std::string& equation, const std::string& parameters) {
  return "[[term]]\nkey = \"" + key + "\"\nacts_on = \"" + acts_on + "\"\nequation = \"" +
         equation + "\"\nparameters = { " + parameters + " }\n";
}

/// Six terms that use every input, every slot and every function of the equations.
inline std::string own_terms_of_every_kind() {
  return own_term("rumble", "rate.y", "A*sin(2*pi*t/P)*step(abs(f_z) - 0.1) + B*cmd_z/1e-3",
                  "A = { unit = 'deg/h', prior = 0.05 }, B = { unit = 'deg/h', prior = 0.02 }, "
                  "P = { unit = 'min', value = 37, prior = 4 }") +
         own_term("windup", "drift.x",
                  "A*(1 - exp(-t_position/T))*f_I*f_S + B*tanh(temperature/W)*sign(f_O)",
                  "A = { unit = 'deg/h/g^2', prior = 0.05 }, B = { unit = 'deg/h', prior = 0.05 }, "
                  "T = { unit = 'min', value = 5, prior = 1 }, W = { unit = 'K', value = 0.3 }") +
         own_term("warming", "drift.z",
                  "A*temperature_rate + B*(field_x + 2*field_y - field_z) + C*omega_ic_x",
                  "A = { unit = 'deg/h/K*h', prior = 0.05 }, B = { unit = 'deg/h/gauss', prior = "
                  "0.02 }, C = { unit = 'ppm', prior = 100 }") +
         own_term("kink", "accelerometer.y",
                  "K*max(f_x, q)^2 + L*min(f_y, f_z)*sqrt(1.1 + (f_z/q)^2)",
                  "K = { unit = 'ug/g^2', prior = 30 }, L = { unit = 'ppm', prior = 40 }, "
                  "q = { unit = 'g', value = 0.2, prior = 0.05 }") +
         own_term("lobes", "gimbal.inner",
                  "a*cos(n*gimbal_inner + gimbal_outer) + b*atan(2*gimbal_middle) + c*log(1 + t/T)",
                  "a = { unit = 'arcsec', prior = 8 }, b = { unit = 'arcsec', prior = 8 }, "
                  "c = { unit = 'arcsec', prior = 8 }, n = { value = 3, prior = 0.1 }, "
                  "T = { unit = 'h', value = 1, prior = 0.2 }") +
         own_term("corner", "gimbal.outer",
                  "a*tan(gimbal_middle/4) + b*pow(abs(f_x) + 0.1, e) + c*f_y^3*(-f_y)^-0",
                  "a = { unit = 'arcsec', prior = 8 }, b = { unit = 'arcsec', prior = 8 }, "
                  "c = { unit = 'arcsec/g^3', prior = 8 }, e = { value = 1.5, prior = 0.1 }");
}

}  // namespace drift::test
