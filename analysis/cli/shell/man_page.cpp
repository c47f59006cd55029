#include "analysis/cli/shell/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/cli/command.hpp"

namespace drift::cli {
namespace {

/// Text as roff takes it: nothing in it is a command.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool line_begins = out.empty() || out.back() == '\n';
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";  // a hyphen to type, not one of a word
    else
      out += c;
  }
  return out;
}

std::string heading(std::string_view macro, std::string_view text) {
  return fmt::format(".{} \"{}\"\n", macro, plain(text));
}

/// A term in bold, and what is said of it.
std::string item(std::string_view term, std::string_view what) {
  return fmt::format(".TP\n.B \"{}\"\n{}\n", plain(term), plain(what));
}

/// The words of `help` for an option or argument.
class Words : public CLI::Formatter {
 public:
  std::string of(const CLI::Option& option) const {
    const bool positional = option.get_positional();
    std::string term = make_option_name(&option, positional) + make_option_opts(&option);
    for (char& c : term)
      if (c == '"') c = '\'';  // it stands in quotes
    return item(term, make_option_desc(&option));
  }
};

std::string options_of(const CLI::App& app) {
  std::string out;
  for (const bool positional : {true, false})
    for (const CLI::Option* option : app.get_options(nullptr))
      if (option->get_positional() == positional) out += Words().of(*option);
  return out;
}

std::string command(const CLI::App& app, const std::string& program) {
  std::string usage = program + " " + app.get_name() + " [OPTIONS]";
  for (const CLI::Option* option : app.get_options(nullptr))
    if (option->get_positional())
      usage += option->get_required() ? " " + option->get_name(true, false)
                                      : " [" + option->get_name(true, false) + "]";
  return heading("SS", app.get_name()) +
         fmt::format("{}\n.PP\n.B {}\n", plain(app.get_description()), plain(usage)) +
         options_of(app) + fmt::format(".PP\n{}\n", plain(app.get_footer()));
}

struct Code {
  ExitCode code;
  std::string_view what;
};
constexpr Code codes[] = {
    {ExitCode::ok, "ok"},
    {ExitCode::internal, "internal error"},
    {ExitCode::usage, "usage"},
    {ExitCode::config, "study file"},
    {ExitCode::recording, "recording"},
    {ExitCode::failed_runs, "more runs failed than allowed"},
    {ExitCode::io, "input or output, or disk full; the same command goes on"},
    {ExitCode::store, "another study's folder, a damaged one, or one that holds files of others"},
    {ExitCode::self_check, "self-check"},
    {ExitCode::wall_time, "wall time reached, or the study is not complete (status)"},
    {ExitCode::interrupted, "interrupted; the same command goes on"},
    {ExitCode::terminated, "ended by a signal; the same command goes on"}};

}  // namespace

std::string man_page(const CLI::App& program) {
  const std::string name = "driftscope";
  std::string out =
      fmt::format(".TH DRIFTSCOPE 1 \"\" \"{}\" \"User Commands\"\n", plain(version_line()));
  const std::string about = program.get_description();
  const auto after = about.find(": ");  // it begins with the name
  out += ".SH NAME\n" +
         fmt::format("{} \\- {}\n", name, plain(about.substr(after == about.npos ? 0 : after + 2)));
  out += ".SH SYNOPSIS\n" + fmt::format(".B {} COMMAND\n[OPTIONS] [ARGUMENTS]\n", name);
  out += ".SH OPTIONS\n" + options_of(program);
  std::vector<std::string> groups;
  for (const CLI::App* app : program.get_subcommands(nullptr))
    if (std::ranges::find(groups, app->get_group()) == groups.end())
      groups.push_back(app->get_group());
  for (const std::string& group : groups) {
    out += heading("SH", group);
    for (const CLI::App* app : program.get_subcommands(nullptr))
      if (app->get_group() == group) out += command(*app, name);
  }
  out += ".SH EXIT STATUS\n";
  for (const Code& code : codes)
    out += item(std::to_string(static_cast<int>(code.code)), code.what);
  return out;
}

}  // namespace drift::cli
