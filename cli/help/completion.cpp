// SPDX-License-Identifier: Apache-2.0
#include "cli/help/completion.h"

#include <fmt/format.h>

#include <vector>

namespace vitrail {

namespace {

constexpr std::string_view bash_tail = R"(
_vitrail_help() { values=$_vitrail_verbs; }
_vitrail_completion() { values='bash zsh fish'; }

_vitrail() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]}
  local options= values=
  # A word of its own: --name=value are three.
  [[ $previous == = ]] && previous=${COMP_WORDS[COMP_CWORD-2]}
  [[ $current == = ]] && current=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    values="$_vitrail_verbs help completion --help --version"
  elif declare -F "_vitrail_$verb" >/dev/null; then
    "_vitrail_$verb"
  fi
  if [[ $values == ANY ]]; then
    return
  elif [[ -n $values && $values != FILE ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
  elif [[ -z $values && $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -F _vitrail vitrail
)";

constexpr std::string_view zsh_tail = R"(
_vitrail() {
  if ((CURRENT == 2)); then
    _describe -t verbs verb vitrail_verbs
    compadd help completion
    return
  fi
  local verb=$words[2]
  shift words
  ((CURRENT--))
  if [[ $verb == completion ]]; then
    compadd bash zsh fish
  elif [[ $verb == help ]]; then
    _describe -t verbs verb vitrail_verbs
  elif (($+functions[_vitrail_$verb])); then
    _vitrail_$verb
  fi
}
if [[ $funcstack[1] == _vitrail ]]; then
  _vitrail "$@"
else
  compdef _vitrail vitrail
fi
)";

constexpr std::string_view fish_tail =
    R"(complete -c vitrail -f -n '__fish_seen_subcommand_from completion' -a 'bash zsh fish'
complete -c vitrail -f -n __fish_use_subcommand -a 'help completion'
)";

// The first of a text's clauses, at most about a line's rest.
std::string brief(const std::string& text) {
  constexpr std::size_t most = 72;
  std::string clause = text.substr(0, text.find("; "));
  if (clause.size() <= most) return clause;
  return clause.substr(0, clause.rfind(' ', most)) + " …";
}

std::string replaced(const std::string& text, char from, std::string_view to) {
  std::string out;
  for (const char c : text)
    if (c == from)
      out += to;
    else
      out += c;
  return out;
}

std::string quoted(const std::string& text) { return "'" + replaced(text, '\'', R"('\'')") + "'"; }

// _arguments takes brackets and colons for its own.
std::string bracketed(const CommandOption& option) {
  std::string text = brief(option.text);
  for (const char c : {'\\', '[', ']', ':'}) text = replaced(text, c, std::string{'\\', c});
  return "[" + text + "]";
}

std::string bash_function(const Command& command) {
  std::string names, cases;
  for (const CommandOption& option : command.all()) {
    if (option.is_argument) continue;
    names += fmt::format("{}{}", names.empty() ? "" : " ", fmt::join(option.names, " "));
    if (option.value.empty()) continue;
    const std::string values = !option.choices.empty() ? fmt::format("{}", fmt::join(option.choices, " "))
                               : option.takes_file     ? "FILE"
                                                       : "ANY";
    cases += fmt::format("    {}) values='{}' ;;\n", fmt::join(option.names, "|"), values);
  }
  const std::string choice = cases.empty() ? "" : "  case $previous in\n" + cases + "  esac\n";
  return fmt::format("\n_vitrail_{}() {{\n  options='{}'\n{}}}\n", command.verb(), names, choice);
}

std::string zsh_option(const CommandOption& option) {
  std::string value;
  if (!option.value.empty())
    value = ":" + replaced(option.value, ':', "\\:") + ":" +
            (!option.choices.empty() ? fmt::format("({})", fmt::join(option.choices, " "))
             : option.takes_file     ? "_files"
                                     : "");
  if (option.is_argument) return quoted("*" + value);
  std::vector<std::string> names;
  for (const std::string& name : option.names)
    names.push_back(value.empty() ? name : name + (name.starts_with("--") ? "=" : "+"));
  const std::string what = quoted(bracketed(option) + value);
  // Those that may be given once rule each other out.
  const std::string before = option.may_repeat ? "'*'" : fmt::format("'({})'", fmt::join(option.names, " "));
  return names.size() == 1 ? before + names[0] + what
                           : fmt::format("{}{{{}}}{}", before, fmt::join(names, ","), what);
}

std::string zsh_function(const Command& command) {
  std::string text = fmt::format("\n_vitrail_{}() {{\n  _arguments -s -S", command.verb());
  bool has_files = false;
  for (const CommandOption& option : command.all()) {
    if (option.is_argument && has_files) continue;
    has_files |= option.is_argument;
    text += " \\\n    " + zsh_option(option);
  }
  return text + "\n}\n";
}

std::string fish_lines(const Command& command) {
  std::string text;
  for (const CommandOption& option : command.all()) {
    if (option.is_argument) continue;
    text += fmt::format("complete -c vitrail -n '__fish_seen_subcommand_from {}'", command.verb());
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.value.empty()) text += option.takes_file ? " -r -F" : " -x";
    if (!option.choices.empty()) text += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
    text += " -d " + quoted(replaced(brief(option.text), '\\', "\\\\")) + "\n";
  }
  return text;
}

}  // namespace

std::string completion_head(std::string_view shell) {
  std::string text = shell == "zsh" ? "#compdef vitrail\n" : "";
  text += fmt::format("# Written by `vitrail completion {}`.\n", shell);
  if (shell == "zsh") text += "vitrail_verbs=(\n";
  for (const Verb& verb : verbs())
    if (shell == "zsh")
      text += "  " + quoted(fmt::format("{}:{}", verb.name, verb.summary)) + "\n";
    else if (shell == "fish")
      text += fmt::format("complete -c vitrail -f -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                          quoted(std::string(verb.summary)));
  if (shell == "zsh") text += ")\n";
  return text;
}

std::string completion_of(std::string_view shell, const Command& command) {
  if (shell == "bash") return bash_function(command);
  return shell == "zsh" ? zsh_function(command) : fish_lines(command);
}

std::string completion_tail(std::string_view shell) {
  if (shell == "zsh") return std::string(zsh_tail);
  std::string names;
  for (const Verb& verb : verbs()) names += (names.empty() ? "" : " ") + std::string(verb.name);
  if (shell == "fish")
    return "complete -c vitrail -f -n '__fish_seen_subcommand_from help' -a '" + names + "'\n" +
           std::string(fish_tail);
  return "\n_vitrail_verbs='" + names + "'\n" + std::string(bash_tail);
}

}  // namespace vitrail
