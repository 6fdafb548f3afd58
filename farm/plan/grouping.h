// SPDX-License-Identifier: Apache-2.0
// These functions find which lights a film keeps apart, as `vitrail render` is asked for it.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.h"
#include "film/light_groups.h"
#include "tracer/prepared/grouped_lights.h"

namespace vitrail {

// It holds the groups that are asked for.
struct LightGrouping {
  // It names lights (bundle/light_names.h); * stands for any characters.
  struct Group {
    std::string name;
    std::vector<std::string> lights;
  };
  std::vector<Group> groups;
  bool each = false;  // a group of each light that is in none of them; else they are one: "others"

  bool any() const { return each || !groups.empty(); }
};

// Reads "day=sky-3,sun-*". Throws UsageError.
LightGrouping::Group parse_light_group(const std::string& text);

struct Grouping {
  LightGroups groups;
  GroupedLights table;
};
// Returns nothing where nothing is asked for. Throws UsageError for a group without lights, a light in two
// groups, and too many groups.
Grouping group_lights(const LightGrouping& asked, const Manifest& manifest);

}  // namespace vitrail
