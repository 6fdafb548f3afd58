// SPDX-License-Identifier: Apache-2.0
#include "cli/common/distribution.h"

#include <map>
#include <string>

namespace vitrail {

void declare_distribution(CLI::App& app, Distribution& distribution, std::filesystem::path& homes,
                          bool& stay) {
  static const std::map<std::string, Distribution> names = {{"auto", Distribution::automatic},
                                                            {"decompose", Distribution::decompose},
                                                            {"replicate", Distribution::replicate}};
  app.add_option_function<std::string>(
         "--distribution", [&](const std::string& name) { distribution = names.at(name); },
         "decompose: a rank traces in its own domains and sends other rays to other ranks. replicate: each "
         "rank traces in all domains and pages the whole scene. auto (default): in all domains if they fit "
         "into memory, else in its own and those with most of its rays")
      ->check(CLI::IsMember({"auto", "decompose", "replicate"}));
  app.add_option_function<std::string>(
      "--homes", [&](const std::string& word) { word == "bytes" ? void(stay = true) : void(homes = word); },
      "the `render --profile` file of a smaller picture: ranks get equal work in place of equal bytes, and a "
      "busy domain has several ranks. bytes: equal bytes to the end. By default a render of a minute or more "
      "begins with equal bytes, and soon settles on equal work by a profile of its own");
}

}  // namespace vitrail
