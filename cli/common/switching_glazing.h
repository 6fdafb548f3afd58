// SPDX-License-Identifier: Apache-2.0
// Switchable glazing goes from a scene into a bundle and is set there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bundle/kept_glazing.h"
#include "bundle/manifest.h"
#include "glazing/system.h"
#include "scene/records/scene.h"

namespace vitrail {

// Returns the switchable glazing of a scene, by its materials' ids. A system has the name of its material,
// else that which its file gives, else the file's own. Reads the files again.
std::vector<KeptGlazing> switching_glazings(const Scene& scene);

// A GlazingSetting is "NAME.QUANTITY=VALUE".
struct GlazingSetting {
  std::string name;
  Quantity quantity = Quantity::state;
  double value = 0;
};
// Throws UsageError, also for values out of range and for a quantity that is set twice.
std::vector<GlazingSetting> parse_settings(const std::vector<std::string>& texts);

// They return where a system stands, "state 0.6, temperature 20 °C", and "state, temperature" alone.
std::string describe_setting(const GlazingSystem& system);
std::string names_of_quantities(const GlazingSystem& system);

// Returns the sheets of all materials that the settings are about. Throws UsageError for glazing that the
// bundle does not have; the message says what it has.
std::vector<SetSheet> sheets_under(const std::vector<GlazingSetting>& settings,
                                   const std::filesystem::path& bundle, const Manifest& manifest);

}  // namespace vitrail
