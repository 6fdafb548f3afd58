// SPDX-License-Identifier: Apache-2.0
// The front program: `vitrail VERB …` becomes `vitrail-VERB …` beside it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "cli/common/main_guard.h"
#include "cli/common/run_program.h"
#include "cli/help/completion.h"
#include "cli/help/help_text.h"
#include "cli/help/licence.h"
#include "cli/help/man_page.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

std::string usage() {
  constexpr std::size_t column = 17;
  const std::size_t width = help_width();
  std::string text =
      "usage: vitrail VERB ...\n\nStart here:\n" + example_text(first_steps(), width) + "\nVerbs:\n";
  for (const Verb& verb : verbs()) text += entry_text(verb.name, verb.summary, column, width);
  text += "\nMore:\n";
  text += entry_text("help VERB", "the options of a verb", column, width);
  text += entry_text(
      "completion",
      "bash, zsh or fish: the completion script of that shell, as in: source <(vitrail completion bash)",
      column, width);
  return text + entry_text("-V, --version", "which version this is, and its licence", column, width);
}

// For its man page.
Command front_command() {
  CommandGroup group{"Verbs", {}};
  for (const Verb& verb : verbs()) {
    CommandOption told;
    told.is_argument = true;
    told.value = verb.name;
    told.text = verb.summary;
    group.options.push_back(told);
  }
  const std::span<const Example> steps = first_steps();
  return {"vitrail",
          "convert scenes and render them spectrally, on a laptop or a cluster",
          {group},
          {steps.begin(), steps.end()}};
}

int no_such(const std::string& verb) {
  std::vector<std::string> names;
  for (const Verb& known : verbs()) names.emplace_back(known.name);
  const std::string meant = closest_word(verb, names);
  say("vitrail: there is no verb '{}'{}\n\n{}", verb, meant.empty() ? "" : "; did you mean " + meant + "?",
      usage());
  return exit_usage;
}

int complete(const std::string& shell) {
  if (std::ranges::find(completed_shells, shell) == completed_shells.end())
    throw UsageError("completion is for bash, zsh or fish, not for '" + shell + "'");
  show_text(completion_head(shell));
  flush_shown();
  for (const Verb& verb : verbs()) run_program("vitrail-" + std::string(verb.name), {"--describe", shell});
  show_text(completion_tail(shell));
  return exit_done;
}

int become(std::vector<std::string> words) {
  const std::string program = (program_folder() / ("vitrail-" + words[0])).string();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  throw MachineError(fmt::format("cannot run {}: {}; the programs of vitrail have to lie in one folder",
                                 program, std::strerror(errno)));
}

int answer(const std::string& text) {
  show_text(text);
  return exit_done;
}

int run(std::vector<std::string> words) {
  if (words.size() > 1 && words[0] == "help") words = {words[1], "--help"};
  const std::string verb = words.empty() ? "" : words[0];
  if (verb == "--help" || verb == "-h" || verb == "help") return answer(usage());
  if (verb == "--version" || verb == "-V") return answer(version_text(VITRAIL_VERSION, ""));
  if (verb.empty()) {
    say_text(usage());
    return exit_usage;
  }
  if (verb == "completion") return complete(words.size() > 1 ? words[1] : "");
  if (verb == "--describe" && words.size() == 2 && words[1] == "man")
    return answer(man_page(front_command(), VITRAIL_VERSION));
  return find_verb(verb) ? become(words) : no_such(verb);
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  return vitrail::run_guarded([&] { return vitrail::run({argv + 1, argv + argc}); });
}
