// SPDX-License-Identifier: Apache-2.0
#include "cli/common/distribution.h"

#include <map>
#include <string>

namespace vitrail {

void declare_distribution(CLI::App& app, Distribution& distribution, std::filesystem::path& homes) {
  static const std::map<std::string, Distribution> names = {{"auto", Distribution::automatic},
                                                            {"decompose", Distribution::decompose},
                                                            {"replicate", Distribution::replicate}};
  app.add_option_function<std::string>(
         "--distribution", [&](const std::string& name) { distribution = names.at(name); },
         "decompose: a rank traces in the domains that it answers for, and other rays go to others; "
         "replicate: in all, and each pages the whole scene; default auto: in all where they fit into its "
         "memory, else in its own and those that it asks others for most")
      ->check(CLI::IsMember({"auto", "decompose", "replicate"}));
  app.add_option(
      "--homes", homes,
      "what `render --profile` wrote of a smaller picture: ranks then answer for equal work, not for "
      "equal bytes, and several for a domain where much goes");
}

}  // namespace vitrail
