// SPDX-License-Identifier: Apache-2.0
// The front program: `vitrail VERB …` becomes `vitrail-VERB …` beside it.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

constexpr const char* usage = R"(usage: vitrail VERB ...

  convert     a scene from one format to another
  inspect     what is in a scene, a bundle, one of its files or a film, and what it needs
  partition   a scene into a bundle of sub-domains, one file each
  verify      every byte of a bundle
  render      a bundle or a scene, alone or under mpirun
  develop     films into a picture
  compare     a picture with a reference

`vitrail VERB --help` says more.
)";

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "";
  if (verb == "--help" || verb == "-h" || verb == "help") {
    std::fputs(usage, stdout);
    return 0;
  }
  if (verb == "--version") {
    std::puts("vitrail " VITRAIL_VERSION);
    return 0;
  }
  if (verb.empty() || verb.find('/') != std::string::npos) {
    std::fputs(usage, stderr);
    return 2;
  }
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / ("vitrail-" + verb);
  ::execv(program.c_str(), argv + 1);
  std::fprintf(stderr, "vitrail: there is no verb '%s'\n\n%s", verb.c_str(), usage);
  return 2;
}
