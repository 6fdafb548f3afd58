// SPDX-License-Identifier: Apache-2.0
#include "cli/common/unknown_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

#include "cli/help/headings.h"
#include "cli/help/verbs.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

struct ForeignOption {
  const char* name;
  const char* here;
};

// Of pbrt-v4 and Mitsuba 3.
constexpr std::array foreign_options{
    ForeignOption{"--outfile", "here it is -o"},
    ForeignOption{"--nthreads", "here it is --threads"},
    ForeignOption{"--cropwindow", "here it is render --crop x0,x1,y0,y1, in pixels"},
    ForeignOption{"--pixel", "here it is render --crop x,x+1,y,y+1"},
    ForeignOption{"--quick", "here it is a small --spp, --scale 0.25 and --decimate 0.1"},
    ForeignOption{"--resolution", "here it is render --width and --height"},
    ForeignOption{"--samples", "here it is render --spp"},
    ForeignOption{"--mse-reference-image", "here it is vitrail compare"},
    ForeignOption{"--write-partial-images", "here it is render --preview PICTURE"},
    ForeignOption{"--toply", "here it is vitrail convert IN OUT.pbrt"},
    ForeignOption{"--upgrade", "here it is vitrail convert IN OUT.pbrt"},
    ForeignOption{"--format", "here the output's extension selects it"},
    ForeignOption{"--gpu", "vitrail renders on processors only"},
    ForeignOption{"--wavefront", "vitrail has one way of rendering"},
    ForeignOption{"--interactive", "vitrail has no window"},
    ForeignOption{"--mode", "vitrail is always spectral"},
    ForeignOption{"-m", "vitrail is always spectral"},
    ForeignOption{"-s", "here it is --camera N"},
    ForeignOption{"--sensor", "here it is --camera N"},
    ForeignOption{"-v", "vitrail has one level of messages; --stats F.json has more"},
    ForeignOption{"--verbose", "vitrail has one level of messages; --stats F.json has more"},
};

// "develop, measure" where other verbs have the option; "" where none has.
std::string verbs_with(std::string_view option) {
  std::string found;
  for (const Verb& verb : verbs())
    for (const Heading& heading : headings(verb.name)) {
      std::istringstream words{std::string(heading.options)};
      for (std::string word; words >> word;)
        if ("--" + word.substr(0, word.find('=')) == option)
          found += fmt::format("{}{}", found.empty() ? "" : ", ", verb.name);
    }
  return found;
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names{"--help"};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

}  // namespace

std::string about_unexpected(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& word) {
    return word.starts_with('-') && word != "--";
  });
  if (option == extras.end()) {
    const auto word = std::find_if(extras.begin(), extras.end(), [](const auto& w) { return w != "--"; });
    return fmt::format("'{}' is one argument too many", word == extras.end() ? "" : *word);
  }
  const std::string name = option->substr(0, option->find('='));
  for (const ForeignOption& foreign : foreign_options)
    if (name == foreign.name) return fmt::format("there is no option {}: {}", name, foreign.here);
  if (const std::string others = verbs_with(name); !others.empty())
    return fmt::format("there is no option {}: it is one of vitrail {}{}", name, others,
                       others == "develop" && app.get_name() == "vitrail render"
                           ? ", of the film that --film NAME.film keeps"
                           : "");
  const std::string meant = closest_word(name, names_of(app));
  return meant.empty() ? fmt::format("there is no option {}", name)
                       : fmt::format("there is no option {}; did you mean {}?", name, meant);
}

}  // namespace vitrail
