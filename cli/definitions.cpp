// SPDX-License-Identifier: Apache-2.0
#include "cli/definitions.h"

namespace vitrail {

void declare_definitions(CLI::App& app, std::vector<std::string>& words) {
  app.add_option("-D,--define", words, "name=value: set a parameter of a Mitsuba scene; may be repeated")
      ->allow_extra_args(false)
      ->check([](const std::string& word) {
        const std::size_t at = word.find('=');
        return at == std::string::npos || at == 0 ? "takes name=value, not '" + word + "'" : std::string();
      });
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& words) {
  std::map<std::string, std::string> definitions;
  for (const std::string& word : words) {
    const std::size_t at = word.find('=');
    definitions[word.substr(0, at)] = word.substr(at + 1);
  }
  return definitions;
}

}  // namespace vitrail
