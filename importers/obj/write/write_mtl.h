// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "importers/writing/flat_shapes.h"
#include "importers/writing/opacity_key.h"

namespace vitrail {

// A material of MTL is a material of the Scene with the light and the opacity of its surface.
using MtlKey = std::tuple<std::uint32_t, std::optional<std::uint32_t>, OpacityKey>;
using MtlNames = std::map<MtlKey, std::string>;

inline MtlKey surface_key(const Shape& shape) {
  return {shape.material.value, shape.area_light ? std::optional(shape.area_light->value) : std::nullopt,
          opacity_key(shape.opacity)};
}

// Returns the colours of a mesh that OBJ can say, one a vertex; null where it has none.
const MeshAttribute* vertex_colors(const TriangleMesh& mesh);

// Writes the materials of these shapes, and returns their names there: their own names, if no other has them.
// What read_mtl makes (mtl.h has the table) is written so that it makes it again; other materials become the
// nearest of those, with diagnostics. Materials that are diffuse by the colours of vertices are left out:
// readers take those where no library defines the material. Smooth surfaces have Ns 10⁶. Throws MachineError.
MtlNames write_mtl(const std::vector<FlatShape>& shapes, const std::filesystem::path& file,
                   ConversionNotes& notes);

}  // namespace vitrail
