// SPDX-License-Identifier: Apache-2.0
// Switchable glazing, from a scene into a bundle and set there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bundle/kept_glazing.h"
#include "bundle/manifest.h"
#include "glazing/system.h"
#include "scene/records/scene.h"

namespace vitrail {

// What a scene has of it, by its materials' ids. A system has the name of its material; without one that
// which its file gives, or the file's own. Reads the files again.
std::vector<KeptGlazing> switching_glazings(const Scene& scene);

// "NAME.QUANTITY=VALUE".
struct GlazingSetting {
  std::string name;
  Quantity quantity = Quantity::state;
  double value = 0;
};
// Throws UsageError, also for values out of range and for what is set twice.
std::vector<GlazingSetting> parse_settings(const std::vector<std::string>& texts);

// "state 0.6, temperature 20 °C": where a system stands. The quantities alone: "state, temperature".
std::string describe_setting(const GlazingSystem& system);
std::string names_of_quantities(const GlazingSystem& system);

// The sheets of all materials that the settings are about. Throws UsageError for what the bundle does not
// have; the message says what it has.
std::vector<SetSheet> sheets_under(const std::vector<GlazingSetting>& settings,
                                   const std::filesystem::path& bundle, const Manifest& manifest);

}  // namespace vitrail
