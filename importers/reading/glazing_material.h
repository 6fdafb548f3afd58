// SPDX-License-Identifier: Apache-2.0
// A glazing system as the material of one surface (docs/why/glazing.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Whether a file, perhaps with "#NAME" or "#state=0.6" behind it, is of glazing (and no table of measured
// glass).
bool is_glazing(const std::string& file);

// What becomes of a glazing in a scene.
struct GlazingModel {
  MaterialModel model;
  std::vector<std::string> notes;  // what was repaired or approximated
};

// The outside is the surface's front. Sides that are not alike are two materials, which `add` takes; both
// keep the name of the file, which stands for the whole. Throws Error.
GlazingModel glazing_model(const std::string& file, const std::function<Id<Material>(Material)>& add);

// For writers: the file whose glazing a material is, of one side or of two, with its state; empty for others.
std::string glazing_file_of(const std::vector<Material>& materials, std::size_t index);
// Which materials are no more than the sides of such: their file makes them anew, so they are not written.
std::vector<bool> sides_of_glazing(const Scene& scene);

}  // namespace vitrail
