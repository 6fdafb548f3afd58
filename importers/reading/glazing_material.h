// SPDX-License-Identifier: Apache-2.0
// A glazing system can be the material of one surface (docs/why/glazing.md).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Returns whether a file, perhaps with "#NAME" or "#state=0.6" behind it, is of glazing (and no table of
// measured glass).
bool is_glazing(const std::string& file);

// A GlazingModel is a glazing as a scene has it.
struct GlazingModel {
  MaterialModel model;
  std::vector<std::string> notes;  // what was repaired or approximated
};

// Returns the model of a surface whose front is outside. Sides that are not alike are two materials, which
// `add` takes; both keep the name of the file, which stands for the whole. Throws Error.
GlazingModel glazing_model(const std::string& file, const std::function<Id<Material>(Material)>& add);

// Writers ask these two. The first returns the file whose glazing a material is, of one side or of two, with
// its state; empty for others.
std::string glazing_file_of(const std::vector<Material>& materials, std::size_t index);
// The second tells which materials are no more than sides of such glazing: their file makes them anew, so
// they are not written.
std::vector<bool> sides_of_glazing(const Scene& scene);

}  // namespace vitrail
