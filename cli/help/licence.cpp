// SPDX-License-Identifier: Apache-2.0
#include "cli/help/licence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "cli/help/verbs.h"

namespace vitrail {

std::string_view licence_of(std::string_view verb) {
  const Verb* found = find_verb(verb);
  return found && found->contains_cgal ? "GPL-3.0-or-later" : "Apache-2.0";
}

std::string version_text(std::string_view version, std::string_view verb) {
  const std::string_view licence = licence_of(verb);
  std::string text = fmt::format("vitrail {}\n", version);
  if (!find_verb(verb)) {
    std::vector<std::string_view> with_cgal;
    for (const Verb& known : verbs())
      if (known.contains_cgal) with_cgal.push_back(known.name);
    return text + fmt::format("licence: {}; that of {}, which contain CGAL, is GPL-3.0-or-later\n", licence,
                              fmt::join(with_cgal, ", "));
  }
  text += fmt::format("licence of vitrail {}: {}", verb, licence);
  return text +
         (find_verb(verb)->contains_cgal ? ", as it contains CGAL; its own source is Apache-2.0\n" : "\n");
}

}  // namespace vitrail
