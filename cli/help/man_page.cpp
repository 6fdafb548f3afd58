// SPDX-License-Identifier: Apache-2.0
#include "cli/help/man_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrail {

namespace {

// groff reads \ as an escape, - as a hyphen, and a line that begins with . or ' as a request.
std::string escaped(std::string_view text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out += "\\&";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else if (c == '`')
      out += "\\(ga";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '"')
      out += "\\(dq";
    else
      out += c;
    // A long word may end a line after a comma.
    if (c == ',' && i + 1 < text.size() && text[i + 1] != ' ') out += "\\:";
  }
  return out;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text;
}

std::string heading(const std::string& title) { return ".SH \"" + escaped(upper(title)) + "\"\n"; }

std::string bold_names(const CommandOption& option) {
  if (option.is_argument) return fmt::format("\\fI{}\\fR", escaped(option.joined_names()));
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped(name));
  return option.value.empty() ? names : fmt::format("{} \\fI{}\\fR", names, escaped(option.value));
}

std::string section(const CommandGroup& group) {
  std::string text = heading(group.heading);
  for (const CommandOption& option : group.options)
    text += ".TP\n" + bold_names(option) + "\n" + escaped(option.full_text()) + "\n";
  return text;
}

constexpr const char* exit_status = R"(.SH "EXIT STATUS"
.TP
0
done, or done already
.TP
1
pictures differ, or a threshold failed
.TP
2
wrong usage
.TP
3
bad input, or an output that holds other work
.TP
4
the machine: disk, memory, a rank, another job on the same output
.TP
130, 143
stopped by Ctrl\-C or TERM, with a checkpoint
)";

std::string see_also(const Command& command) {
  std::string text = ".SH \"SEE ALSO\"\n";
  if (!command.verb().empty()) return text + "\\fBvitrail\\fR(1)\n";
  std::string rest;
  for (const Verb& verb : verbs())
    rest += fmt::format("{}\\fBvitrail\\-{}\\fR(1)", rest.empty() ? "" : ",\n", verb.name);
  return text + rest + "\n";
}

}  // namespace

std::string man_page(const Command& command, const std::string& version) {
  std::string page = fmt::format(".TH \"{}\" 1 \"\" \"vitrail {}\" \"User Commands\"\n",
                                 upper(escaped(command.program())), version);
  page += ".nh\n.ad l\n";  // words stay whole, lines as long as they are
  page += ".SH NAME\n" + escaped(command.program()) + " \\- " + escaped(command.summary) + "\n";
  page += ".SH SYNOPSIS\n\\fB" + escaped(command.name) + "\\fR" +
          escaped(command.usage().substr(command.name.size())) + "\n";
  for (const CommandGroup& group : command.groups) page += section(group);
  if (!command.examples.empty()) page += ".SH EXAMPLES\n";
  for (const Example& example : command.examples)
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(example.command), escaped(example.effect));
  return page + exit_status + see_also(command);
}

}  // namespace vitrail
