// SPDX-License-Identifier: Apache-2.0
// This file keeps the glazing systems of a bundle that switch, so that render can set them. They are in
// BUNDLE/glazing.json (docs/reference/bundle-format.md). A bundle without such glass has no such file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/measured_sheet.h"

namespace vitrail {

struct Manifest;

struct KeptGlazing {
  // The two sides of a surface are indices of two materials, both sheets. They index the scene's materials
  // before partitioning, and the bundle's in a bundle.
  struct Sides {
    std::uint32_t front = 0, back = 0;
    bool operator==(const Sides&) const = default;
  };
  std::string name;           // as a user sets it; several may have one
  std::vector<Sides> sheets;  // at least one
  std::string system;         // its data, of which the bundle knows no more (glazing/kept_system.h)
  bool operator==(const KeptGlazing&) const = default;
};

// A SetSheet is the sheet that a material becomes in another state.
struct SetSheet {
  std::uint32_t material = 0;  // index; a measured sheet
  MeasuredSheet sheet;
};

std::filesystem::path glazing_path(const std::filesystem::path& bundle);

// Writes the glazings, or nothing where there are none. Throws MachineError.
void write_glazings(const std::filesystem::path& bundle, std::uint64_t scene_hash,
                    const std::vector<KeptGlazing>& glazings);

// Returns the glazings; none where the bundle has no such glass. Throws Error where the file is lost,
// damaged, belongs to another scene or refers to a material that is not there.
std::vector<KeptGlazing> read_glazings(const std::filesystem::path& bundle, const Manifest& manifest);

}  // namespace vitrail
