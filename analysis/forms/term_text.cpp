#include "analysis/forms/term_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/number_text.hpp"

namespace drift::forms {
namespace {

using Where = AttitudePart::Kind;
using When = TimePart::Kind;

constexpr const char* gimbals[] = {"outer", "middle", "inner"};

/// What stands behind the amplitude; a pair has its amplitudes in it.
std::string where_text(const AttitudePart& part, const Instants& at) {
  const char axis = part.of.empty() ? ' ' : "xyz"[part.of.front() % 3];
  switch (part.kind) {
    case Where::product: {
      std::vector<std::string> factors;
      for (const std::size_t q : part.of) factors.push_back(at.quantities[q].text);
      return fmt::format("{}", fmt::join(factors, "*"));
    }
    case Where::saturation:
      return fmt::format("tanh(f_{}/S)", axis);
    case Where::harmonic: {
      const std::string angle =
          fmt::format("{}gimbal_{}", part.order > 1 ? fmt::format("{}*", part.order) : "",
                      gimbals[part.of.front()]);
      return fmt::format("(A*cos({0}) + B*sin({0}))", angle);
    }
    case Where::above:
      return fmt::format("step(f_{} - C)", axis);
    case Where::below:
      return fmt::format("step(C - f_{})", axis);
    case Where::beyond:
      return fmt::format("step(abs(f_{}) - C)", axis);
    case Where::one:
      break;
  }
  return "";
}

std::string when_text(const TimePart& part) {
  switch (part.kind) {
    case When::power:
      return part.order == 1 ? "(t/3600)" : "(t/3600)^2";
    case When::decay:
      return "exp(-t/T)";
    case When::decay_in_position:
      return "exp(-t_position/T)";
    case When::harmonic:
      return "(A*cos(2*pi*t/P) + B*sin(2*pi*t/P))";
    case When::onset:
      return "step(t - T0)";
    case When::window:
      return "step(t - T0)*step(T1 - t)";
    case When::one:
      break;
  }
  return "";
}

/// A number of figures 1, 2 or 5 that is no less.
double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double figure : {1.0, 2.0, 5.0})
    if (value <= figure * power) return figure * power;
  return 10.0 * power;
}

/// A setting in its unit, with the digits it is known to; where a fit may move it with its sigma.
std::string setting_text(const std::string& name, const Unit& unit, double value, double sigma,
                         bool moved) {
  const double v = value / unit.to_si, s = sigma / unit.to_si;
  const std::string known = s > 0.0 ? to_match(v, s) : number_text(v, 4);
  return fmt::format("{} = {{ unit = \"{}\", value = {}{} }}", name, unit.symbol.view(), known,
                     moved && s > 0.0 ? ", prior = " + number_text(s, 2) : "");
}

std::vector<std::string> setting_texts(const Form& form) {
  std::vector<std::string> all;
  const AttitudePart& where = form.where;
  const TimePart& when = form.when;
  if (where.kind == Where::saturation)
    all.push_back(setting_text("S", unit::g, where.setting, where.sigma, true));
  if (where.kind == Where::above || where.kind == Where::below || where.kind == Where::beyond)
    all.push_back(setting_text("C", unit::g, where.setting, where.sigma, false));
  if (when.kind == When::decay || when.kind == When::decay_in_position)
    all.push_back(setting_text("T", unit::minute, when.setting, when.sigma, true));
  if (when.kind == When::harmonic)
    all.push_back(setting_text("P", unit::minute, when.setting, when.sigma, true));
  if (when.kind == When::onset || when.kind == When::window)
    all.push_back(setting_text("T0", unit::minute, when.setting, when.sigma, false));
  if (when.kind == When::window)
    all.push_back(setting_text("T1", unit::minute, when.end, when.sigma, false));
  return all;
}

std::string title_of(const OwnTarget& place) {
  switch (place.slot) {
    case OwnSlot::accelerometer:
      return fmt::format("unnamed error of accelerometer {}", "xyz"[place.axis]);
    case OwnSlot::gimbal:
      return fmt::format("unnamed error of the {} resolver", gimbals[place.axis]);
    case OwnSlot::rate:
    case OwnSlot::drift:
      break;
  }
  return fmt::format("unnamed drift of gyro {}", "xyz"[place.axis]);
}

}  // namespace

std::string equation_of(const Form& form, const Instants& at) {
  std::vector<std::string> factors;
  if (!is_pair(form.when) && !is_pair(form.where)) factors.emplace_back("A");
  for (std::string& part : std::vector{when_text(form.when), where_text(form.where, at)})
    if (!part.empty()) factors.push_back(std::move(part));
  return fmt::format("{}", fmt::join(factors, "*"));
}

Unit amplitude_unit(const Form& form, const Instants& at) {
  int g = 0;
  if (form.where.kind == Where::product)
    for (const std::size_t q : form.where.of) g += at.quantities[q].g;
  const char* base = form.place.slot == OwnSlot::accelerometer ? "ug"
                     : form.place.slot == OwnSlot::gimbal      ? "arcsec"
                                                               : "deg/h";
  const std::string text = g == 0   ? base
                           : g == 1 ? fmt::format("{}/g", base)
                                    : fmt::format("{}/g^{}", base, g);
  return parse_unit(text).value();
}

std::string term_text(const Form& form, const Instants& at, const std::string& key,
                      double largest) {
  const Unit amplitude = amplitude_unit(form, at);
  std::vector<std::string> parameters;
  const bool pair = is_pair(form.when) || is_pair(form.where);
  for (const char* name : {"A", "B"})
    if (name[0] == 'A' || pair)
      parameters.push_back(fmt::format("{} = {{ unit = \"{}\", prior = {} }}", name,
                                       amplitude.symbol.view(),
                                       number_text(rounded_up(largest / amplitude.to_si), 2)));
  for (std::string& setting : setting_texts(form)) parameters.push_back(std::move(setting));
  return fmt::format(
      "[[term]]\nkey = \"{}\"\ntitle = \"{}\"\nacts_on = \"{}\"\nequation = \"{}\"\n"
      "parameters = {{ {} }}\n",
      key, title_of(form.place), name_in(own_targets, form.place), equation_of(form, at),
      fmt::join(parameters, ", "));
}

}  // namespace drift::forms
