#include "core/physics/own/own_terms_config.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/physics/own/own_equation.hpp"
#include "core/physics/own/own_parameters_config.hpp"
#include "core/physics/term_library.hpp"

namespace drift {
namespace {

using config::Option;
using config::Section;

constexpr std::size_t longest_equation = 500;  // characters

/// "w_l,x += ...", as the library writes its equations.
std::string added_to(const OwnTarget& target) {
  constexpr std::string_view gimbals[] = {"outer", "middle", "inner"};
  const char axis = "xyz"[target.axis];
  switch (target.slot) {
    case OwnSlot::drift:
      return fmt::format("w_l,{} += ", axis);
    case OwnSlot::accelerometer:
      return fmt::format("f_{} += ", axis);
    case OwnSlot::gimbal:
      return fmt::format("gimbal_{} += ", gimbals[target.axis]);
    case OwnSlot::rate:
      break;
  }
  return fmt::format("w_ip,{} += ", axis);
}

/// Whether two names are the same to those who do not tell capital letters, as MATLAB's tables.
bool alike(std::string_view a, std::string_view b) {
  const auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::ranges::equal(a, b, {}, lower, lower);
}

/// Names that are taken: terms, parameters and groups of them, of the library and of the terms
/// before.
bool is_taken(std::string_view name, const std::vector<OwnTerm>& before) {
  const auto is_term = [&](const auto& term) { return alike(term.key, name); };
  const auto is_parameter = [&](const ParamSpec& s) {
    return alike(s.key.view(), name) || alike(s.group.view(), name);
  };
  return std::ranges::any_of(TermLibrary::known_terms, is_term) ||
         std::ranges::any_of(TermLibrary::known_specs, is_parameter) ||
         std::ranges::any_of(before, is_term) || std::ranges::any_of(before, [&](const OwnTerm& t) {
           return std::ranges::any_of(t.params, is_parameter);
         });
}

/// Whether it is the name of a term but for its capitals.
bool is_term_in_capitals(std::string_view key, const std::vector<OwnTerm>& before) {
  const auto is_called = [&](const auto& term) { return alike(term.key, key) && term.key != key; };
  return std::ranges::any_of(TermLibrary::known_terms, is_called) ||
         std::ranges::any_of(before, is_called);
}

/// The name of a term; reported, and mostly empty, if it is none that it can be called by.
std::string read_own_key(Section& section, const std::vector<OwnTerm>& before) {
  constexpr std::size_t longest = 24;  // leaves room for the names of parameters
  std::string key;
  section.take("key", Section::Kind::text, config::expected_text());
  if (!section.require("key", "key = \"bearing_rumble\"") ||
      !section.read(Option{.key = "key", .doc = "name of the term"}, key))
    return {};
  const bool taken = is_taken(key, before);
  if (is_name(key) && key.size() <= longest && !taken) return key;
  section.report().error(
      section.take("key")->at,
      fmt::format("'{}' = \"{}\" {} (expected a name of its own: letters, figures and _, a letter "
                  "first, at most {} characters). Rename the term",
                  section.full("key"), key,
                  taken ? "is the name of another term or parameter" : "cannot be a name",
                  longest));
  // One that differs in capitals alone shall not be unknown too, where the study calls it.
  return is_term_in_capitals(key, before) ? key : std::string();
}

/// All that a term was made of, for comparing; whatever the order of the keys in the file.
std::string own_declaration(const OwnTerm& term) {
  std::string text = fmt::format("{}\n{}\n{}", term.key, term.title, term.equation);
  for (const ParamSpec& p : term.params)
    text += fmt::format("\n{} [{}] {} {} {} {} grid {}", p.key.view(), p.unit.symbol.view(),
                        static_cast<int>(p.kind), static_cast<int>(p.prior.kind), p.prior.a,
                        p.prior.b, fmt::join(p.grid.begin(), p.grid.end(), " "));
  return text;
}

/// The equation with a mark below the place.
std::string equation_shown(const std::string& text, std::size_t at) {
  return fmt::format("\n    {}\n    {:>{}}", text, "^", std::min(at, text.size()) + 1);
}

std::optional<CompiledEquation> read_own_equation(Section& section, const OwnParameters& parameters,
                                                  const OwnTarget& target,
                                                  const std::vector<std::string>& covariates) {
  const config::Node& node = *section.take("equation");
  const std::string key = section.full("equation");
  if (!node.is(config::Node::Kind::string) || node.text.size() > longest_equation ||
      node.text.find('\n') != std::string::npos) {
    section.report().error(
        node.at, fmt::format("'{}' is {} (expected an equation in quotes, one line of at most {} "
                             "characters). Write equation = \"A * sin(2*pi*t/P)\"",
                             key, describe(node), longest_equation));
    return std::nullopt;
  }
  section.report().given(key, node.text, node.at);
  auto result =
      compile_equation({node.text, target, parameters.names, parameters.specs}, covariates);
  if (const EquationMistake* m = std::get_if<EquationMistake>(&result)) {
    section.report().error(
        node.at, fmt::format("'{}' {} (expected {}). {}{}", key, m->what, m->expected, m->fix,
                             equation_shown(node.text, m->at)));
    return std::nullopt;
  }
  return std::get<CompiledEquation>(std::move(result));
}

/// Names of parameters that others have.
void check_own_names(Section& section, const std::vector<ParamSpec>& params,
                     const std::vector<OwnTerm>& before) {
  for (std::size_t k = 0; k < params.size(); ++k) {
    const std::string_view name = params[k].key;
    const bool again =
        std::any_of(params.begin(), params.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const ParamSpec& other) { return alike(other.key.view(), name); });
    if (again || is_taken(name, before))
      section.report().error(
          section.at(), fmt::format("the parameter '{}' has the name of another, capitals aside "
                                    "(expected a name of its own). Rename it, or the term",
                                    name));
  }
}

/// The terms before, and the one of this section where it has a name.
OwnTermSet with_term(OwnTermSet set, Section& section) {
  const std::size_t errors = section.report().errors();
  OwnTerm term;
  term.key = read_own_key(section, set.terms);
  term.title = term.key;
  section.read(Option{.key = "title", .doc = "of the term"}, term.title);
  section.require("acts_on", "acts_on = \"drift.x\"");
  section.read(Option{.key = "acts_on", .doc = "what it is added to"}, term.target, own_targets);
  section.take("equation", Section::Kind::text, "an equation in quotes");
  const bool has_equation = section.require("equation", "equation = \"A * sin(2*pi*t/P)\"");
  OwnParameters parameters = read_own_parameters(section, term.key);
  check_own_names(section, parameters.specs, set.terms);
  section.finish();
  // The equation of a term that is wrong already would only be wrong again.
  if (has_equation && section.report().errors() == errors)
    if (auto compiled = read_own_equation(section, parameters, term.target, set.covariates)) {
      term.equation = added_to(term.target) + section.take("equation")->text;
      term.program = compiled->program;
      term.needs = compiled->needs;
      set.covariates = std::move(compiled->covariates);
    }
  term.params = std::move(parameters.specs);
  // A term that is wrong shall not be unknown too, where it is named.
  if (term.params.empty()) term.params.emplace_back();
  term.declaration = own_declaration(term);
  if (!term.key.empty()) set.terms.push_back(std::move(term));
  return set;
}

}  // namespace

OwnTermSet read_own_terms(Section& root, OwnTermSet before) {
  OwnTermSet set = std::move(before);
  std::vector<Section> sections = root.sections("term");
  if (set.terms.size() + sections.size() > most_own_terms) {
    root.report().error(
        sections[most_own_terms - set.terms.size()].at(),
        fmt::format("the study brings {} terms (expected at most {} [[term]]). Remove some",
                    sections.size(), most_own_terms));
    sections.erase(
        sections.begin() + static_cast<std::ptrdiff_t>(most_own_terms - set.terms.size()),
        sections.end());
  }
  for (Section& section : sections) set = with_term(std::move(set), section);
  return set;
}

}  // namespace drift
