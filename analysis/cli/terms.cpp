#include "analysis/cli/commands.hpp"
#include "core/config/nearest.hpp"
#include "core/physics/term_library.hpp"

namespace drift::cli {
namespace {

std::string prior_text(const ParamSpec& spec) {
  switch (spec.prior.kind) {
    case Prior::Kind::normal: return fmt::format("normal({:g}, {:g})", spec.prior.a, spec.prior.b);
    case Prior::Kind::uniform: return fmt::format("uniform({:g}, {:g})", spec.prior.a, spec.prior.b);
    case Prior::Kind::fixed: break;
  }
  return fmt::format("{:g}", spec.prior.a);
}

void explain(const TermInfo& term) {
  fmt::print("{}: {}\n  equation  {}\n  source    {}\n  {:<10} {:<12} {:<18} {}\n", term.key, term.title,
             term.equation, term.source, "parameter", "unit", "default prior", "enters");
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    fmt::print("  {:<10} {:<12} {:<18} {}\n", spec.key.view(), spec.unit.symbol.view(), prior_text(spec),
               spec.enters);
  }
}

}  // namespace

ExitCode terms(const std::string& key) {
  if (key.empty()) {
    fmt::print("{:<20} {:>3}  {}\n", "term", "par", "equation");
    for (const TermInfo& term : TermLibrary::terms)
      fmt::print("{:<20} {:>3}  {}\n", term.key, term.count, term.equation);
    fmt::print("{} terms, {} parameters. `driftscope terms KEY` explains a term or a parameter.\n",
               TermLibrary::num_terms, TermLibrary::num_params);
    return ExitCode::ok;
  }
  if (const auto t = TermLibrary::find_term(key)) {
    explain(TermLibrary::terms[*t]);
    return ExitCode::ok;
  }
  if (const auto p = TermLibrary::find(key)) {
    explain(TermLibrary::owner(*p));
    return ExitCode::ok;
  }
  std::vector<std::string_view> known;
  for (const TermInfo& term : TermLibrary::terms) known.push_back(term.key);
  for (const ParamSpec& spec : TermLibrary::specs) known.push_back(spec.key.view());
  throw InputError(ExitCode::usage, fmt::format("terms: no term or parameter '{}'. {} `driftscope terms` "
                                                "lists all", key, config::suggestion(key, known, "See the list:")));
}

}  // namespace drift::cli
