// SPDX-License-Identifier: Apache-2.0
// The front program: `vitrail VERB …` becomes `vitrail-VERB …` beside it.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/system/diagnostics.h"

namespace {

constexpr const char* usage = R"(usage: vitrail VERB ...

  convert     a scene from one format to another
  inspect     what is in a scene, a bundle, one of its files or a film, and what it needs
  partition   a scene into a bundle of sub-domains, one file each
  verify      every byte of a bundle
  render      a bundle or a scene, alone or under mpirun
  plan        what a cluster would do with a bundle
  develop     films into a picture
  compare     a picture with a reference
  measure     what speed costs on a scene, and which settings to take
  glazing     transmittance, reflectance and colour of panes
  sky         where the sun stands, and what sun and sky give
  spectrum    reflectances made from RGB, evaluated

`vitrail help VERB` says more.
)";

const std::vector<std::string> verbs{"convert", "inspect", "partition", "verify",  "render", "plan",
                                     "develop", "compare", "measure",   "glazing", "sky",    "spectrum"};

int no_such(const std::string& verb) {
  const std::string meant = vitrail::closest_word(verb, verbs);
  std::fprintf(stderr, "vitrail: there is no verb '%s'%s%s%s\n\n%s", verb.c_str(),
               meant.empty() ? "" : "; did you mean ", meant.c_str(), meant.empty() ? "" : "?", usage);
  return 2;
}

int answer(const char* text) {
  if (std::fputs(text, stdout) >= 0 && std::fflush(stdout) == 0) return 0;
  std::fprintf(stderr, "vitrail: cannot write to standard output: %s\n", std::strerror(errno));
  return 4;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() > 1 && words[0] == "help") words = {words[1], "--help"};
  const std::string verb = words.empty() ? "" : words[0];
  if (verb == "--help" || verb == "-h" || verb == "help") return answer(usage);
  if (verb == "--version") return answer("vitrail " VITRAIL_VERSION "\n");
  if (verb.empty()) {
    std::fputs(usage, stderr);
    return 2;
  }
  if (std::find(verbs.begin(), verbs.end(), verb) == verbs.end()) return no_such(verb);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / ("vitrail-" + verb);
  ::execv(program.c_str(), arguments.data());
  std::fprintf(stderr, "vitrail: cannot run %s: %s; the programs of vitrail have to lie in one folder\n",
               program.c_str(), std::strerror(errno));
  return 4;
}
