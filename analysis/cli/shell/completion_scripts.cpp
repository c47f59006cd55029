#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/cli/shell/completion.hpp"
#include "core/base/words.hpp"

namespace drift::cli {
namespace {

std::string names_of(const std::vector<CompletedOption>& options) {
  std::string names;
  for (const CompletedOption& o : options)
    names += fmt::format("{}{}", names.empty() ? "" : " ", fmt::join(o.names, " "));
  return names;
}

/// zsh ends a description at a bracket and a value's name at a colon.
std::string zsh_words(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string bash_completion(const std::vector<CompletedCommand>& commands) {
  std::string options, values, arguments;
  for (const CompletedCommand& c : commands) {
    options += fmt::format("    {}) options={} ;;\n", in_shell_quotes(c.name),
                           in_shell_quotes(names_of(c.options)));
    if (!c.values.empty())
      arguments += fmt::format("    {}) values={} ;;\n", in_shell_quotes(c.name),
                               in_shell_quotes(fmt::format("{}", fmt::join(c.values, " "))));
    for (const CompletedOption& o : c.options) {
      if (!o.takes_value) continue;
      std::vector<std::string> cases;
      for (const std::string& name : o.names) cases.push_back(in_shell_quotes(c.name + " " + name));
      values += fmt::format("    {}) kind=value values={} ;;\n", fmt::join(cases, "|"),
                            in_shell_quotes(fmt::format("{}", fmt::join(o.values, " "))));
    }
  }
  return fmt::format(
      R"(# Completes driftscope in bash: source <(driftscope completion bash)
_driftscope() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local command= kind= values= options= i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
    --color|--threads) ((++i)) ;;
    -*) ;;
    *) command=${{COMP_WORDS[i]}}; break ;;
    esac
  done
  case "$command" in
{}    esac
  case "$command $before" in
{}    esac
  if [[ -z $kind ]]; then
    if [[ $current == -* ]]; then
      kind=option values=$options
    else
      case "$command" in
{}      esac
    fi
  fi
  # Where nothing is listed bash offers files.
  COMPREPLY=($(compgen -W "$values" -- "$current"))
  if [[ ${{COMPREPLY[0]}} == *= ]]; then compopt -o nospace 2>/dev/null; fi
  return 0
}}
complete -o default -F _driftscope driftscope
)",
      options, values, arguments);
}

std::string zsh_completion(const std::vector<CompletedCommand>& commands) {
  std::string list, cases;
  for (const CompletedCommand& c : commands) {
    std::string specs;
    for (const CompletedOption& o : c.options) {
      const std::string value =
          !o.takes_value ? ""
          : o.values.empty()
              ? ":value:_files"
              : fmt::format(":value:({})", zsh_words(fmt::format("{}", fmt::join(o.values, " "))));
      for (const std::string& name : o.names)
        specs +=
            fmt::format(" \\\n      {}",
                        in_shell_quotes(fmt::format("*{}[{}]{}", name, zsh_words(o.what), value)));
    }
    if (c.name.empty()) continue;
    list += fmt::format("    {}\n", in_shell_quotes(fmt::format("{}:{}", c.name, c.what)));
    const std::string rest = c.values.empty()
                                 ? "*:file:_files"
                                 : fmt::format("*:argument:({})", fmt::join(c.values, " "));
    cases += fmt::format("  {})\n    _arguments{} \\\n      {}\n    ;;\n", c.name, specs,
                         in_shell_quotes(rest));
  }
  return fmt::format(
      R"(#compdef driftscope
# Completes driftscope in zsh: driftscope completion zsh > a folder of $fpath/_driftscope
_driftscope() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
{}  esac
}}
compdef _driftscope driftscope
)",
      list, cases);
}

std::string fish_completion(const std::vector<CompletedCommand>& commands) {
  std::string out = "# Completes driftscope in fish: driftscope completion fish | source\n";
  for (const CompletedCommand& c : commands) {
    const std::string when = c.name.empty() ? std::string("__fish_use_subcommand")
                                            : fmt::format("__fish_seen_subcommand_from {}", c.name);
    if (!c.name.empty())
      out += fmt::format("complete -c driftscope -n __fish_use_subcommand -f -a {} -d {}\n", c.name,
                         in_shell_quotes(c.what));
    if (!c.name.empty() && !c.values.empty())
      out += fmt::format("complete -c driftscope -n {} -f -a {}\n", in_shell_quotes(when),
                         in_shell_quotes(fmt::format("{}", fmt::join(c.values, " "))));
    for (const CompletedOption& o : c.options) {
      out += fmt::format("complete -c driftscope -n {}", in_shell_quotes(when));
      for (const std::string& name : o.names)
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (o.takes_value && o.values.empty()) out += " -r";
      if (!o.values.empty())
        out += " -x -a " + in_shell_quotes(fmt::format("{}", fmt::join(o.values, " ")));
      out += " -d " + in_shell_quotes(o.what) + "\n";
    }
  }
  return out;
}

}  // namespace drift::cli
