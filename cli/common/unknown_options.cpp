// SPDX-License-Identifier: Apache-2.0
#include "cli/common/unknown_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

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
    ForeignOption{"--display-server", "it is one of render"},
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
  const auto option = std::find_if(extras.begin(), extras.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  if (option == extras.end())
    return fmt::format("'{}' is one argument too many", extras.empty() ? "" : extras.front());
  const std::string name = option->substr(0, option->find('='));
  for (const ForeignOption& foreign : foreign_options)
    if (name == foreign.name) return fmt::format("there is no option {}: {}", name, foreign.here);
  const std::string meant = closest_word(name, names_of(app));
  return meant.empty() ? fmt::format("there is no option {}", name)
                       : fmt::format("there is no option {}; did you mean {}?", name, meant);
}

}  // namespace vitrail
